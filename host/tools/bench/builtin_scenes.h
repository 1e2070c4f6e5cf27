#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace duolux {

/// Names that writeBuiltinScene knows, where N is a number of triangles: cornell, spot, two-spheres-N.
std::vector<std::string> builtinSceneNames();

bool isBuiltinScene(const std::string& name);

/// Writes a built-in scene to a folder, which is created if it does not exist. Returns its JSON file. Throws
/// MachineError if it cannot be written. Requires isBuiltinScene(name).
std::filesystem::path writeBuiltinScene(const std::string& name, const std::filesystem::path& folder);

/// Throws UsageError unless each is a built-in scene or a file, and no two have the same benchName.
void checkBenchScenes(const std::vector<std::string>& scenes);

/// The first part of the names of a scene's benchmarks: the scene's name, or the stem of a file.
std::string benchName(const std::string& scene);

/// The file of a scene; a built-in one is written to `folder`. Throws as writeBuiltinScene does.
std::filesystem::path benchSceneFile(const std::string& scene, const std::filesystem::path& folder);

}  // namespace duolux
