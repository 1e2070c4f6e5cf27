#include "host/generators/two_spheres.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/generators/icosphere.h"

namespace duolux {

namespace {

namespace fs = std::filesystem;

/// The distribution of the triangles: 2 for the luminaire, 40 f^2 for the spheres, the remaining ones for the
/// five walls.
struct Division {
    std::uint32_t sphereFrequency;
    std::uint32_t wallCells;                 ///< of ceiling, back and side walls, along each side
    std::uint32_t floorCellsX, floorCellsZ;  ///< chosen to give the right total
};

Division divide(std::size_t triangles) {
    constexpr std::size_t kLuminaire = 2, kFewestWalls = 10;
    Division division{};
    const double mostInSpheres = static_cast<double>(triangles - kLuminaire - kFewestWalls);
    division.sphereFrequency = static_cast<std::uint32_t>(std::sqrt(mostInSpheres / 40.0));
    const std::size_t walls =
        triangles - kLuminaire - 40 * std::size_t{division.sphereFrequency} * division.sphereFrequency;
    division.wallCells =
        std::max(1u, static_cast<std::uint32_t>(std::sqrt(static_cast<double>(walls) / 10.0)));

    const std::size_t cells = (walls - 8 * std::size_t{division.wallCells} * division.wallCells) / 2;
    const auto widest = static_cast<std::size_t>(std::sqrt(static_cast<double>(cells)));
    auto missing = [&](std::size_t x) { return cells - x * (cells / x); };
    std::size_t best = widest;
    for (std::size_t x = widest; x >= std::max<std::size_t>(1, widest / 2); --x) {
        if (missing(x) < missing(best)) best = x;
    }
    division.floorCellsX = static_cast<std::uint32_t>(best);
    division.floorCellsZ = static_cast<std::uint32_t>(cells / best);
    return division;
}

/// Builds OBJ text.
class ObjWriter {
  public:
    explicit ObjWriter(std::size_t triangles) {
        constexpr std::size_t kBytesPerTriangle = 44;  // half a vertex and a face
        text_.reserve(triangles * kBytesPerTriangle + 4096);
    }

    void line(const std::string& text) { text_ += text + "\n"; }

    void vertex(const glm::dvec3& position) {
        text_ += 'v';
        for (int i = 0; i < 3; ++i)
            number(static_cast<float>(position[i]));
        text_ += '\n';
        ++vertices_;
    }

    /// Indices from 0, relative to `firstVertex`.
    void face(std::size_t firstVertex, const glm::uvec3& corners) {
        text_ += 'f';
        for (int i = 0; i < 3; ++i)
            number(firstVertex + corners[i] + 1);
        text_ += '\n';
        ++triangles_;
    }

    std::size_t vertices() const { return vertices_; }
    std::size_t triangles() const { return triangles_; }
    const std::string& text() const { return text_; }

  private:
    template <typename T>
    void number(T value) {
        char digits[32];
        const auto result = std::to_chars(digits, digits + sizeof digits, value);
        text_ += ' ';
        text_.append(digits, result.ptr);
    }

