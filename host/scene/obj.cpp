#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "host/base/error.h"
#include "host/base/parallel.h"
#include "host/base/printable.h"
#include "host/scene/mesh.h"
#include "host/scene/mtl.h"
#include "host/scene/obj_parse.h"
#include "host/scene/smooth_normals.h"
#include "host/scene/source_text.h"
#include "host/scene/triangulate.h"

namespace duolux {

namespace {

namespace fs = std::filesystem;

/// The materials of a mesh by name, those of MTL files first.
class MaterialTable {
  public:
    explicit MaterialTable(Mesh& mesh) : mesh_(mesh) {}

    void add(const Material& material) {
        if (index_.try_emplace(material.name, static_cast<std::uint32_t>(mesh_.materials.size())).second) {
            mesh_.materials.push_back(material);
        }
    }

    /// One that no MTL file defines becomes a grey one of that name.
    std::uint32_t find(const std::string& name, bool expected) {
        const auto found = index_.find(name);
        if (found != index_.end()) return found->second;
        Material material;
        material.name = name;
        add(material);
        if (expected) undefined_.push_back(name);
        return index_.at(name);
    }

    const std::vector<std::string>& undefined() const { return undefined_; }

  private:
    Mesh& mesh_;
    std::map<std::string, std::uint32_t> index_;
    std::vector<std::string> undefined_;
};

/// The files that an mtllib line names: one whose name may hold blanks if there is such a file, else one a
/// word.
std::vector<fs::path> libraryFiles(const fs::path& folder, std::string_view names) {
    std::error_code ec;
    if (fs::is_regular_file(folder / names, ec)) return {folder / names};
    std::vector<fs::path> files;
    while (!names.empty()) {
        const std::string_view name = firstWord(names);
        files.push_back(folder / name);
        names = trimmed(names.substr(name.size()));
    }
    return files;
}

void loadLibraries(const fs::path& path, const ObjFile& file, Mesh& mesh, MaterialTable& table) {
    std::vector<fs::path> loaded;
    for (const ObjPart& part : file.parts) {
        for (const ObjNotes::Library& line : part.notes.libraries) {
            for (const fs::path& mtl : libraryFiles(path.parent_path(), line.files)) {
                if (std::find(loaded.begin(), loaded.end(), mtl) != loaded.end()) continue;
                loaded.push_back(mtl);
                std::error_code ec;
                if (!fs::is_regular_file(mtl, ec)) {
                    mesh.warnings.push_back(
                        fmt::format("{}: no such file: its materials are grey", mtl.string()));
                    continue;
                }
                MaterialLibrary library = loadMtl(mtl);
                mesh.files.push_back(mtl);
                for (const Material& material : library.materials)
                    table.add(material);
                for (std::string& warning : library.warnings)
                    mesh.warnings.push_back(std::move(warning));
            }
        }
    }
}

/// What holds at the first face of a part, and where its triangles go.
struct PartStart {
    std::size_t firstTriangle = 0;
    std::uint32_t material = 0;
    std::uint32_t smoothing = 0;
    std::vector<std::uint32_t> materialIds;  ///< of ObjPart::materials
};

/// Carries the running state from part to part.
std::vector<PartStart> findStarts(const ObjFile& file, MaterialTable& table) {
    std::vector<PartStart> starts(file.parts.size());
    std::size_t triangles = 0;
    std::optional<std::uint32_t> material;
    std::uint32_t smoothing = 0;
    for (std::size_t i = 0; i < file.parts.size(); ++i) {
        const ObjPart& part = file.parts[i];
        const bool facesFirst = part.materials.empty() || part.materials.front().face > 0;
        if (!material && facesFirst && !part.faceEnds.empty())
            material = table.find(kDefaultMaterialName, false);
        starts[i].firstTriangle = triangles;
        starts[i].material = material.value_or(0);
        starts[i].smoothing = smoothing;
        for (const ObjPart::MaterialChange& change : part.materials) {
            material = table.find(change.name, true);
            starts[i].materialIds.push_back(*material);
        }
        if (!part.notes.smoothing.empty()) smoothing = part.notes.smoothing.back().group;
        triangles += part.cornerVertices.size() - 2 * part.faceEnds.size();
    }
    return starts;
}

/// Cuts the polygons of one part into triangles, at their place in the geometry.
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
            polygon_.push_back(file_.positions[vertex(i)]);
        triangulate(polygon_, triangles_);
    }

