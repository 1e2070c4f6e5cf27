#include "host/loaders/gltf_notes.h"

#include <fmt/format.h>

namespace duolux {

void GltfNotes::tolerate(const JsonNode& node, std::string_view problem, std::string_view remedy,
                         std::string_view consequence) {
    if (strict_) node.fail(problem, remedy);
    ignore(node, problem, consequence);
}

void GltfNotes::ignore(const JsonNode& node, std::string_view what, std::string_view consequence) {
    const auto [entry, isNew] =
        indices_.try_emplace({std::string(what), std::string(consequence)}, notes_.size());
    if (isNew) {
        notes_.push_back({fmt::format("{}: {}", node.file().string(), node.path()), std::string(what),
                          std::string(consequence), 0});
    }
    ++notes_[entry->second].count;
}

void GltfNotes::warn(std::vector<std::string>& warnings) const {
    for (const Note& note : notes_) {
        warnings.push_back(
            fmt::format("{}: {}{}: {}", note.place, note.what, andMore(note.count), note.consequence));
    }
}

}  // namespace duolux
