#include "host/app/view_options.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>

#include "host/base/error.h"
#include "host/cli/options.h"
#include "host/scene/mesh.h"
#include "host/view/view_samples.h"

namespace duolux {

namespace {

/// "X,Y,Z" as three numbers; empty if malformed.
std::optional<glm::dvec3> parseTriple(const std::string& text) {
    glm::dvec3 result;
    const char* at = text.data();
    const char* const end = at + text.size();
    for (int i = 0; i < 3; ++i) {
        const auto [next, error] = std::from_chars(at, end, result[i]);
        if (error != std::errc() || !(std::abs(result[i]) <= kFarthestPlace)) return std::nullopt;
        const bool last = i == 2;
        if (last ? next != end : next == end || *next != ',') return std::nullopt;
        at = next + 1;
    }
    return result;
}

glm::dvec3 parseVector(std::string_view option, const std::string& text, std::string_view alternatives) {
    const std::optional<glm::dvec3> vector = parseTriple(text);
    if (vector) return *vector;
    throw UsageError(fmt::format("{} {}: expected {}three numbers X,Y,Z of at most {:g} in magnitude", option,
                                 text, alternatives, kFarthestPlace));
}

glm::dvec3 parseUp(const std::string& text) {
    if (text == "y") return {0.0, 1.0, 0.0};
    if (text == "z") return {0.0, 0.0, 1.0};
    const glm::dvec3 up = parseVector("--up", text, "y, z or ");
    if (up == glm::dvec3(0.0)) throw UsageError("--up 0,0,0: has no direction; expected y, z or X,Y,Z");
    return up;
}

}  // namespace

SceneChoices ViewOptions::choices() const {
    SceneChoices choices;
    CameraChoice& camera = choices.camera;
    if (!position.empty()) camera.position = parseVector("--camera-position", position, "");
    if (!lookAt.empty()) camera.target = parseVector("--look-at", lookAt, "");
    if (!up.empty()) camera.up = parseUp(up);
    camera.vfov = vfov;
    if (const auto wrong = camera.contradiction()) {
        throw UsageError(fmt::format("--camera-position {} --look-at {}{}: {}; {}", position, lookAt,
                                     up.empty() ? "" : " --up " + up, wrong->problem, wrong->remedy));
    }
    if (lamp) choices.lamp = Lamp::kAlways;
    if (noLamp) choices.lamp = Lamp::kNever;
    return choices;
}

void addViewOptions(CLI::App& command, ViewOptions& options) {
    const char* const kGroup = "Camera and lamp (override the scene's and the automatic choice)";
    command
        .add_option("--camera-position", options.position,
                    "Position of the camera, in the scene's coordinates")
        ->type_name("X,Y,Z")
        ->check(notEmpty())
        ->group(kGroup);
    command.add_option("--look-at", options.lookAt, "The point in the middle of the picture")
        ->type_name("X,Y,Z")
        ->check(notEmpty())
        ->group(kGroup);
    command
        .add_option("--vfov", options.vfov, "Full vertical angle of view (default: 40; larger inside rooms)")
        ->type_name("DEGREES")
        ->check(between(1e-3, 179.9))
        ->group(kGroup);
    command.add_option("--up", options.up, "Up direction: y (default), z or a vector")
        ->type_name("y|z|X,Y,Z")
        ->check(notEmpty())
        ->group(kGroup);
    CLI::Option* lamp =
        command
            .add_flag(
                "--lamp", options.lamp,
                fmt::format("Add a lamp beside the camera (default: if nothing emits light, or so little "
                            "that white surfaces would reflect less than {} % of white on average)",
                            kDarkPercent))
            ->group(kGroup);
    command.add_flag("--no-lamp", options.noLamp, "Never add a lamp")->excludes(lamp)->group(kGroup);
}

}  // namespace duolux
