#include "host/loaders/material_files.h"

#include <fmt/format.h>

#include <array>
#include <system_error>
#include <utility>

#include "host/base/error.h"

namespace duolux {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 1> kMtlExtensions{".mtl"};
constexpr FileNames kMtlNames{kMtlExtensions};

}  // namespace

std::optional<fs::path> MaterialFiles::find(const fs::path& folder, std::string_view name) {
    return finder_.find(folder, name, kMtlNames);
}

std::optional<std::string> MaterialFiles::nearestName(const fs::path& folder, std::string_view name) {
    return finder_.nearestName(folder, name, kMtlNames);
}

MaterialFiles::Loaded MaterialFiles::load(const fs::path& file) {
    std::error_code ec;
    const fs::path canonical = fs::canonical(file, ec);
    const auto [entry, isNew] = libraries_.try_emplace(ec ? file : canonical);
    if (!isNew) return {*entry->second, false};
    MaterialLibrary library;
    try {
        library = loadMtl(file, finder_, reading_);
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
