#include "host/app/info_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>
#include <type_traits>
#include <vector>

#include "host/scene/energy.h"
#include "host/scene/fields.h"
#include "host/scene/hash.h"

namespace duolux {

namespace {

using Json = nlohmann::ordered_json;

/// The shortest decimal number that is this float.
double number(float value) {
    return std::strtod(fmt::format("{}", value).c_str(), nullptr);
}

Json toJson(const glm::vec3& v) {
    return {number(v.x), number(v.y), number(v.z)};
}

Json toJson(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

Json placeJson(const Scene& scene, const glm::vec3& place) {
    return scene.origin == glm::dvec3(0.0) ? toJson(place) : toJson(placeInFile(scene, place));
}

Json toJson(const float& value) {
    return number(value);
}

Json toJson(bool value) {
    return value;
}

Json toJson(const Sides& sides) {
    return nameOf(sides);
}

Json toJson(const Alpha& alpha) {
    return {{"mode", nameOf(alpha.mode)}, {"value", number(alpha.value)}, {"cutoff", number(alpha.cutoff)}};
}

Json toJson(const std::vector<MaterialTexture>& textures) {
    Json entries = Json::array();
    for (const MaterialTexture& texture : textures)
        entries.push_back({{"input", nameOf(texture.input)}, {"image", texture.texture.image}});
    return entries;
}

Json toJson(const Emission& emission) {
    if (!emission.any()) return nullptr;
    return {{"invisible", toJson(emission.invisible)},
            {"visible", toJson(emission.visible)},
            {"sides", nameOf(emission.sides)}};
}

Json toJson(const std::optional<Reflectance>& reflectance) {
    if (!reflectance) return nullptr;
    return describeReflectance(*reflectance);
}

Json materialsOf(const Scene& scene) {
    const std::vector<std::size_t> triangles = trianglesOfMaterials(scene);
    Json materials = Json::array();
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        Json entry = {{"name", material.name}, {"triangles", triangles[i]}};
        forEachField(material, [&](const char* name, const auto& field) { entry[name] = toJson(field); });
        materials.push_back(std::move(entry));
    }
    return materials;
}

}  // namespace

glm::dvec3 placeInFile(const Scene& scene, const glm::vec3& place) {
    glm::dvec3 result = scene.origin + glm::dvec3(place);
    for (int i = 0; i < 3; ++i) {
        for (int digits = 6; digits < 17; ++digits) {
            const double shorter = std::strtod(fmt::format("{:.{}g}", result[i], digits).c_str(), nullptr);
            if (static_cast<float>(shorter - scene.origin[i]) != place[i]) continue;
            result[i] = shorter;
            break;
        }
    }
    return result;
}

Json cameraOf(const Scene& scene) {
    Json json;
    forEachField(scene.camera, [&]<typename T>(const char* name, const T& field) {
        if constexpr (std::is_same_v<T, CameraType>) {
            if (field != Camera().type) json[name] = nameOf(field);
        } else if constexpr (std::is_same_v<T, glm::vec3>) {
            json[name] = &field == &scene.camera.up ? toJson(field) : placeJson(scene, field);
        } else {
            json[name] = toJson(field);
        }
    });
    return json;
}

Json addedLamp(const Scene& scene) {
    const Geometry& geometry = scene.geometry;
    const std::size_t first = scene.content.triangles;
    if (geometry.triangles.size() == first) return nullptr;
    // As in all rectangles, its two triangles share the first corner.
    const glm::uvec3 corners = geometry.triangles[first];
    const glm::vec3 origin = geometry.positions[corners.x];
    const glm::vec3 next = geometry.positions[corners.y], opposite = geometry.positions[corners.z];
    const Emission& emission = scene.materials[geometry.materials[first]].emission;
    return {{"type", "rectangle"},
            {"origin", placeJson(scene, origin)},
            {"edge1", toJson(next - origin)},
            {"edge2", toJson(opposite - next)},
            {"emission", {{"invisible", toJson(emission.invisible)}}}};
}

std::string onOneLine(const Json& json) {
    std::string text;
    for (const char c : json.dump()) {
        text += c;
        if (c == ',' || c == ':') text += ' ';
    }
    return text;
}

std::size_t memoryOf(const Geometry& geometry) {
    std::size_t bytes = 0;
    forEachField(geometry, [&]<typename T>(const auto&, const std::vector<T>& items) {
        bytes += items.size() * sizeof(T);
    });
    return bytes;
}

std::size_t smoothTriangles(const Geometry& geometry) {
    return static_cast<std::size_t>(
        std::count_if(geometry.normalIndices.begin(), geometry.normalIndices.end(),
                      [](const glm::uvec3& n) { return n.x != Geometry::kNoNormal; }));
}

std::vector<std::size_t> trianglesOfMaterials(const Scene& scene) {
    std::vector<std::size_t> triangles(scene.materials.size(), 0);
    for (const std::uint32_t material : scene.geometry.materials)
        ++triangles[material];
    return triangles;
}

LargestFactor largestFactor(const Scene& scene) {
    constexpr std::array<const char*, 3> kChannels{"red", "green", "blue"};
    LargestFactor largest;
    for (const Material& material : scene.materials) {
        const MaterialEnergy energy = materialEnergy(scene.reflectanceOf(material), meanAlbedo(material));
        for (int i = 0; i < 3; ++i) {
            if (energy.factor[i] <= largest.factor) continue;
            largest.factor = energy.factor[i];
            largest.material = material.name;
            largest.channel = kChannels[static_cast<std::size_t>(i)];
        }
        largest.mayGrow = largest.mayGrow || energy.mayGrow();
    }
    return largest;
}

Json infoJson(const LoadedScene& scene, const Json& lamp) {
    const Geometry& geometry = scene.geometry;
    const Bounds bounds = boundsOf(geometry);
    const EmitterSummary lights = summariseEmitters(scene);
    const LargestFactor largest = largestFactor(scene);
    Json info;
    info["version"] = 1;
    info["scene"] = scene.source.string();
    info["hash"] = hashScene(scene);
    info["triangles"] = geometry.triangles.size();
    info["vertices"] = geometry.positions.size();
    info["smooth_triangles"] = smoothTriangles(geometry);
    info["bounds"] = {{"lower", placeJson(scene, bounds.lower)}, {"upper", placeJson(scene, bounds.upper)}};
    info["origin"] = toJson(scene.origin);
    info["geometry_bytes"] = memoryOf(geometry);
    info["camera"] = cameraOf(scene);
    info["film"] = {{"width", scene.settings.width}, {"height", scene.settings.height}};
    info["render"] = {{"spp", scene.settings.spp},
                      {"bounces", scene.settings.bounces},
                      {"seed", scene.settings.seed},
                      {"sampler", nameOf(scene.settings.sampler)},
                      {"integrator", nameOf(scene.settings.integrator)}};
    info["display"] = {number(scene.display.x), number(scene.display.y)};
    info["reflectance"] = describeReflectance(scene.reflectance);
    info["lights"] = {
        {"triangles", lights.triangles},
        {"area", lights.area},
        {"points", lights.points},
        {"power", {{"invisible", toJson(lights.invisiblePower)}, {"visible", toJson(lights.visiblePower)}}}};
    info["added_lamp"] = lamp;
    info["materials"] = materialsOf(scene);
    info["energy"] = {{"mean_albedo", toJson(meanAlbedo(scene))},
                      {"largest_factor", number(largest.factor)},
                      {"material", largest.material},
                      {"channel", largest.channel},
                      {"may_grow", largest.mayGrow}};
    info["warnings"] = textsOf(scene.warnings);
    return info;
}

}  // namespace duolux
