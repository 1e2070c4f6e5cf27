#include "tests/unit/scene_files.h"

#include <fstream>
#include <ostream>
#include <string_view>

#include "host/base/error.h"
#include "host/view/load.h"

/// Makes failures of vector comparisons readable.
namespace glm {
void PrintTo(const vec3& v, std::ostream* out) {
    *out << "(" << v.x << ", " << v.y << ", " << v.z << ")";
}
}  // namespace glm

namespace duolux::test {

namespace fs = std::filesystem;

const std::string_view kTriangleObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

fs::path SceneFiles::write(const std::string& name, std::string_view text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
}

LoadedScene SceneFiles::load(const std::string& name) const {
    return loadScene(folder_ / name);
}

LoadedScene SceneFiles::loadObj(std::string_view text) const {
    return loadScene(write("mesh.obj", text));
}

LoadedScene SceneFiles::loadJson(std::string_view text) const {
    return loadScene(write("scene.json", text));
}

std::string SceneFiles::errorOf(const std::string& name, Reading reading) const {
    try {
        loadScene(folder_ / name, {.reading = reading});
    } catch (const InputError& e) {
        std::string line = e.what();
        EXPECT_EQ(line.find('\n'), std::string::npos) << line;
        const std::string prefix = folder_.string() + "/";
        EXPECT_TRUE(line.starts_with(prefix)) << line;
        for (std::size_t at = line.find(prefix); at != std::string::npos; at = line.find(prefix)) {
            line.erase(at, prefix.size());
        }
        return line;
    }
    ADD_FAILURE() << name << " was accepted";
    return {};
}

std::string SceneFiles::errorOfObj(std::string_view text, Reading reading) const {
    write("mesh.obj", text);
    return errorOf("mesh.obj", reading);
}

std::string SceneFiles::errorOfJson(std::string_view text) const {
    write("scene.json", text);
    return errorOf("scene.json");
}

glm::vec3 areaVector(const Geometry& geometry, std::size_t triangle) {
    const glm::uvec3& t = geometry.triangles[triangle];
    const glm::vec3& a = geometry.positions[t.x];
    return 0.5f * glm::cross(geometry.positions[t.y] - a, geometry.positions[t.z] - a);
}

float totalArea(const Geometry& geometry) {
    float sum = 0.0f;
    for (std::size_t i = 0; i < geometry.triangles.size(); ++i)
        sum += glm::length(areaVector(geometry, i));
    return sum;
}

}  // namespace duolux::test
