#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "host/scene/mesh.h"
#include "host/scene/tally.h"

namespace duolux {

/// The materials of an OBJ file: those of the MTL files it names, and grey ones for what these do not define.
class ObjMaterials {
  public:
    ObjMaterials(std::filesystem::path mesh, Reading reading);

    /// Reads the files that an `mtllib` line names, unless they have been read.
    void load(std::string_view names);

    /// Index of a material; the empty name is that of faces without one.
    std::uint32_t find(const std::string& name);

    /// Materials and warnings.
    void moveTo(Mesh& mesh);

  private:
    std::vector<std::filesystem::path> filesOf(std::string_view names);
    std::optional<std::filesystem::path> existing(std::string_view name);
    std::optional<std::filesystem::path> existingIgnoringCase(const std::filesystem::path& path);
    const std::vector<std::string>& filesIn(const std::filesystem::path& folder);
    void loadFile(const std::filesystem::path& file);
    std::string missingWarning();

    std::filesystem::path mesh_;
    Reading reading_;
    std::vector<Material> materials_;
    std::unordered_map<std::string, std::uint32_t> index_;
    std::vector<std::string> warnings_;
    std::string firstUndefined_;
    std::size_t undefined_ = 0;
    std::set<std::string, std::less<>> lines_;  ///< of mtllib, that have been dealt with
    std::set<std::filesystem::path> loaded_;
    std::vector<std::filesystem::path> read_;
    std::optional<std::filesystem::path> firstMissing_;
    std::size_t missing_ = 0;
    std::map<std::filesystem::path, std::vector<std::string>> folders_;  ///< names of the files in each
};

}  // namespace duolux
