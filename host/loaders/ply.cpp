#include "host/loaders/ply.h"

#include <fmt/format.h>

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
#include "host/base/printable.h"
#include "host/loaders/file_finder.h"
#include "host/loaders/ply_body.h"
#include "host/loaders/ply_header.h"
#include "host/loaders/ply_oddities.h"
#include "host/loaders/ply_vertices.h"
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
    PlyLoader(const fs::path& path, MaterialFiles& files)
        : path_(path),
          files_(files),
          strict_(files.reading() == Reading::kStrict),
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
        setMaterial();
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

    void readVertices(const PlyElement& element) {
        PlyVertices vertices = readPlyVertices(element, body_, strict_, oddities_);
        positions_ = std::move(vertices.positions);
        mesh_.geometry.normals = std::move(vertices.normals);
        mesh_.geometry.colours = std::move(vertices.colours);
        takeAlphas(std::move(vertices.alphas));
        vertexUvs_ = std::move(vertices.uvs);
    }

    /// Keeps them if they matter.
    void takeAlphas(std::vector<float> alphas) {
        const auto isOpaque = [](float alpha) { return alpha == 1.0f; };
        if (std::all_of(alphas.begin(), alphas.end(), isOpaque)) return;
        if (std::all_of(alphas.begin(), alphas.end(), [](float alpha) { return alpha == 0.0f; })) {
            mesh_.warnings.push_back(
                fmt::format("{}: all vertices have alpha 0: alpha is ignored", path_.string()));
            return;
        }
        mesh_.geometry.alphas = std::move(alphas);
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
        const auto uvs = findCornerUvs(element);
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            // The number of a texture is that of the only one.
            const bool isNeutral = element.properties[i].name == "texnumber" && header_.textures.size() <= 1;
            if (i != *corners && i != uvs && !isNeutral) oddities_.noteUnused(element, element.properties[i]);
        }
        ends_.reserve(element.count);
        corners_.reserve(3 * element.count);
        std::vector<double> numbers;
        for (std::uint64_t face = 0; face < element.count; ++face) {
            const std::size_t firstCorner = corners_.size();
            body_.beginItem();
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                if (i == *corners) {
                    readCorners(element.properties[i], vertexCount);
                } else if (i == uvs) {
                    readNumbers(element.properties[i], numbers);
                } else {
                    body_.skip(element.properties[i]);
                }
            }
            if (uvs) addCornerUvs(corners_.size() - firstCorner, numbers);
            body_.endItem();
        }
    }

    /// Texture coordinates of the corners of each face, as MeshLab writes them.
    static std::optional<std::size_t> findCornerUvs(const PlyElement& element) {
        const auto found = element.find("texcoord");
        return found && element.properties[*found].isList() ? found : std::nullopt;
    }

    void readNumbers(const PlyProperty& list, std::vector<double>& numbers) {
        numbers.resize(body_.listLength(list));
        for (double& number : numbers)
            number = body_.value(list.type);
    }

    /// `numbers`: u and v of all corners of the face. Nothing is added for a face that is left out.
    void addCornerUvs(std::size_t corners, const std::vector<double>& numbers) {
        bool isGood = numbers.size() == 2 * corners;
        for (std::size_t i = 0; i < corners; ++i) {
            const glm::vec2 uv =
                numbers.size() == 2 * corners ? uvFromBelow(numbers[2 * i], numbers[2 * i + 1]) : kBadUv;
            isGood = isGood && uv != kBadUv;
            cornerUvs_.push_back(uv);
        }
        if (corners == 0 || isGood) return;
        tolerate(PlyOddity::kFaceUv,
                 "the texture coordinates are not two numbers for each corner, or too large",
                 "expected u and v of each corner");
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
            for (const auto& [a, b, c] : cut) {
                geometry.triangles.emplace_back(corners_[begin + a], corners_[begin + b],
                                                corners_[begin + c]);
                if (!cornerUvs_.empty()) geometry.uvIndices.emplace_back(begin + a, begin + b, begin + c);
            }
            begin = end;
        }
        geometry.materials.assign(geometry.triangles.size(), 0);
        setUvs();
        if (!geometry.normals.empty()) setNormals();
    }

    /// Those of corners come before those of vertices. A triangle has none if one of its corners has none.
    void setUvs() {
        Geometry& geometry = mesh_.geometry;
        if (cornerUvs_.empty() && vertexUvs_.empty()) return;
        if (cornerUvs_.empty()) geometry.uvIndices = geometry.triangles;
        geometry.uvs = std::move(cornerUvs_.empty() ? vertexUvs_ : cornerUvs_);
        for (glm::uvec3& indices : geometry.uvIndices) {
            for (int k = 0; k < 3; ++k) {
                if (geometry.uvs[indices[k]] != kBadUv) continue;
                indices = glm::uvec3(Geometry::kNoUv);
                break;
            }
        }
        std::replace(geometry.uvs.begin(), geometry.uvs.end(), kBadUv, glm::vec2(0.0f));
    }

    void setMaterial() {
        Material material;
        material.name = kDefaultMaterialName;
        if (!mesh_.geometry.colours.empty()) material.baseColor = glm::vec3(1.0f);
        if (!mesh_.geometry.alphas.empty()) material.alpha.mode = AlphaMode::kBlend;
        if (!header_.textures.empty()) setTextureOf(material);
        mesh_.materials.push_back(std::move(material));
    }

    void setTextureOf(Material& material) {
        const std::string& name = header_.textures.front();
        if (header_.textures.size() > 1) {
            mesh_.warnings.push_back(fmt::format("{}: names {} textures: only the first one is used",
                                                 path_.string(), header_.textures.size()));
        }
        const auto file = files_.finder().find(path_.parent_path(), name, kImageNames);
        if (!file) {
            const std::string problem = fmt::format("there is no texture {}", inQuotes(name));
            if (strict_) throw InputError(path_.string(), "", problem, "expected the path of an image");
            mesh_.warnings.push_back(
                fmt::format("{}: {}: the material is without it", path_.string(), problem));
            return;
        }
        material.baseColor = glm::vec3(1.0f);
        MaterialTexture texture;
        texture.texture.colourSpace = ColourSpace::kSrgb;
        material.textures.push_back(texture);
        mesh_.images.push_back({file->string(), *file, nullptr});
        mesh_.files.push_back(*file);
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

    const fs::path path_;
    MaterialFiles& files_;
    const bool strict_;
    const std::string bytes_;
    const PlyHeader header_;
    PlyBody body_;
    Mesh mesh_;
    std::vector<glm::dvec3> positions_;
    std::vector<std::uint32_t> ends_, corners_;     ///< see PolygonView
    std::vector<glm::vec2> vertexUvs_, cornerUvs_;  ///< v down the image, or kBadUv; may be empty
    std::optional<InputError> badFace_;             ///< the first that is left out because of its vertices
    PlyOddities oddities_;
};

}  // namespace

Mesh loadPly(const fs::path& path, MaterialFiles& files) {
    return PlyLoader(path, files).run();
}

}  // namespace duolux