    /// The triangle stays flat if one of its corners has no normal, or a zero one.
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

    const ObjFile& file_;
    const ObjPart& part_;
    const PartStart& start_;
    Geometry& geometry_;
    std::span<std::uint32_t> groups_;
    std::vector<glm::vec3> polygon_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
};

Geometry buildGeometry(ObjFile file, const std::vector<PartStart>& starts) {
    std::size_t triangles = 0;
    bool anyNormal = false, anyGroup = false;
    for (const ObjPart& part : file.parts) {
        triangles += part.cornerVertices.size() - 2 * part.faceEnds.size();
        anyNormal = anyNormal || !part.cornerNormals.empty();
        for (const ObjNotes::Smoothing& change : part.notes.smoothing)
            anyGroup = anyGroup || change.group != 0;
    }
    Geometry geometry;
    geometry.triangles.resize(triangles);
    geometry.materials.resize(triangles);
    if (anyNormal || anyGroup) geometry.normalIndices.assign(triangles, glm::uvec3(Geometry::kNoNormal));
    std::vector<std::uint32_t> groups(anyGroup ? triangles : 0);
    parallelFor(file.parts.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            PartTriangulator(file, file.parts[i], starts[i], geometry, groups).run();
            file.parts[i] = ObjPart();  // its memory is not needed any more
        }
    });
    geometry.positions = std::move(file.positions);
    if (anyNormal) geometry.normals = std::move(file.normals);
    if (anyGroup) addSmoothNormals(geometry, groups);
    if (geometry.normals.empty()) geometry.normalIndices.clear();
    return geometry;
}

void warnOfIgnored(const SourceText& text, const ObjFile& file, Mesh& mesh) {
    std::size_t count = 0;
    std::size_t first = 0;
    for (const ObjPart& part : file.parts) {
        if (count == 0 && part.notes.ignored > 0) first = part.offset + part.notes.firstIgnored;
        count += part.notes.ignored;
    }
    if (count == 0) return;
    mesh.warnings.push_back(fmt::format(
        "{}: line {}: {} is not supported; {} such line{} ignored", text.file(), text.lineOf(first),
        inQuotes(firstWord(text.view().substr(first))), count, count == 1 ? " is" : "s are"));
}

void warnOfUndefined(const fs::path& path, const MaterialTable& table, Mesh& mesh) {
    if (table.undefined().empty()) return;
    const std::size_t more = table.undefined().size() - 1;
    mesh.warnings.push_back(fmt::format("{}: material {}{} is not defined by any MTL file: grey 0.8 is used",
                                        path.string(), inQuotes(table.undefined().front()),
                                        more == 0 ? "" : fmt::format(" (and {} more)", more)));
}

}  // namespace

Mesh loadObj(const fs::path& path) {
    Mesh mesh;
    mesh.source = path;
    mesh.files.push_back(path);
    MaterialTable table(mesh);
    ObjFile file;
    {
        SourceText text(path);
        mesh.bytes = text.size();
        file = parseObj(text);
        warnOfIgnored(text, file, mesh);
    }
    loadLibraries(path, file, mesh, table);
    const std::vector<PartStart> starts = findStarts(file, table);
    warnOfUndefined(path, table, mesh);
    mesh.geometry = buildGeometry(std::move(file), starts);
    if (mesh.geometry.triangles.empty()) {
        throw InputError(path.string(), "", "has no faces", "expected at least one \"f\" statement");
    }
    return mesh;
}

}  // namespace duolux
