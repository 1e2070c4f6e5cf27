#include "host/loaders/mtl_images.h"

namespace duolux {

std::optional<std::uint32_t> MtlImages::fileOf(std::string_view name) {
    const auto [entry, isNew] = byName_.try_emplace(std::string(name));
    if (!isNew) return entry->second;
    const auto file = finder_.find(folder_, name, kImageNames);
    if (!file) return std::nullopt;
    const auto [index, isNewFile] = byPath_.try_emplace(*file, static_cast<std::uint32_t>(files_.size()));
    if (isNewFile) files_.push_back(*file);
    return entry->second = index->second;
}

std::uint32_t MtlImages::indexOf(std::uint32_t file, const ImageConversion& conversion) {
    const auto [entry, isNew] =
        indices_.try_emplace({file, conversion}, static_cast<std::uint32_t>(sources_.size()));
    if (isNew) sources_.push_back({files_[file].string(), files_[file], nullptr, conversion});
    return entry->second;
}

}  // namespace duolux
