#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace duolux {

/// Names that writeBuiltinScene knows, where N is a number of triangles: cornell, spot, two-spheres-N.
std::vector<std::string> builtinSceneNames();

bool isBuiltinScene(const std::string& name);

/// Writes a scene that the program brings along to a folder, which is made if need be. Returns its JSON file.
/// Throws MachineError if it cannot be written. Requires isBuiltinScene(name).
std::filesystem::path writeBuiltinScene(const std::string& name, const std::filesystem::path& folder);

}  // namespace duolux
