#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace duolux {

/// With small ASCII letters.
std::string lowerCase(std::string_view text);

/// The smallest number of insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`
/// (restricted Damerau-Levenshtein distance; ASCII case does not count).
std::size_t editDistance(std::string_view a, std::string_view b);

/// One of `known` that `unknown` may be a misspelling of.
std::optional<std::string> nearestName(std::string_view unknown, std::span<const std::string> known);

/// For messages about an unknown name: `did you mean "vfov"?` if one of `known` is near, else `expected one
/// of "position", "target" ...`.
std::string suggestName(std::string_view unknown, std::span<const std::string> known);

}  // namespace duolux
