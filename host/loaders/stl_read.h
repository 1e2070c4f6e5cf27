#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/loaders/tally.h"

namespace duolux {

/// The facets of an STL file in the order of the file.
struct StlFacets {
    std::vector<glm::dvec3> corners;        ///< three per facet, finite
    std::vector<glm::vec3> normals;         ///< one per facet, as in the file, maybe 0 or not finite
    std::vector<std::uint16_t> attributes;  ///< one per facet, of binary files
    /// Red, green, blue of facets without a colour of their own, from a header by Materialise Magics.
    std::optional<std::array<std::uint8_t, 3>> colour;
    std::vector<std::string> warnings;

    std::size_t count() const { return normals.size(); }
};

/// Throws InputError.
StlFacets readStl(const std::filesystem::path& path, Reading reading);

}  // namespace duolux
