#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "host/scene/mtl.h"
#include "host/scene/tally.h"

namespace duolux {

/// The MTL files that the meshes of a scene name: each is looked for and read once.
class MaterialFiles {
  public:
    explicit MaterialFiles(Reading reading) : reading_(reading) {}

    Reading reading() const { return reading_; }

    /// The file that a mesh in `folder` means: of that name, or without quotes, with backslashes as slashes,
    /// with the extension, in another case, or (for a path of another machine) beside the mesh.
    std::optional<std::filesystem::path> find(const std::filesystem::path& folder, std::string_view name);

    /// `isNew` the first time. A file that cannot be read defines nothing, with a warning, unless reading is
    /// strict: then throws InputError.
    struct Loaded {
        const MaterialLibrary& library;
        bool isNew;
    };
    Loaded load(const std::filesystem::path& file);

    /// Of the MTL file in `folder` that has nearly that name.
    std::optional<std::string> nearestName(const std::filesystem::path& folder, std::string_view name);

    /// All that were read.
    std::vector<const MaterialLibrary*> libraries() const;

  private:
    struct Folder {
        std::vector<std::string> names;                            ///< of MTL files, sorted
        std::unordered_map<std::string, std::string> byLowerCase;  ///< the first of each
    };

    const Folder& folder(const std::filesystem::path& path);
    std::optional<std::filesystem::path> findIgnoringCase(const std::filesystem::path& path);

    Reading reading_;
    std::map<std::filesystem::path, Folder> folders_;
    std::map<std::filesystem::path, std::unique_ptr<const MaterialLibrary>> libraries_;
};

}  // namespace duolux
