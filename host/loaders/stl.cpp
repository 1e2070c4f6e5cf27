#include "host/loaders/stl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "host/base/error.h"
#include "host/base/hash.h"
#include "host/base/srgb.h"
#include "host/loaders/rounding.h"
#include "host/loaders/smooth_normals.h"
#include "host/loaders/stl_read.h"

namespace duolux {

namespace {

namespace fs = std::filesystem;

struct WeldedCorners {
    std::vector<glm::dvec3> positions;    ///< that differ from each other
    std::vector<std::uint32_t> vertices;  ///< per corner, an index into positions
};

/// Finds equal positions by a hash table with open addressing, at most half full.
WeldedCorners weld(const std::vector<glm::dvec3>& corners) {
    constexpr std::uint32_t kFree = 0xffffffffu;
    std::vector<std::uint32_t> table(std::bit_ceil(2 * corners.size() + 1), kFree);
    WeldedCorners welded;
    welded.vertices.reserve(corners.size());
    for (const glm::dvec3& corner : corners) {
        const glm::dvec3 position = corner + 0.0;  // -0 becomes 0
        std::size_t slot = hashOf(std::as_bytes(std::span(&position, 1))) & (table.size() - 1);
        while (table[slot] != kFree && welded.positions[table[slot]] != position)
            slot = (slot + 1) & (table.size() - 1);
        if (table[slot] == kFree) {
            table[slot] = static_cast<std::uint32_t>(welded.positions.size());
            welded.positions.push_back(position);
        }
        welded.vertices.push_back(table[slot]);
    }
    return welded;
}

/// Colours of facets in the two conventions for the attribute of a binary facet: VisCAM and SolidView set
/// bit 15 where the facet has a colour, blue in the lowest five bits; Magics, whose header has a colour,
/// clears it there, red in the lowest.
class FacetColours {
  public:
    explicit FacetColours(const StlFacets& facets)
        : facets_(facets),
          anyColour_(std::any_of(facets.attributes.begin(), facets.attributes.end(),
                                 [](std::uint16_t bits) { return bits != kAllBits; })) {}

    /// Sets the materials of the mesh, and of its triangles, which are the facets.
    void apply(Mesh& mesh) {
        const bool isMagics = facets_.colour.has_value();
        std::size_t unused = 0;
        mesh.geometry.materials.resize(facets_.count());
        for (std::size_t i = 0; i < facets_.count(); ++i) {
            const std::uint16_t bits = anyColour_ ? facets_.attributes[i] : std::uint16_t{0};
            const bool hasColour = anyColour_ && ((bits & kFlag) != 0) != isMagics;
            if (!hasColour && !isMagics && bits != 0) ++unused;
            mesh.geometry.materials[i] = hasColour  ? materialOf(mesh, colourOf(bits, isMagics))
                                         : isMagics ? materialOf(mesh, *facets_.colour)
                                                    : defaultMaterial(mesh);
        }
        if (unused == 0) return;
        mesh.warnings.push_back(
            fmt::format("{}: {} of {} facets have attributes that are no colours: ignored",
                        mesh.source.string(), unused, facets_.count()));
    }

  private:
    using Colour = std::array<std::uint8_t, 3>;
    static constexpr std::uint16_t kFlag = 0x8000, kAllBits = 0xffff;

    /// Five bits per channel, encoded by sRGB.
    static Colour colourOf(std::uint16_t bits, bool redIsLowest) {
        const auto channel = [&](unsigned shift) {
            return static_cast<std::uint8_t>((((bits >> shift) & 31u) * 255u + 15u) / 31u);
        };
        return redIsLowest ? Colour{channel(0), channel(5), channel(10)}
                           : Colour{channel(10), channel(5), channel(0)};
    }

    std::uint32_t materialOf(Mesh& mesh, const Colour& colour) {
        const auto [entry, isNew] =
            materials_.try_emplace(colour, static_cast<std::uint32_t>(mesh.materials.size()));
        if (isNew) {
            const auto& [red, green, blue] = colour;
            Material material;
            material.name = fmt::format("#{:02x}{:02x}{:02x}", red, green, blue);
            material.baseColor = {fromSrgb8(red), fromSrgb8(green), fromSrgb8(blue)};
            mesh.materials.push_back(std::move(material));
        }
        return entry->second;
    }

