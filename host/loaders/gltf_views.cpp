#include "host/loaders/gltf_views.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace duolux {

namespace {

bool isPlace(const glm::dvec3& position) {
    return glm::all(glm::lessThanEqual(glm::abs(position), glm::dvec3(kFarthestPlace)));
}

const JsonNode& lightOf(const JsonNode& index, const std::vector<JsonNode>& lights) {
    if (lights.empty()) index.fail("refers to lights, of which there are none", "expected no reference");
    return lights[index.integer(0, static_cast<std::uint32_t>(lights.size() - 1))];
}

/// The elements of the document's list of lights.
std::vector<JsonNode> lightsOf(const GltfDocument& document) {
    const auto extension = extensionOf(document.root(), "KHR_lights_punctual");
    const auto lights = extension ? extension->find("lights") : std::nullopt;
    return lights ? lights->elements("expected an array of lights") : std::vector<JsonNode>();
}

}  // namespace

std::optional<PlacedPointEmitter> readGltfLight(const JsonNode& node, const glm::dmat4& world,
                                                const GltfDocument& document, GltfNotes& notes) {
    const auto extension = extensionOf(node, "KHR_lights_punctual");
    if (!extension) return std::nullopt;
    const JsonNode light =
        lightOf(extension->require("light", "expected the index of a light"), lightsOf(document));
    static const std::array<std::string, 3> kTypes{"point", "spot", "directional"};
    if (light.require("type", "expected \"point\", \"spot\" or \"directional\"").choice(kTypes) != 0) {
        notes.ignore(light, "spot and directional lights are not supported", "left out");
        return std::nullopt;
    }
    PlacedPointEmitter emitter;
    emitter.position = glm::dvec3(world[3]);
    if (!isPlace(emitter.position)) node.fail("a light is too far away", "expected a place near the scene");
    glm::dvec3 colour(1.0);
    if (const auto given = light.find("color"))
        colour = given->vector(0.0, kLargestRadiance, "expected three numbers from 0");
    double candelas = 1.0;
    if (const auto given = light.find("intensity"))
        candelas = given->number(0.0, kLargestRadiance, "expected candelas, 0 or more");
    const glm::dvec3 intensity = colour * (candelas / kCandelasPerWatt);
    if (glm::any(glm::greaterThan(intensity, glm::dvec3(kLargestRadiance))))
        light.fail("is too bright", "expected a smaller intensity");
    emitter.invisible = emitter.visible = glm::vec3(intensity);
    return emitter;
}

CameraChoice readGltfCamera(const JsonNode& camera, const glm::dmat4& world, double distance,
                            GltfNotes& notes) {
    const char* const types = "expected \"perspective\" or \"orthographic\"";
    static const std::array<std::string, 2> kTypes{"perspective", "orthographic"};
    CameraChoice choice;
    if (camera.require("type", types).choice(kTypes) == 0) {
        const char* const remedy = "expected the full vertical angle in radians, between 0 and pi";
        const JsonNode yfov = camera.require("perspective", "expected an object").require("yfov", remedy);
        const auto vfov = static_cast<float>(glm::degrees(yfov.number(0.0, 3.15, remedy)));
        if (!(vfov > 0.0f && vfov < 180.0f)) yfov.failValue(remedy);
        choice.type = CameraType::kPerspective;
        choice.vfov = vfov;
    } else {
        const char* const remedy = "expected half of the height of the image in scene units, above 0";
        const JsonNode ymag = camera.require("orthographic", "expected an object").require("ymag", remedy);
        constexpr auto kLargest = static_cast<double>(kLargestCoordinate);
        const auto height = static_cast<float>(2.0 * std::abs(ymag.number(-kLargest, kLargest, remedy)));
        if (!(height > 0.0f)) ymag.failValue(remedy);
        choice.type = CameraType::kOrthographic;
        choice.height = height;
    }
    const glm::dvec3 position(world[3]), forward(-world[2]), up(world[1]);
    const double forwardLength = glm::length(forward), upLength = glm::length(up);
    const bool hasDirections = forwardLength > 0.0 && upLength > 0.0 && std::isfinite(forwardLength) &&
                               std::isfinite(upLength) && isPlace(position) &&
                               glm::length(glm::cross(forward / forwardLength, up / upLength)) > 1e-3;
    if (!hasDirections) {
        notes.tolerate(camera, "a camera without a direction", "expected a node with a regular transform",
                       "the view is chosen automatically");
        return {};
    }
    choice.position = position;
    choice.target = position + forward / forwardLength * distance;
    choice.up = up / upLength;
    return choice;
}

}  // namespace duolux
