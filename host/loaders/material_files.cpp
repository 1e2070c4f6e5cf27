#include "host/loaders/material_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "host/base/error.h"
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

}  // namespace

std::string withSlashes(std::string_view path) {
    std::string result(path);
    std::replace(result.begin(), result.end(), '\\', '/');
    return result;
}

std::optional<fs::path> MaterialFiles::find(const fs::path& folder, std::string_view name) {
    if (name.empty()) return std::nullopt;
    if (isFile(folder / name)) return folder / name;
    const std::string plain = withSlashes(plainName(name));
    for (const char* const extension : {"", ".mtl"}) {
        const fs::path path = folder / (plain + extension);
        if (isFile(path)) return path;
        if (auto found = findIgnoringCase(path)) return found;
        if (path.parent_path() == folder) continue;
        if (auto found = findIgnoringCase(folder / path.filename())) return found;
    }
    return std::nullopt;
}

std::optional<fs::path> MaterialFiles::findIgnoringCase(const fs::path& path) {
    const Folder& files = folder(path.parent_path());
    const std::string name = path.filename().string();
    if (std::binary_search(files.names.begin(), files.names.end(), name)) return path;
    const auto found = files.byLowerCase.find(lowerCase(name));
    if (found == files.byLowerCase.end()) return std::nullopt;
    return path.parent_path() / found->second;
}

const MaterialFiles::Folder& MaterialFiles::folder(const fs::path& path) {
    const auto [entry, isNew] = folders_.try_emplace(path);
    Folder& files = entry->second;
    if (!isNew) return files;
    std::error_code ec;
    for (fs::directory_iterator file(path.empty() ? "." : path, ec), end; !ec && file != end;
         file.increment(ec)) {
        const fs::path name = file->path().filename();
        if (lowerCase(name.extension().string()) == ".mtl") files.names.push_back(name.string());
    }
    std::sort(files.names.begin(), files.names.end());
    for (const std::string& name : files.names)
        files.byLowerCase.try_emplace(lowerCase(name), name);
    return files;
}

std::optional<std::string> MaterialFiles::nearestName(const fs::path& folderPath, std::string_view name) {
    return duolux::nearestName(name, folder(folderPath).names);
}

MaterialFiles::Loaded MaterialFiles::load(const fs::path& file) {
    std::error_code ec;
    const fs::path canonical = fs::canonical(file, ec);
    const auto [entry, isNew] = libraries_.try_emplace(ec ? file : canonical);
    if (!isNew) return {*entry->second, false};
    MaterialLibrary library;
    try {
        library = loadMtl(file, reading_);
    } catch (const InputError& e) {
        if (reading_ == Reading::kStrict) throw;
        library.warnings.push_back(fmt::format("{}: its materials are grey", e.what()));
    }
    entry->second = std::make_unique<const MaterialLibrary>(std::move(library));
    return {*entry->second, true};
}

std::vector<const MaterialLibrary*> MaterialFiles::libraries() const {
    std::vector<const MaterialLibrary*> all;
    for (const auto& [file, library] : libraries_)
        all.push_back(library.get());
    return all;
}

}  // namespace duolux
