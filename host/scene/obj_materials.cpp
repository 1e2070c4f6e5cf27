#include "host/scene/obj_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "host/base/printable.h"
#include "host/scene/file_kind.h"
#include "host/scene/mtl.h"
#include "host/scene/nearest_name.h"
#include "host/scene/source_text.h"

namespace duolux {

namespace fs = std::filesystem;

namespace {

bool isFile(const fs::path& path) {
    std::error_code ec;
    return fs::is_regular_file(path, ec);
}

std::string withSlashes(std::string_view name) {
    std::string result(name);
    std::replace(result.begin(), result.end(), '\\', '/');
    return result;
}

bool namesMtlFile(std::string_view name) {
    return editDistance(fs::path(name).extension().string(), ".mtl") == 0;
}

}  // namespace

ObjMaterials::ObjMaterials(fs::path mesh, Reading reading) : mesh_(std::move(mesh)), reading_(reading) {}

void ObjMaterials::load(std::string_view names) {
    if (!lines_.emplace(names).second) return;
    for (const fs::path& file : filesOf(names)) {
        if (loaded_.insert(file.lexically_normal()).second) loadFile(file);
    }
}

/// One whose name may hold blanks if there is such a file, else one a word.
std::vector<fs::path> ObjMaterials::filesOf(std::string_view names) {
    if (auto whole = existing(names)) return {*std::move(whole)};
    std::vector<std::string_view> words;
    for (std::string_view rest = names; !rest.empty();) {
        words.push_back(firstWord(rest));
        rest = trimmed(rest.substr(words.back().size()));
    }
    std::vector<fs::path> files;
    std::vector<std::string_view> missing;
    for (const std::string_view word : words) {
        if (auto file = words.size() == 1 ? std::nullopt : existing(word)) {
            files.push_back(*std::move(file));
        } else {
            missing.push_back(word);
        }
    }
    // "my colours.mtl" is one name.
    if (files.empty() && std::count_if(words.begin(), words.end(), namesMtlFile) == 1) missing = {names};
    for (const std::string_view name : missing) {
        if (!firstMissing_) firstMissing_ = mesh_.parent_path() / withSlashes(name);
        ++missing_;
    }
    return files;
}

/// The file of that name: as it is, without quotes, with backslashes as slashes, in another case, or (for a
/// path of another machine) beside the mesh.
std::optional<fs::path> ObjMaterials::existing(std::string_view name) {
    const fs::path folder = mesh_.parent_path();
    if (isFile(folder / name)) return folder / name;
    if (name.size() > 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
    const fs::path path = folder / withSlashes(name);
    if (isFile(path)) return path;
    if (auto found = existingIgnoringCase(path)) return found;
    return path.parent_path() == folder ? std::nullopt : existingIgnoringCase(folder / path.filename());
}

std::optional<fs::path> ObjMaterials::existingIgnoringCase(const fs::path& path) {
    const std::string name = path.filename().string();
    std::optional<fs::path> found;
    for (const std::string& file : filesIn(path.parent_path())) {
        if (file.size() != name.size() || editDistance(file, name) != 0) continue;
        if (file == name) return path;
        if (!found) found = path.parent_path() / file;
    }
    return found;
}

/// MTL files of the folder, sorted.
const std::vector<std::string>& ObjMaterials::filesIn(const fs::path& folder) {
    const auto [entry, isNew] = folders_.try_emplace(folder);
    if (!isNew) return entry->second;
    std::error_code ec;
    for (fs::directory_iterator file(folder.empty() ? "." : folder, ec), end; !ec && file != end;
         file.increment(ec)) {
        const std::string name = file->path().filename().string();
        if (namesMtlFile(name)) entry->second.push_back(name);
    }
    std::sort(entry->second.begin(), entry->second.end());
    return entry->second;
}

void ObjMaterials::loadFile(const fs::path& file) {
    read_.push_back(file);
    MaterialLibrary library;
    try {
        library = loadMtl(file, reading_);
    } catch (const ForeignFile& e) {
        if (reading_ == Reading::kStrict) throw;
        warnings_.push_back(fmt::format("{}: its materials are grey", e.what()));
        return;
    }
    for (Material& material : library.materials) {
        const auto next = static_cast<std::uint32_t>(materials_.size());
        if (index_.try_emplace(material.name, next).second) materials_.push_back(std::move(material));
    }
    std::move(library.warnings.begin(), library.warnings.end(), std::back_inserter(warnings_));
}

std::uint32_t ObjMaterials::find(const std::string& name) {
    const std::string& known = name.empty() ? kDefaultMaterialName : name;
    const auto [entry, isNew] = index_.try_emplace(known, static_cast<std::uint32_t>(materials_.size()));
    if (isNew) {
        materials_.emplace_back().name = known;
        if (!name.empty() && undefined_++ == 0) firstUndefined_ = name;
    }
    return entry->second;
}

std::string ObjMaterials::missingWarning() {
    const auto nearest =
        nearestName(firstMissing_->filename().string(), filesIn(firstMissing_->parent_path()));
    std::string warning = fmt::format("{}: no such file: its materials are grey", firstMissing_->string());
    if (nearest) warning += fmt::format("; did you mean {}?", inQuotes(*nearest));
    if (missing_ > 1) warning += fmt::format(" ({} more MTL files are missing)", missing_ - 1);
    return warning;
}

void ObjMaterials::moveTo(Mesh& mesh) {
    mesh.materials = std::move(materials_);
    std::move(read_.begin(), read_.end(), std::back_inserter(mesh.files));
    if (firstMissing_) mesh.warnings.push_back(missingWarning());
    std::move(warnings_.begin(), warnings_.end(), std::back_inserter(mesh.warnings));
    if (undefined_ > 0) {
        mesh.warnings.push_back(fmt::format(
            "{}: material {}{} is not defined by any MTL file: grey 0.8 is used", mesh_.string(),
            inQuotes(firstUndefined_), undefined_ == 1 ? "" : fmt::format(" (and {} more)", undefined_ - 1)));
    }
}

}  // namespace duolux
