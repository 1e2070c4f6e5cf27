#include "host/loaders/obj.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "host/base/error.h"
#include "host/base/parallel.h"
#include "host/loaders/obj_materials.h"
#include "host/loaders/obj_parse.h"
#include "host/loaders/smooth_normals.h"
#include "host/loaders/source_text.h"
#include "host/loaders/triangulate.h"

namespace duolux {

namespace {

namespace fs = std::filesystem;

/// The state at the first face of a part, and the position of its triangles in the geometry.
struct PartStart {
    std::size_t firstTriangle = 0;
    std::uint32_t material = 0;
    std::uint32_t smoothing = 0;
    std::vector<std::uint32_t> materialIds;  ///< of ObjPart::materials
};

/// Propagates the current state from part to part.
std::vector<PartStart> findStarts(const ObjFile& file, ObjMaterials& table) {
    std::vector<PartStart> starts(file.parts.size());
    std::size_t triangles = 0;
    std::optional<std::uint32_t> material;
    std::uint32_t smoothing = 0;
    for (std::size_t i = 0; i < file.parts.size(); ++i) {
        const ObjPart& part = file.parts[i];
        const bool facesFirst = part.materials.empty() || part.materials.front().face > 0;
        if (!material && facesFirst && !part.faceEnds.empty()) material = table.find("");
        starts[i].firstTriangle = triangles;
        starts[i].material = material.value_or(0);
        starts[i].smoothing = smoothing;
        for (const ObjPart::MaterialChange& change : part.materials) {
            material = table.find(change.name);
            starts[i].materialIds.push_back(*material);
        }
        if (!part.notes.smoothing.empty()) smoothing = part.notes.smoothing.back().group;
        triangles += part.cornerVertices.size() - 2 * part.faceEnds.size();
    }
    return starts;
}

/// Triangulates the polygons of one part, at their position in the geometry.
class PartTriangulator {
  public:
    PartTriangulator(const ObjFile& file, const ObjPart& part, const PartStart& start, Geometry& geometry,
                     std::span<std::uint32_t> groups)
        : file_(file), part_(part), start_(start), geometry_(geometry), groups_(groups) {}

    void run() {
        std::size_t triangle = start_.firstTriangle;
        std::size_t materialChange = 0, smoothingChange = 0;
        std::uint32_t material = start_.material, smoothing = start_.smoothing;
        std::uint32_t begin = 0;
        for (std::size_t face = 0; face < part_.faceEnds.size(); ++face) {
            while (materialChange < part_.materials.size() && part_.materials[materialChange].face <= face) {
                material = start_.materialIds[materialChange++];
            }
            const auto& changes = part_.notes.smoothing;
            while (smoothingChange < changes.size() && changes[smoothingChange].face <= face) {
                smoothing = changes[smoothingChange++].group;
            }
            const std::uint32_t end = part_.faceEnds[face];
            cut(begin, end);
            for (const auto& corners : triangles_) {
                geometry_.triangles[triangle] = glm::uvec3(
                    vertex(begin + corners[0]), vertex(begin + corners[1]), vertex(begin + corners[2]));
                geometry_.materials[triangle] = material;
                if (!groups_.empty()) groups_[triangle] = smoothing;
                if (!part_.cornerNormals.empty()) setNormals(triangle, begin, corners);
                if (!part_.cornerUvs.empty()) setUvs(triangle, begin, corners);
                ++triangle;
            }
            begin = end;
        }
    }

  private:
    std::uint32_t vertex(std::uint32_t corner) const { return part_.cornerVertices[corner]; }

    void cut(std::uint32_t begin, std::uint32_t end) {
        triangles_.clear();
        if (end - begin == 3) {
            triangles_.push_back({0, 1, 2});
            return;
        }
        polygon_.clear();
        for (std::uint32_t i = begin; i < end; ++i)
            polygon_.push_back(file_.rounded.positions[vertex(i)]);
        triangulate(polygon_, triangles_);
    }

    /// The triangle stays flat if one of its corners has no normal or a zero normal.
    void setNormals(std::size_t triangle, std::uint32_t begin, const std::array<std::uint32_t, 3>& corners) {
        glm::uvec3 normals;
        for (int i = 0; i < 3; ++i) {
            const std::size_t corner = begin + corners[static_cast<std::size_t>(i)];
            normals[i] =
                corner < part_.cornerNormals.size() ? part_.cornerNormals[corner] : Geometry::kNoNormal;
            if (normals[i] == Geometry::kNoNormal || file_.normals[normals[i]] == glm::vec3(0.0f)) return;
        }
        geometry_.normalIndices[triangle] = normals;
    }

