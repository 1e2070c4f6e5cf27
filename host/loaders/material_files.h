#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/loaders/file_finder.h"
#include "host/loaders/mtl.h"
#include "host/loaders/tally.h"

namespace duolux {

/// The MTL files that the meshes of a scene name. Each file is searched for and read once.
class MaterialFiles {
  public:
    explicit MaterialFiles(Reading reading) : reading_(reading) {}

    Reading reading() const { return reading_; }
    FileFinder& finder() { return finder_; }

    /// Finds the MTL file to which a mesh in `folder` refers, see FileFinder.
    std::optional<std::filesystem::path> find(const std::filesystem::path& folder, std::string_view name);

    /// `isNew` is true the first time. A file that cannot be read defines no material and gives a warning; in
    /// strict reading it throws InputError.
    struct Loaded {
        const MaterialLibrary& library;
        bool isNew;
    };
    Loaded load(const std::filesystem::path& file);

    /// The name of the MTL file in `folder` that is most similar to a name, if any.
    std::optional<std::string> nearestName(const std::filesystem::path& folder, std::string_view name);

    /// All files that were read.
    std::vector<const MaterialLibrary*> libraries() const;

  private:
    Reading reading_;
    FileFinder finder_;
    std::map<std::filesystem::path, std::unique_ptr<const MaterialLibrary>> libraries_;
};

}  // namespace duolux