    std::uint32_t defaultMaterial(Mesh& mesh) {
        if (!default_) {
            default_ = static_cast<std::uint32_t>(mesh.materials.size());
            mesh.materials.emplace_back().name = kDefaultMaterialName;
        }
        return *default_;
    }

    const StlFacets& facets_;
    bool anyColour_;  ///< false also if all bits of all attributes are set, as Meshmixer writes
    std::map<Colour, std::uint32_t> materials_;
    std::optional<std::uint32_t> default_;
};

/// Warns if most normals of facets point to the side from which the corners are clockwise.
void compareNormals(const StlFacets& facets, Mesh& mesh) {
    std::size_t compared = 0, contrary = 0;
    for (std::size_t i = 0; i < facets.count(); ++i) {
        const glm::dvec3* const corner = &facets.corners[3 * i];
        const glm::dvec3 winding = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
        const double side = glm::dot(winding, glm::dvec3(facets.normals[i]));
        if (!std::isfinite(side) || side == 0.0) continue;
        ++compared;
        if (side < 0.0) ++contrary;
    }
    if (2 * contrary <= compared) return;
    mesh.warnings.push_back(fmt::format(
        "{}: the normals of {} of {} facets contradict the order of their vertices: the order is used",
        mesh.source.string(), contrary, facets.count()));
}

void setPositions(const StlFacets& facets, Mesh& mesh) {
    const WeldedCorners welded = weld(facets.corners);
    std::vector<std::uint32_t> ends(facets.count());
    for (std::size_t i = 0; i < ends.size(); ++i)
        ends[i] = static_cast<std::uint32_t>(3 * (i + 1));
    const std::array<PolygonView, 1> polygons{{{ends, welded.vertices}}};
    RoundedPositions rounded = roundPositions(welded.positions, polygons);
    const auto isTooLarge = [](const glm::vec3& position) {
        return !glm::all(glm::lessThanEqual(glm::abs(position), glm::vec3(kLargestCoordinate)));
    };
    mesh.geometry.triangles.resize(facets.count());
    for (std::size_t i = 0; i < facets.count(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = welded.vertices[3 * i + k];
            mesh.geometry.triangles[i][static_cast<int>(k)] = vertex;
            if (rounded.inRange || !isTooLarge(rounded.positions[vertex])) continue;
            throw InputError(mesh.source.string(), fmt::format("facet {} of {}", i + 1, facets.count()),
                             "a coordinate is too large",
                             fmt::format("expected at most {:g} in magnitude", kLargestCoordinate));
        }
    }
    warnOfLoss(mesh.source, rounded.loss, mesh.warnings);
    mesh.geometry.positions = std::move(rounded.positions);
    mesh.origin = rounded.origin;
}

}  // namespace

Mesh loadStl(const fs::path& path, MaterialFiles& files) {
    constexpr std::size_t kMostFacets = std::numeric_limits<std::int32_t>::max() / 3;
    Mesh mesh;
    mesh.source = path;
    mesh.files.push_back(path);
    mesh.camera.upwards = {0.0, 0.0, 1.0};
    StlFacets facets = readStl(path, files.reading());
    std::error_code ec;
    mesh.bytes = fs::file_size(path, ec);
    if (ec) mesh.bytes = 0;
    if (facets.count() == 0)
        throw InputError(path.string(), "", "has no facets", "expected at least one of three vertices");
    if (facets.count() > kMostFacets)
        throw InputError(path.string(), "", "is too large",
                         fmt::format("expected at most {} facets", kMostFacets));
    mesh.warnings = std::move(facets.warnings);
    setPositions(facets, mesh);
    FacetColours(facets).apply(mesh);
    compareNormals(facets, mesh);
    addNormalsByAngle(mesh.geometry, kStlCrease);
    return mesh;
}

}  // namespace duolux
