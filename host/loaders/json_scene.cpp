#include "host/loaders/json_scene.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "host/base/nearest_name.h"
#include "host/base/printable.h"
#include "host/loaders/json_image.h"
#include "host/loaders/json_material.h"
#include "host/loaders/json_node.h"
#include "host/loaders/json_surface.h"
#include "host/loaders/json_text.h"
#include "host/loaders/scene_contents.h"
#include "host/loaders/tally.h"
#include "host/scene/compose.h"
#include "host/scene/mesh.h"

namespace duolux {

namespace {

namespace fs = std::filesystem;

std::string vectorRemedy(double largest) {
    return fmt::format("expected [x, y, z], at most {:g} in magnitude", largest);
}

const std::string& placeRemedy() {
    static const std::string kRemedy = vectorRemedy(kFarthestPlace);
    return kRemedy;
}

/// A point in the coordinates of the files, which may be far from the origin.
glm::dvec3 readPlace(const JsonNode& node) {
    return node.vector(-kFarthestPlace, kFarthestPlace, placeRemedy());
}

constexpr auto kLongestDirection = static_cast<double>(kLargestCoordinate);

const std::string& directionRemedy() {
    static const std::string kRemedy = vectorRemedy(kLongestDirection);
    return kRemedy;
}

glm::dvec3 readDirection(const JsonNode& node) {
    return node.vector(-kLongestDirection, kLongestDirection, directionRemedy());
}

/// The sine of the angle between two vectors, 0 if one of them is 0.
double sineBetween(const glm::vec3& a, const glm::vec3& b) {
    const double lengths = glm::length(glm::dvec3(a)) * glm::length(glm::dvec3(b));
    return lengths > 0.0 ? glm::length(glm::cross(glm::dvec3(a), glm::dvec3(b))) / lengths : 0.0;
}

CameraChoice readCamera(const JsonNode& node) {
    node.expectKeys({"type", "position", "target", "up", "vfov", "height"});
    CameraChoice camera;
    if (const auto type = node.find("type")) camera.type = type->choice<CameraType>();
    if (const auto position = node.find("position")) camera.position = readPlace(*position);
    if (const auto target = node.find("target")) camera.target = readPlace(*target);
    if (const auto up = node.find("up")) camera.up = readDirection(*up);
    if (const auto vfov = node.find("vfov")) {
        const char* const remedy = "expected the full vertical angle in degrees, between 0 and 180";
        camera.vfov = static_cast<float>(vfov->number(0.0, 180.0, remedy));
        if (*camera.vfov <= 0.0f || *camera.vfov >= 180.0f) vfov->failValue(remedy);
    }
    if (const auto height = node.find("height")) {
        const char* const remedy = "expected the height of the image in scene units, above 0";
        camera.height =
            static_cast<float>(height->number(0.0, static_cast<double>(kLargestCoordinate), remedy));
        if (!(*camera.height > 0.0f)) height->failValue(remedy);
    }
    if (const auto wrong = camera.contradiction()) node.fail(wrong->problem, wrong->remedy);
    return camera;
}

void readFilm(const JsonNode& node, RenderSettings& render) {
    node.expectKeys({"width", "height"});
    if (const auto width = node.find("width")) render.width = width->integer(1, RenderSettings::kLargestSize);
    if (const auto height = node.find("height"))
        render.height = height->integer(1, RenderSettings::kLargestSize);
}

void readRender(const JsonNode& node, RenderSettings& render) {
    node.expectKeys({"spp", "bounces", "seed", "sampler", "integrator"});
    if (const auto spp = node.find("spp")) render.spp = spp->integer(1, RenderSettings::kMostSpp);
    if (const auto bounces = node.find("bounces"))
        render.bounces = bounces->integer(0, RenderSettings::kMostBounces);
    if (const auto seed = node.find("seed")) {
        render.seed = seed->integer(0, std::numeric_limits<std::uint32_t>::max());
    }
    if (const auto sampler = node.find("sampler")) render.sampler = sampler->choice<Sampler>();
    if (const auto integrator = node.find("integrator")) {
        render.integrator = integrator->choice<Integrator>();
    }
}

glm::vec2 readDisplay(const JsonNode& node) {
    constexpr double kLargest = 1e6;
    const std::string remedy = fmt::format(
        "expected [invisible, visible], the two weights of the displayed radiance, from 0 to {:g}, not both "
        "0",
        kLargest);
    const std::vector<JsonNode> row = node.elements(remedy, 2);
    const glm::vec2 display(static_cast<float>(row[0].number(0.0, kLargest, remedy)),
                            static_cast<float>(row[1].number(0.0, kLargest, remedy)));
    if (display == glm::vec2(0.0f)) node.fail("is [0, 0], which makes every picture black", remedy);
    return display;
}

glm::dmat4 readTransform(const JsonNode& node) {
    const char* const remedy = "expected 16 numbers, a 4x4 matrix row by row";
    const std::vector<JsonNode> entries = node.elements(remedy, 16);
    glm::dmat4 matrix;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const int row = static_cast<int>(i / 4), column = static_cast<int>(i % 4);
        const double largest = column == 3 ? kFarthestPlace : kLongestDirection;
        matrix[column][row] = entries[i].number(
            -largest, largest,
            entries[i].isNumber() ? fmt::format("expected a number of at most {:g} in magnitude", largest)
                                  : std::string(remedy));
    }
    if (glm::dvec4(matrix[0][3], matrix[1][3], matrix[2][3], matrix[3][3]) !=
        glm::dvec4(0.0, 0.0, 0.0, 1.0)) {
        node.fail("the last row is not 0, 0, 0, 1", "expected an affine transform, object to world");
    }
    if (!isRegular(glm::dmat3(matrix))) {
        node.fail("is singular", "expected an invertible transform");
    }
    return matrix;
}

const std::string& expectedMesh() {
    static const std::string text =
        fmt::format("expected the path of an {} file, relative to the scene file", meshExtensions());
    return text;
}

fs::path readMeshPath(const JsonNode& node) {
    const std::string& remedy = expectedMesh();
    const fs::path path = readPath(node, remedy);
    if (!isMeshPath(path)) node.failValue(remedy);
    return requireFile(node, path, remedy);
}

void readObjects(const JsonNode& node, SceneContents& contents) {
    std::map<fs::path, std::size_t> meshes, byPath;
    for (const JsonNode& object : node.elements("expected an array of objects")) {
        object.expectKeys({"mesh", "transform"});
        const fs::path path = readMeshPath(object.require("mesh", expectedMesh()));
        const std::optional<JsonNode> transform = object.find("transform");
        std::optional<glm::dmat4> matrix;
        if (transform) matrix = readTransform(*transform);
        const auto [mesh, isNewPath] = byPath.try_emplace(path, contents.meshes.size());
        if (isNewPath) {
            const auto [file, isNew] = meshes.try_emplace(identity(path), contents.meshes.size());
            if (isNew) contents.meshes.push_back(loadMesh(path, contents.materialFiles));
            mesh->second = file->second;
        }
        contents.objects.push_back({transform.value_or(object), mesh->second, matrix});
    }
}

JsonNode emissionOf(const JsonNode& light) {
    return light.require("emission", R"(expected {"invisible": c, "visible": c})");
}

void readPoint(const JsonNode& node, SceneContents& contents) {
    node.expectKeys({"type", "position", "emission"});
    SceneContents::Point point{node, readPlace(node.require("position", placeRemedy())), {}};
    readIntensity(emissionOf(node), point.emitter);
    contents.points.push_back(std::move(point));
}

void readRectangle(const JsonNode& node, SceneContents& contents) {
    constexpr double kSmallestSine = 1e-6;
    node.expectKeys({"type", "origin", "edge1", "edge2", "emission", "reflectance"});
    SceneContents::Light light{node,
                               readPlace(node.require("origin", placeRemedy())),
                               glm::vec3(readDirection(node.require("edge1", directionRemedy()))),
                               glm::vec3(readDirection(node.require("edge2", directionRemedy()))),
                               {}};
    if (sineBetween(light.edge1, light.edge2) < kSmallestSine) {
        node.fail("edge1 and edge2 span no area", "expected two vectors that are not parallel");
    }
    Material& material = light.material;
    material.name = node.path();
    material.baseColor = glm::vec3(0.0f);
    readEmission(emissionOf(node), material.emission);
    if (const auto reflectance = node.find("reflectance"))
        material.reflectance = readReflectance(*reflectance);
    contents.lights.push_back(std::move(light));
}

void readLight(const JsonNode& node, SceneContents& contents) {
    static const std::array<std::string, 2> kTypes{"point", "rectangle"};
    const std::size_t type = node.require("type", "expected \"point\" or \"rectangle\"").choice(kTypes);
    (type == 0 ? readPoint : readRectangle)(node, contents);
}

/// Names of defined materials that no face has.
std::set<std::string> unusedMaterials(const SceneContents& contents) {
    std::set<std::string> names;
    for (const Mesh& mesh : contents.meshes)
        names.insert(mesh.unusedMaterials.begin(), mesh.unusedMaterials.end());
    for (const MaterialLibrary* library : contents.materialFiles.libraries()) {
        for (const auto& [name, index] : library->byPlainName)
            names.insert(name);
        for (const auto& [name, index] : library->byName)
            names.insert(name);
    }
    return names;
}

void readMaterials(const JsonNode& node, const std::set<std::string>& unused, LoadedScene& scene) {
    std::unordered_map<std::string, std::vector<std::size_t>> byName;
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        byName[scene.materials[i].name].push_back(i);
    JsonImages images(scene.imageSources, scene.files);
    std::vector<ImageSource> ignoredSources;
    std::vector<fs::path> ignoredFiles;
    JsonImages ignoredImages(ignoredSources, ignoredFiles);
    std::string firstUnused;
    std::size_t unusedCount = 0;
    for (const auto& [name, overrides] : node.members()) {
        const auto found = byName.find(name);
        if (found != byName.end()) {
            for (const std::size_t material : found->second)
                readMaterial(overrides, scene.materials[material], images);
        } else if (unused.contains(name)) {
            Material material;
            readMaterial(overrides, material, ignoredImages);
            if (unusedCount++ == 0) firstUnused = overrides.path();
        } else {
            std::set<std::string> names = unused;
            for (const Material& material : scene.materials)
                names.insert(material.name);
            const std::vector<std::string> known(names.begin(), names.end());
            overrides.fail("no mesh has a material of this name", suggestName(name, known));
        }
    }
    if (unusedCount == 0) return;
    scene.warnings.push_back(fmt::format("{}: {}{}: no face has this material", scene.source.string(),
                                         firstUnused, andMore(unusedCount)));
}

}  // namespace

