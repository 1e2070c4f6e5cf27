#include "host/loaders/json_surface.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "host/scene/mesh.h"

namespace duolux {

namespace {

constexpr double kLargestEntry = 1e6;

ReflectanceMatrix readMatrix(const JsonNode& node) {
    const char* const shape = "expected [[m00, m01], [m10, m11]]";
    const std::string entry = fmt::format("expected a number or [r, g, b], from 0 to {:g}", kLargestEntry);
    const std::vector<JsonNode> rows = node.elements(shape, 2);
    const std::vector<JsonNode> invisible = rows[0].elements(shape, 2);
    const std::vector<JsonNode> visible = rows[1].elements(shape, 2);
    return {invisible[0].colour(0.0, kLargestEntry, entry), invisible[1].colour(0.0, kLargestEntry, entry),
            visible[0].colour(0.0, kLargestEntry, entry), visible[1].colour(0.0, kLargestEntry, entry)};
}

Reflectance readPreset(const JsonNode& node) {
    std::vector<std::string> names;
    for (const Preset& preset : presets())
        names.emplace_back(preset.name);
    const Preset& preset = presets()[node.choice(names)];
    return blendReflectance(preset.t, preset.o);
}

Reflectance readBlend(const JsonNode& node) {
    const std::string remedy = "expected [t, o], two numbers from 0 to 1";
    const std::vector<JsonNode> point = node.elements(remedy, 2);
    return blendReflectance(static_cast<float>(point[0].number(0.0, 1.0, remedy)),
                            static_cast<float>(point[1].number(0.0, 1.0, remedy)));
}

/// What is not given is left as it is.
void readComponents(const JsonNode& node, const char* quantity, glm::vec3& invisible, glm::vec3& visible) {
    const std::string remedy =
        fmt::format("expected {}: a number or [r, g, b], from 0 to {:g}", quantity, kLargestRadiance);
    if (const auto value = node.find("invisible")) invisible = value->colour(0.0, kLargestRadiance, remedy);
    if (const auto value = node.find("visible")) visible = value->colour(0.0, kLargestRadiance, remedy);
}

}  // namespace

Reflectance readReflectance(const JsonNode& node) {
    const char* const kinds =
        R"(expected {"preset": name}, {"blend": [t, o]} or {"opaque": M, "transparent": M})";
    node.expectKeys({"preset", "blend", "opaque", "transparent"});
    const std::optional<JsonNode> preset = node.find("preset");
    const std::optional<JsonNode> blend = node.find("blend");
    const bool matrices = node.find("opaque") || node.find("transparent");
    const int given = (preset ? 1 : 0) + (blend ? 1 : 0) + (matrices ? 1 : 0);
    if (given == 0) node.fail("is empty", kinds);
    if (given > 1) node.fail("mixes several kinds", kinds);
    if (preset) return readPreset(*preset);
    if (blend) return readBlend(*blend);
    Reflectance reflectance;
    reflectance.opaque = readMatrix(node.require("opaque", kinds));
    reflectance.transparent = readMatrix(node.require("transparent", kinds));
    return reflectance;
}

void readEmission(const JsonNode& node, Emission& emission) {
    node.expectKeys({"invisible", "visible", "sides"});
    readComponents(node, "a radiance", emission.invisible, emission.visible);
    if (const auto sides = node.find("sides")) emission.sides = sides->choice<Sides>();
}

void readIntensity(const JsonNode& node, PointEmitter& emitter) {
    node.expectKeys({"invisible", "visible"});
    readComponents(node, "a radiant intensity", emitter.invisible, emitter.visible);
}

}  // namespace duolux
