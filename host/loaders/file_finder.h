#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace duolux {

/// A path with slashes in place of backslashes.
std::string withSlashes(std::string_view path);

/// Names that other files give to files of one kind.
struct FileNames {
    /// In lower case, with the dot; may be missing in names.
    std::span<const std::string_view> extensions;
    /// Whether a file of another spelling must have one of them.
    bool onlyThese = true;
};

inline constexpr std::array<std::string_view, 5> kImageExtensions{".png", ".jpg", ".jpeg", ".exr", ".hdr"};
/// Images, which are recognised by their content.
inline constexpr FileNames kImageNames{kImageExtensions, false};

/// Finds files that other files name, maybe in the manner of another system. Folders are listed once.
class FileFinder {
  public:
    /// Finds the file to which a file in `folder` refers. Tries the name as it is, without quotes, with
    /// slashes in place of backslashes, with an extension added, in another case, and (for a path from
    /// another machine) in the folder itself.
    std::optional<std::filesystem::path> find(const std::filesystem::path& folder, std::string_view name,
                                              const FileNames& names);

    /// The name of the file in `folder` with such an extension that is most similar to a name, if any.
    std::optional<std::string> nearestName(const std::filesystem::path& folder, std::string_view name,
                                           const FileNames& names);

  private:
    struct Folder {
        std::vector<std::string> names;                            ///< of files, sorted
        std::unordered_map<std::string, std::string> byLowerCase;  ///< the first of each
    };

    const Folder& folder(const std::filesystem::path& path);
    std::optional<std::filesystem::path> findIgnoringCase(const std::filesystem::path& path,
                                                          const FileNames& names);

    std::map<std::filesystem::path, Folder> folders_;
};

}  // namespace duolux