SceneFile readJsonScene(const fs::path& path, Reading reading) {
    const nlohmann::json document = parseJsonFile(path);
    const JsonNode root(document, path);
    root.expectKeys(
        {"duolux", "camera", "film", "render", "display", "reflectance", "objects", "materials", "lights"});
    root.require("duolux", "expected \"duolux\": 1, the version of the format").integer(1, 1);

    LoadedScene scene;
    scene.source = path;
    scene.files.push_back(path);
    CameraChoice camera;
    if (const auto node = root.find("camera")) camera = readCamera(*node);
    if (const auto film = root.find("film")) readFilm(*film, scene.settings);
    const auto render = root.find("render");
    if (render) readRender(*render, scene.settings);
    if (const auto display = root.find("display")) scene.display = readDisplay(*display);
    const auto reflectance = root.find("reflectance");
    scene.reflectance = reflectance ? readReflectance(*reflectance) : *presetReflectance("global");
    SceneContents contents(reading);
    if (const auto objects = root.find("objects")) readObjects(*objects, contents);
    const auto lights = root.find("lights");
    if (lights) {
        for (const JsonNode& light : lights->elements("expected an array of lights"))
            readLight(light, contents);
    }
    setOrigin(scene, originOf(contents));
    const auto materials = root.find("materials");
    const std::set<std::string> unused = materials ? unusedMaterials(contents) : std::set<std::string>();
    appendObjects(contents, scene);
    if (materials) readMaterials(*materials, unused, scene);
    const std::size_t meshTriangles = scene.geometry.triangles.size();
    appendLights(contents, scene);
    if (scene.geometry.triangles.empty()) {
        root.fail("has no triangles with area", "expected \"objects\" with meshes, or \"lights\"");
    }
    const std::size_t framed = meshTriangles > 0 ? meshTriangles : scene.geometry.triangles.size();
    return {std::move(scene), camera, framed, lights.has_value(), render && render->find("bounces")};
}

}  // namespace duolux
