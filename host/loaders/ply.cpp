#include "host/loaders/ply.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/base/srgb.h"
#include "host/loaders/ply_body.h"
#include "host/loaders/ply_header.h"
#include "host/loaders/ply_oddities.h"
#include "host/loaders/rounding.h"
#include "host/loaders/tally.h"
#include "host/loaders/triangulate.h"

namespace duolux {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostCorners = std::numeric_limits<std::int32_t>::max();

/// Loads one file.
class PlyLoader {
  public:
    PlyLoader(const fs::path& path, Reading reading)
        : path_(path),
          strict_(reading == Reading::kStrict),
          bytes_(readFile(path)),
          header_(readPlyHeader(path, bytes_)),
          body_(path_, bytes_, header_) {
        mesh_.source = path;
        mesh_.files.push_back(path);
        mesh_.bytes = bytes_.size();
    }

    Mesh run() {
        const PlyElement& vertices = required("vertex");
        const PlyElement& faces = required("face");
        std::size_t left = 2;  // elements after both are not read
        for (const PlyElement& element : header_.elements) {
            if (left == 0) break;
            if (&element == &vertices || &element == &faces) {
                body_.beginElement(element);
                if (&element == &vertices) readVertices(element);
                if (&element == &faces) readFaces(element, vertices.count);
                --left;
            } else {
                body_.skipElement(element);
            }
        }
        if (ends_.empty()) failWithoutFaces();
        settlePositions();
        triangulateFaces();
        mesh_.materials.emplace_back();
        mesh_.materials.back().name = kDefaultMaterialName;
        if (!mesh_.geometry.colours.empty()) mesh_.materials.back().baseColor = glm::vec3(1.0f);
        oddities_.countOverlongLines(body_.overlongItems());
        oddities_.warn(path_, header_, mesh_.warnings);
        return std::move(mesh_);
    }

  private:
    const PlyElement& required(std::string_view name) const {
        const PlyElement* const element = header_.find(name);
        if (element == nullptr) {
            throw InputError(path_.string(), "", fmt::format("has no element \"{}\"", name),
                             name == "face"
                                 ? "expected a mesh; point clouds and triangle strips are not supported"
                                 : "expected a mesh");
        }
        if (element->count > kMostCorners) {
            throw InputError(path_.string(), fmt::format("element {}", name), "is too large",
                             "expected fewer than 2^31 vertices and faces");
        }
        return *element;
    }

    /// The indices of three properties; empty unless all are there and none is a list.
    std::optional<std::array<std::size_t, 3>> triple(const PlyElement& element,
                                                     const std::array<std::string_view, 3>& names) const {
        std::array<std::size_t, 3> found{};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto index = element.find(names[i]);
            if (!index || element.properties[*index].isList()) return std::nullopt;
            found[i] = *index;
        }
        return found;
    }

    void noteUnused(const PlyElement& element, const std::vector<bool>& used) {
        for (std::size_t i = 0; i < used.size(); ++i) {
            if (!used[i]) oddities_.noteUnused(element, element.properties[i]);
        }
    }

    void readVertices(const PlyElement& element) {
        const auto position = triple(element, {"x", "y", "z"});
        if (!position) {
            throw InputError(path_.string(), "element vertex", "has no coordinates",
                             "expected the properties x, y and z, which are no lists");
        }
        const auto normal = triple(element, {"nx", "ny", "nz"});
        const std::size_t count = element.properties.size();
        std::vector<bool> used(count, false);
        // Where each property goes in `values`.
        std::vector<std::size_t> slots(count, kSkipped);
        const auto assign = [&](const auto& indices, std::size_t first) {
            if (!indices) return;
            for (std::size_t i = 0; i < 3; ++i) {
                slots[(*indices)[i]] = first + i;
                used[(*indices)[i]] = true;
            }
        };
        assign(position, kPosition);
        assign(normal, kNormal);
        const auto colour = colourOf(element);
        assign(colour, kColour);
        const std::optional<std::size_t> alpha = colour ? element.find("alpha") : std::nullopt;
        if (alpha && !element.properties[*alpha].isList()) {
            slots[*alpha] = kAlpha;
            used[*alpha] = true;
        }
        noteUnused(element, used);

        positions_.reserve(element.count);
        if (normal) mesh_.geometry.normals.reserve(element.count);
        if (colour) mesh_.geometry.colours.reserve(element.count);
        std::array<double, kSlots> values{};
        values[kAlpha] = 1.0;
        for (std::uint64_t vertex = 0; vertex < element.count; ++vertex) {
            body_.beginItem();
            for (std::size_t i = 0; i < count; ++i) {
                const PlyProperty& property = element.properties[i];
                if (slots[i] == kSkipped) {
                    body_.skip(property);
                } else {
                    const double value = body_.value(property.type);
                    values[slots[i]] = slots[i] < kColour ? value : value / unitOf(property.type);
                }
            }
            body_.endItem();
            positions_.emplace_back(values[kPosition], values[kPosition + 1], values[kPosition + 2]);
            if (normal) addNormal({values[kNormal], values[kNormal + 1], values[kNormal + 2]});
            if (colour)
                addColour({values[kColour], values[kColour + 1], values[kColour + 2]}, values[kAlpha]);
        }
    }

