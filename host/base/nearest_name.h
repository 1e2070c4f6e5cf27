#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace duolux {

/// The smallest number of insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`
/// (restricted Damerau-Levenshtein distance, ignoring ASCII case).
std::size_t editDistance(std::string_view a, std::string_view b);

/// The name in `known` of which `unknown` may be a misspelling, if any.
std::optional<std::string> nearestName(std::string_view unknown, std::span<const std::string> known);

/// The remedy for an unknown name: `did you mean "vfov"?` if one of `known` is similar, otherwise `expected
/// one of "position", "target" ...`.
std::string suggestName(std::string_view unknown, std::span<const std::string> known);

}  // namespace duolux