    std::string text_;
    std::size_t vertices_ = 0, triangles_ = 0;
};

struct Sphere {
    const char* material;
    glm::dvec3 centre;
    double radius;
};

void writeSphere(ObjWriter& obj, const Sphere& sphere, const Icosphere& unit) {
    obj.line(fmt::format("o {0}\nusemtl {0}", sphere.material));
    const std::size_t first = obj.vertices();
    for (const glm::dvec3& position : unit.positions)
        obj.vertex(sphere.centre + sphere.radius * position);
    for (const glm::uvec3& triangle : unit.triangles)
        obj.face(first, triangle);
}

/// The front of the rectangle is on the side of edge1 x edge2.
struct Wall {
    const char* material;
    glm::dvec3 origin, edge1, edge2;
};

void writeWall(ObjWriter& obj, const char* name, const Wall& wall, std::uint32_t cells1,
               std::uint32_t cells2) {
    obj.line(fmt::format("o {}\nusemtl {}", name, wall.material));
    const std::size_t first = obj.vertices();
    for (std::uint32_t j = 0; j <= cells2; ++j) {
        for (std::uint32_t i = 0; i <= cells1; ++i) {
            obj.vertex(wall.origin + wall.edge1 * (static_cast<double>(i) / cells1) +
                       wall.edge2 * (static_cast<double>(j) / cells2));
        }
    }
    const std::uint32_t row = cells1 + 1;
    for (std::uint32_t j = 0; j < cells2; ++j) {
        for (std::uint32_t i = 0; i < cells1; ++i) {
            const std::uint32_t corner = j * row + i;
            obj.face(first, {corner, corner + 1, corner + row + 1});
            obj.face(first, {corner, corner + row + 1, corner + row});
        }
    }
}

constexpr double kRoom = 100.0;  // length of the room's sides

void writeRoom(ObjWriter& obj, const Division& division) {
    const glm::dvec3 x(kRoom, 0, 0), y(0, kRoom, 0), z(0, 0, kRoom);
    const std::uint32_t n = division.wallCells;
    writeWall(obj, "floor", {"floor", glm::dvec3(0), z, x}, division.floorCellsZ, division.floorCellsX);
    writeWall(obj, "ceiling", {"ceiling", y, x, z}, n, n);
    writeWall(obj, "back", {"back", glm::dvec3(0), x, y}, n, n);
    writeWall(obj, "left", {"left", glm::dvec3(0), y, z}, n, n);
    writeWall(obj, "right", {"right", x, z, y}, n, n);
    writeWall(obj, "luminaire", {"luminaire", {35, 99.5, 35}, {30, 0, 0}, {0, 0, 30}}, 1, 1);
}

constexpr const char* kMtl = R"(# Two spheres under a rectangular luminaire.
newmtl floor
Kd 0.75 0.75 0.75
newmtl ceiling
Kd 0.75 0.75 0.75
newmtl back
Kd 0.75 0.75 0.75
newmtl left
Kd 0.63 0.065 0.05
newmtl right
Kd 0.14 0.45 0.091
newmtl left_sphere
Kd 0.8 0.62 0.3
newmtl right_sphere
Kd 0.35 0.5 0.8
newmtl luminaire
Kd 0 0 0
Ke 18 18 18
)";

constexpr const char* kJson = R"({
  "duolux": 1,
  "camera": {"position": [50, 50, 245], "target": [50, 50, 0], "up": [0, 1, 0], "vfov": 39.3},
  "film": {"width": 512, "height": 512},
  "render": {"spp": 64, "bounces": 16, "seed": 1},
  "display": [0, 1],
  "reflectance": {"preset": "local"},
  "objects": [{"mesh": "two_spheres.obj"}],
  "materials": {
    "luminaire": {"emission": {"invisible": [18, 18, 18], "visible": [0, 0, 0], "sides": "front"}}
  }
}
)";

}  // namespace

std::size_t writeTwoSpheres(const fs::path& folder, std::size_t triangles) {
    assert(triangles >= kFewestTwoSpheresTriangles && triangles <= kMostTwoSpheresTriangles);
    const Division division = divide(triangles);
    const Icosphere unit = makeIcosphere(division.sphereFrequency);
    ObjWriter obj(triangles);
    obj.line("# Two spheres under a rectangular luminaire, in a room open to the camera.");
    obj.line("mtllib two_spheres.mtl");
    writeRoom(obj, division);
    writeSphere(obj, {"left_sphere", {30, 20, 38}, 20}, unit);
    writeSphere(obj, {"right_sphere", {69, 16, 62}, 16}, unit);

    std::error_code ec;
    fs::create_directories(folder, ec);
    if (ec)
        throw MachineError(fmt::format("{}: cannot create the folder: {}", folder.string(), ec.message()));
    writeFile(folder / "two_spheres.obj", obj.text());
    writeFile(folder / "two_spheres.mtl", kMtl);
    writeFile(folder / "two_spheres.json", kJson);
    return obj.triangles();
}

}  // namespace duolux