    void addNormal(const glm::dvec3& normal) {
        const double length = glm::length(normal);
        const bool isGood = length > 0.0 && std::isfinite(length);
        if (!isGood) {
            tolerate(PlyOddity::kNormal, "the normal is 0 or not finite", "expected a direction");
        }
        mesh_.geometry.normals.push_back(isGood ? glm::vec3(normal / length) : glm::vec3(0.0f));
    }

    std::optional<std::array<std::size_t, 3>> colourOf(const PlyElement& element) const {
        constexpr std::array<std::array<std::string_view, 3>, 3> kNames{
            {{"red", "green", "blue"}, {"diffuse_red", "diffuse_green", "diffuse_blue"}, {"r", "g", "b"}}};
        for (const auto& names : kNames) {
            if (const auto found = triple(element, names)) return found;
        }
        return std::nullopt;
    }

    /// `colour`: encoded by the transfer function of sRGB.
    void addColour(const glm::dvec3& colour, double alpha) {
        glm::vec3 linear;
        bool isGood = true;
        for (int i = 0; i < 3; ++i) {
            isGood = isGood && colour[i] >= 0.0 && colour[i] <= 1.0;
            // Also 0 for what is not a number.
            linear[i] = colour[i] > 0.0 ? static_cast<float>(srgbDecode(std::min(colour[i], 1.0))) : 0.0f;
        }
        if (!isGood) tolerate(PlyOddity::kColour, "a colour is not between 0 and 1", "expected 0 to 1");
        if (alpha < 1.0) oddities_.count(PlyOddity::kAlpha, [&] { return body_.place(); });
        mesh_.geometry.colours.push_back(linear);
    }

    static std::optional<std::size_t> findCorners(const PlyElement& element) {
        for (const char* const name : {"vertex_indices", "vertex_index"}) {
            if (const auto found = element.find(name); found && element.properties[*found].isList())
                return found;
        }
        const bool onlyOne = element.properties.size() == 1 && element.properties.front().isList();
        return onlyOne ? std::optional<std::size_t>(0) : std::nullopt;
    }