    /// The triangle has no texture coordinates if one of its corners has none or invalid ones.
    void setUvs(std::size_t triangle, std::uint32_t begin, const std::array<std::uint32_t, 3>& corners) {
        glm::uvec3 uvs;
        for (int i = 0; i < 3; ++i) {
            const std::size_t corner = begin + corners[static_cast<std::size_t>(i)];
            uvs[i] = corner < part_.cornerUvs.size() ? part_.cornerUvs[corner] : Geometry::kNoUv;
            if (uvs[i] == Geometry::kNoUv || file_.uvs[uvs[i]] == kBadUv) return;
        }
        geometry_.uvIndices[triangle] = uvs;
    }

    const ObjFile& file_;
    const ObjPart& part_;
    const PartStart& start_;
    Geometry& geometry_;
    std::span<std::uint32_t> groups_;
    std::vector<glm::vec3> polygon_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
};

/// Invalid texture coordinates, which no triangle has, become 0.
void takeUvs(std::vector<glm::vec2> uvs, Geometry& geometry) {
    const auto hasUvs = [](const glm::uvec3& indices) { return indices.x != Geometry::kNoUv; };
    if (std::none_of(geometry.uvIndices.begin(), geometry.uvIndices.end(), hasUvs)) {
        geometry.uvIndices.clear();
        return;
    }
    std::replace(uvs.begin(), uvs.end(), kBadUv, glm::vec2(0.0f));
    geometry.uvs = std::move(uvs);
}

/// The colours of all vertices; empty if none has one.
std::vector<glm::vec3> coloursOf(const ObjFile& file) {
    std::vector<glm::vec3> colours;
    for (const ObjPart& part : file.parts) {
        if (part.colours.empty()) continue;
        if (colours.empty()) colours.resize(file.rounded.positions.size(), glm::vec3(1.0f));
        std::copy(part.colours.begin(), part.colours.end(),
                  colours.begin() + static_cast<std::ptrdiff_t>(part.firstVertex));
    }
    return colours;
}

Geometry buildGeometry(ObjFile file, const std::vector<PartStart>& starts) {
    std::size_t triangles = 0;
    bool anyNormal = false, anyGroup = false, anyUv = false;
    for (const ObjPart& part : file.parts) {
        triangles += part.cornerVertices.size() - 2 * part.faceEnds.size();
        anyNormal = anyNormal || !part.cornerNormals.empty();
        anyUv = anyUv || !part.cornerUvs.empty();
        for (const ObjNotes::Smoothing& change : part.notes.smoothing)
            anyGroup = anyGroup || change.group != 0;
    }
    Geometry geometry;
    geometry.colours = coloursOf(file);
    geometry.triangles.resize(triangles);
    geometry.materials.resize(triangles);
    if (anyNormal || anyGroup) geometry.normalIndices.assign(triangles, glm::uvec3(Geometry::kNoNormal));
    if (anyUv) geometry.uvIndices.assign(triangles, glm::uvec3(Geometry::kNoUv));
    std::vector<std::uint32_t> groups(anyGroup ? triangles : 0);
    parallelFor(file.parts.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            PartTriangulator(file, file.parts[i], starts[i], geometry, groups).run();
            file.parts[i] = ObjPart();  // frees the memory
        }
    });
    geometry.positions = std::move(file.rounded.positions);
    if (anyNormal) geometry.normals = std::move(file.normals);
    if (anyGroup) addSmoothNormals(geometry, groups);
    if (geometry.normals.empty()) geometry.normalIndices.clear();
    if (anyUv) takeUvs(std::move(file.uvs), geometry);
    return geometry;
}

}  // namespace

Mesh loadObj(const fs::path& path, MaterialFiles& files) {
    Mesh mesh;
    mesh.source = path;
    mesh.files.push_back(path);
    ObjFile file;
    {
        const SourceText text(path, "a Wavefront OBJ file");
        mesh.bytes = text.size();
        file = parseObj(text, files.reading());
        warnOfOddities(text, file.oddities, mesh.warnings);
    }
    warnOfLoss(path, file.rounded.loss, mesh.warnings);
    ObjMaterials materials(path, files);
    for (const ObjPart& part : file.parts) {
        for (const std::string& names : part.notes.libraries)
            materials.load(names);
    }
    const std::vector<PartStart> starts = findStarts(file, materials);
    mesh.origin = file.rounded.origin;
    mesh.geometry = buildGeometry(std::move(file), starts);
    materials.moveTo(mesh);
    if (mesh.geometry.triangles.empty()) {
        throw InputError(path.string(), "", "has no faces",
                         "expected at least one \"f\" statement with 3 corners or more");
    }
    return mesh;
}

}  // namespace duolux
