#include "host/loaders/file_finder.h"

#include <algorithm>
#include <system_error>

#include "host/base/nearest_name.h"
#include "host/base/text.h"
#include "host/loaders/source_text.h"

namespace duolux {

namespace fs = std::filesystem;

namespace {

bool isFile(const fs::path& path) {
    std::error_code ec;
    return fs::is_regular_file(path, ec);
}

bool hasExtension(const std::string& name, const FileNames& names) {
    const std::string extension = lowerCase(fs::path(name).extension().string());
    return std::find(names.extensions.begin(), names.extensions.end(), extension) != names.extensions.end();
}

}  // namespace

std::string withSlashes(std::string_view path) {
    std::string result(path);
    std::replace(result.begin(), result.end(), '\\', '/');
    return result;
}

std::optional<fs::path> FileFinder::find(const fs::path& folder, std::string_view name,
                                         const FileNames& names) {
    if (name.empty()) return std::nullopt;
    if (isFile(folder / name)) return folder / name;
    const std::string plain = withSlashes(plainName(name));
    std::vector<std::string_view> endings{""};
    endings.insert(endings.end(), names.extensions.begin(), names.extensions.end());
    for (const std::string_view ending : endings) {
        const fs::path path = folder / (plain + std::string(ending));
        if (isFile(path)) return path;
        if (auto found = findIgnoringCase(path, names)) return found;
        if (path.parent_path() == folder) continue;
        if (auto found = findIgnoringCase(folder / path.filename(), names)) return found;
    }
    return std::nullopt;
}

std::optional<fs::path> FileFinder::findIgnoringCase(const fs::path& path, const FileNames& names) {
    const Folder& files = folder(path.parent_path());
    const std::string name = path.filename().string();
    const auto isOfKind = [&](const std::string& found) {
        return !names.onlyThese || hasExtension(found, names);
    };
    if (std::binary_search(files.names.begin(), files.names.end(), name) && isOfKind(name)) return path;
    const auto found = files.byLowerCase.find(lowerCase(name));
    if (found == files.byLowerCase.end() || !isOfKind(found->second)) return std::nullopt;
    return path.parent_path() / found->second;
}

const FileFinder::Folder& FileFinder::folder(const fs::path& path) {
    const auto [entry, isNew] = folders_.try_emplace(path);
    Folder& files = entry->second;
    if (!isNew) return files;
    std::error_code ec;
    for (fs::directory_iterator file(path.empty() ? "." : path, ec), end; !ec && file != end;
         file.increment(ec)) {
        std::error_code unknown;
        if (!file->is_directory(unknown)) files.names.push_back(file->path().filename().string());
    }
    std::sort(files.names.begin(), files.names.end());
    for (const std::string& name : files.names)
        files.byLowerCase.try_emplace(lowerCase(name), name);
    return files;
}

std::optional<std::string> FileFinder::nearestName(const fs::path& folderPath, std::string_view name,
                                                   const FileNames& names) {
    std::vector<std::string> candidates;
    for (const std::string& candidate : folder(folderPath).names) {
        if (hasExtension(candidate, names)) candidates.push_back(candidate);
    }
    return duolux::nearestName(name, candidates);
}

}  // namespace duolux