    void readFaces(const PlyElement& element, std::uint64_t vertexCount) {
        const auto corners = findCorners(element);
        if (!corners) {
            throw InputError(path_.string(), "element face", "has no corners",
                             "expected a property such as \"list uchar int vertex_indices\"");
        }
        std::vector<bool> used(element.properties.size(), false);
        used[*corners] = true;
        noteUnused(element, used);
        ends_.reserve(element.count);
        corners_.reserve(3 * element.count);
        for (std::uint64_t face = 0; face < element.count; ++face) {
            body_.beginItem();
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                if (i == *corners) {
                    readCorners(element.properties[i], vertexCount);
                } else {
                    body_.skip(element.properties[i]);
                }
            }
            body_.endItem();
        }
    }

    void readCorners(const PlyProperty& list, std::uint64_t vertexCount) {
        const std::size_t begin = corners_.size();
        const std::size_t length = body_.listLength(list);
        std::optional<double> bad;
        for (std::size_t i = 0; i < length; ++i) {
            const double index = body_.value(list.type);
            const bool isGood =
                index >= 0.0 && index < static_cast<double>(vertexCount) && index == std::floor(index);
            if (!isGood && !bad) bad = index;
            corners_.push_back(isGood ? static_cast<std::uint32_t>(index) : 0);
        }
        if (corners_.size() > kMostCorners) {
            throw InputError(path_.string(), "element face", "is too large",
                             "expected fewer than 2^31 corners of faces");
        }
        if (length >= 3 && !bad) {
            ends_.push_back(static_cast<std::uint32_t>(corners_.size()));
            return;
        }
        corners_.resize(begin);
        if (bad) {
            const std::string problem = fmt::format("vertex index {} is out of range", *bad);
            const std::string remedy = vertexCount == 0 ? std::string("there are no vertices")
                                                        : fmt::format("expected 0 to {}", vertexCount - 1);
            if (!badFace_) badFace_ = body_.error(problem, remedy);
            tolerate(PlyOddity::kBadFace, problem, remedy);
        } else {
            tolerate(PlyOddity::kShortFace, fmt::format("{} corners", length), "expected at least 3");
        }
    }

    [[noreturn]] void failWithoutFaces() const {
        if (badFace_) throw InputError(*badFace_);
        throw InputError(path_.string(), "", "has no faces", "expected at least one of 3 corners or more");
    }

    /// Vertices that are not finite or too large are an error if a face uses them.
    void settlePositions() {
        const std::array<PolygonView, 1> polygons{{{ends_, corners_}}};
        const std::vector<bool> used = usedVertices(positions_.size(), polygons);
        for (std::size_t i = 0; i < positions_.size(); ++i) {
            glm::dvec3& position = positions_[i];
            if (std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z)) continue;
            settleBadVertex(i, used[i]);
            position = glm::dvec3(0.0);
        }
        RoundedPositions rounded = roundPositions(positions_, polygons);
        for (std::size_t i = 0; !rounded.inRange && i < positions_.size(); ++i) {
            glm::vec3& position = rounded.positions[i];
            if (glm::all(glm::lessThanEqual(glm::abs(position), glm::vec3(kLargestCoordinate)))) continue;
            settleBadVertex(i, used[i]);
            position = glm::vec3(0.0f);
        }
        warnOfLoss(path_, rounded.loss, mesh_.warnings);
        mesh_.geometry.positions = std::move(rounded.positions);
        mesh_.origin = rounded.origin;
    }

    void settleBadVertex(std::size_t vertex, bool used) {
        const std::string place = fmt::format("vertex {} of {}", vertex + 1, positions_.size());
        if (used || strict_) {
            throw InputError(path_.string(), place, "a coordinate is not finite or too large",
                             fmt::format("expected at most {:g} in magnitude", kLargestCoordinate));
        }
        oddities_.count(PlyOddity::kUnusedVertex, [&] { return place; });
    }

    void triangulateFaces() {
        Geometry& geometry = mesh_.geometry;
        geometry.triangles.reserve(corners_.size() - 2 * ends_.size());
        std::vector<glm::vec3> polygon;
        std::vector<std::array<std::uint32_t, 3>> cut;
        std::uint32_t begin = 0;
        for (const std::uint32_t end : ends_) {
            cut.clear();
            polygon.clear();
            for (std::uint32_t i = begin; i < end; ++i)
                polygon.push_back(geometry.positions[corners_[i]]);
            triangulate(polygon, cut);
            for (const auto& [a, b, c] : cut)
                geometry.triangles.emplace_back(corners_[begin + a], corners_[begin + b],
                                                corners_[begin + c]);
            begin = end;
        }
        geometry.materials.assign(geometry.triangles.size(), 0);
        if (!geometry.normals.empty()) setNormals();
    }

    /// A triangle is flat if one of its corners has no valid normal.
    void setNormals() {
        Geometry& geometry = mesh_.geometry;
        const auto isZero = [&](std::uint32_t vertex) { return geometry.normals[vertex] == glm::vec3(0.0f); };
        for (const glm::uvec3& triangle : geometry.triangles) {
            const bool isFlat = isZero(triangle.x) || isZero(triangle.y) || isZero(triangle.z);
            geometry.normalIndices.push_back(isFlat ? glm::uvec3(Geometry::kNoNormal) : triangle);
        }
    }

    /// Counts an error in the current item, or throws it in strict reading.
    void tolerate(PlyOddity oddity, std::string_view problem, std::string_view remedy) {
        if (strict_) throw body_.error(problem, remedy);
        oddities_.count(oddity, [&] { return body_.place(); });
    }

    /// Of the values of a vertex.
    static constexpr std::size_t kPosition = 0, kNormal = 3, kColour = 6, kAlpha = 9, kSlots = 10,
                                 kSkipped = kSlots;

    const fs::path path_;
    const bool strict_;
    const std::string bytes_;
    const PlyHeader header_;
    PlyBody body_;
    Mesh mesh_;
    std::vector<glm::dvec3> positions_;
    std::vector<std::uint32_t> ends_, corners_;  ///< see PolygonView
    std::optional<InputError> badFace_;          ///< the first that is left out because of its vertices
    PlyOddities oddities_;
};

}  // namespace

Mesh loadPly(const fs::path& path, MaterialFiles& files) {
    return PlyLoader(path, files.reading()).run();
}

}  // namespace duolux
