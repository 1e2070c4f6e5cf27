#include "host/loaders/obj_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "host/base/nearest_name.h"
#include "host/base/printable.h"
#include "host/base/text.h"
#include "host/loaders/source_text.h"
#include "host/loaders/tally.h"

namespace duolux {

namespace fs = std::filesystem;

namespace {

bool namesMtlFile(std::string_view name) {
    return lowerCase(fs::path(name).extension().string()) == ".mtl";
}

/// Splits a line into words and quoted texts, up to a comment.
std::vector<std::string_view> wordsOf(std::string_view names) {
    std::vector<std::string_view> words;
    for (std::string_view rest = trimmed(names); !rest.empty() && rest.front() != '#'; rest = trimmed(rest)) {
        const std::size_t quote = rest.front() == '"' ? rest.find('"', 1) : std::string_view::npos;
        const bool isQuoted = quote != std::string_view::npos;
        const std::string_view word = isQuoted ? rest.substr(1, quote - 1) : firstWord(rest);
        rest.remove_prefix(isQuoted ? quote + 1 : word.size());
        if (!word.empty()) words.push_back(word);
    }
    return words;
}

}  // namespace

ObjMaterials::ObjMaterials(fs::path mesh, MaterialFiles& files) : mesh_(std::move(mesh)), files_(files) {}

void ObjMaterials::load(std::string_view names) {
    if (!lines_.emplace(names).second) return;
    for (const fs::path& file : filesOf(names)) {
        const auto [library, isNew] = files_.load(file);
        if (!loaded_.insert(&library).second) continue;
        libraries_.push_back(&library);
        read_.push_back(file);
        if (isNew) warnings_.insert(warnings_.end(), library.warnings.begin(), library.warnings.end());
    }
}

/// Reads the whole line as one name with blanks if such a file exists, otherwise every word as a name.
std::vector<fs::path> ObjMaterials::filesOf(std::string_view names) {
    const fs::path folder = mesh_.parent_path();
    if (auto whole = files_.find(folder, names)) return {*std::move(whole)};
    const std::string_view uncommented = withoutComment(names);
    if (auto whole = files_.find(folder, uncommented)) return {*std::move(whole)};
    const std::vector<std::string_view> words = wordsOf(names);
    std::vector<fs::path> files;
    std::vector<std::string_view> missing;
    for (const std::string_view word : words) {
        if (auto file = files_.find(folder, word)) {
            files.push_back(*std::move(file));
        } else {
            missing.push_back(word);
        }
    }
    // "my colours.mtl" is a single name.
    if (files.empty() && std::count_if(words.begin(), words.end(), namesMtlFile) == 1)
        missing = {plainName(uncommented)};
    for (const std::string_view name : missing)
        noteMissing(name);
    return files;
}

void ObjMaterials::noteMissing(std::string_view name) {
    if (missing_++ > 0) return;
    firstMissing_ = mesh_.parent_path() / withSlashes(name);
    if (files_.reading() != Reading::kStrict) return;
    const auto nearest = files_.nearestName(firstMissing_->parent_path(), firstMissing_->filename().string());
    throw InputError(firstMissing_->string(), "", "no such file",
                     nearest ? fmt::format("did you mean {}?", inQuotes(*nearest))
                             : fmt::format("expected the MTL file that {} names", mesh_.string()));
}

std::uint32_t ObjMaterials::find(const std::string& name) {
    const auto [entry, isNew] = index_.try_emplace(name, static_cast<std::uint32_t>(entries_.size()));
    if (isNew) entries_.push_back(entryFor(name));
    return entry->second;
}

/// Looks for the name as it is, then without comment and quotes.
ObjMaterials::Entry ObjMaterials::entryFor(const std::string& name) const {
    Entry entry;
    entry.material.name = name.empty() ? kDefaultMaterialName : name;
    if (name.empty()) return entry;
    const auto take = [&](const auto& names, const MaterialLibrary& library, const std::string& wanted) {
        const auto found = names.find(wanted);
        if (found == names.end()) return false;
        entry.material = library.materials[found->second];
        entry.material.name = wanted;
        entry.library = &library;
        const auto unusable = library.unusable.find(found->second);
        if (unusable != library.unusable.end()) entry.unusable = &unusable->second;
        return true;
    };
    for (const MaterialLibrary* library : libraries_) {
        if (take(library->byName, *library, name)) return entry;
    }
    const std::string plain(plainName(name));
    for (const MaterialLibrary* library : libraries_) {
        if (take(library->byPlainName, *library, plain)) return entry;
    }
    entry.isDefined = false;
    return entry;
}

void ObjMaterials::warnOfMissing(Mesh& mesh) {
    if (!firstMissing_) return;
    const auto nearest = files_.nearestName(firstMissing_->parent_path(), firstMissing_->filename().string());
    std::string warning = fmt::format("{}: no such file: its materials are grey", firstMissing_->string());
    if (nearest) warning += fmt::format("; did you mean {}?", inQuotes(*nearest));
    if (missing_ > 1) warning += fmt::format(" ({} more MTL files are missing)", missing_ - 1);
    mesh.warnings.push_back(std::move(warning));
}

void ObjMaterials::warnOfUndefined(Mesh& mesh, const std::vector<bool>& used) const {
    const std::string* first = nullptr;
    std::size_t count = 0;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        if (!used[i] || entries_[i].isDefined) continue;
        if (count++ == 0) first = &entries_[i].material.name;
    }
    if (count == 0) return;
    const std::string what =
        fmt::format("material {}{} is not defined by any MTL file", inQuotes(*first), andMore(count));
    if (files_.reading() == Reading::kStrict) {
        throw InputError(mesh_.string(), "", what, "expected a newmtl of that name");
    }
    mesh.warnings.push_back(
        fmt::format("{}: {}: {}", mesh_.string(), what,
                    mesh.geometry.colours.empty() ? "grey 0.8 is used" : "the colours of vertices are used"));
}

/// Adds the images of a material to the mesh; `indices` are those of the mesh's images.
void ObjMaterials::moveImages(Entry& entry, ImageIndices& indices, Mesh& mesh) {
    for (MaterialTexture& use : entry.material.textures) {
        const ImageSource& image = entry.library->images[use.texture.image];
        const auto [index, isNew] =
            indices.try_emplace(image.identity(), static_cast<std::uint32_t>(mesh.images.size()));
        if (isNew) {
            mesh.images.push_back(image);
            mesh.files.push_back(image.path);
        }
        use.texture.image = index->second;
    }
}

void ObjMaterials::moveTo(Mesh& mesh) {
    const std::vector<bool> used = usedMaterials(mesh.geometry, entries_.size());
    std::move(read_.begin(), read_.end(), std::back_inserter(mesh.files));
    warnOfMissing(mesh);
    std::move(warnings_.begin(), warnings_.end(), std::back_inserter(mesh.warnings));
    warnOfUndefined(mesh, used);
    ImageIndices images;
    std::vector<std::uint32_t> kept(entries_.size(), 0);
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        Entry& entry = entries_[i];
        if (!used[i]) {
            mesh.unusedMaterials.push_back(std::move(entry.material.name));
            continue;
        }
        if (entry.unusable != nullptr) throw InputError(*entry.unusable);
        moveImages(entry, images, mesh);
        if (entry.library == nullptr && !mesh.geometry.colours.empty())
            entry.material.baseColor = glm::vec3(1.0f);
        kept[i] = static_cast<std::uint32_t>(mesh.materials.size());
        mesh.materials.push_back(std::move(entry.material));
    }
    for (std::uint32_t& material : mesh.geometry.materials)
        material = kept[material];
}

}  // namespace duolux
