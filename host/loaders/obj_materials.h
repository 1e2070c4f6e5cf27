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

#include "host/base/error.h"
#include "host/loaders/material_files.h"
#include "host/scene/mesh.h"

namespace duolux {

/// The materials of an OBJ file: those of the MTL files that it names, and grey ones for undefined names.
class ObjMaterials {
  public:
    ObjMaterials(std::filesystem::path mesh, MaterialFiles& files);

    /// Reads the files that an `mtllib` line names, unless they have already been read. Throws InputError.
    void load(std::string_view names);

    /// The index of a material; the empty name is for faces without a material.
    std::uint32_t find(const std::string& name);

    /// Adds the materials that faces use, and warnings, to the mesh. Throws InputError if a material is
    /// invalid or, in strict reading, undefined.
    void moveTo(Mesh& mesh);

  private:
    struct Entry {
        Material material;
        const MaterialLibrary* library = nullptr;  ///< of its images; null if it has none
        bool isDefined = true;
        const InputError* unusable = nullptr;
    };

    /// Of the mesh's images, by ImageSource::identity().
    using ImageIndices = std::map<decltype(std::declval<ImageSource>().identity()), std::uint32_t>;

    std::vector<std::filesystem::path> filesOf(std::string_view names);
    void noteMissing(std::string_view name);
    Entry entryFor(const std::string& name) const;
    static void moveImages(Entry& entry, ImageIndices& indices, Mesh& mesh);
    void warnOfMissing(Mesh& mesh);
    void warnOfUndefined(Mesh& mesh, const std::vector<bool>& used) const;

    std::filesystem::path mesh_;
    MaterialFiles& files_;
    std::vector<const MaterialLibrary*> libraries_;  ///< in the order of their lines
    std::vector<Entry> entries_;
    std::unordered_map<std::string, std::uint32_t> index_;  ///< of entries_, by the name in the OBJ
    std::vector<std::string> warnings_;
    std::set<std::string, std::less<>> lines_;  ///< mtllib lines that have been processed
    std::set<const MaterialLibrary*> loaded_;
    std::vector<std::filesystem::path> read_;
    std::optional<std::filesystem::path> firstMissing_;
    std::size_t missing_ = 0;
};

}  // namespace duolux
