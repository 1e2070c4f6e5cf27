#include <optional>

#include "tests/support/closed_form.h"
#include "tests/support/exact_case.h"
#include "tests/support/scene_builder.h"

// Inside a closed convex enclosure of uniform emission, every direction hits exactly one wall, whose radiance
// is the same everywhere: L = E + albedo O L, cut off after the allowed bounces. T leads out of the
// enclosure, where there is nothing, so it must not matter. Detects walls hit twice by one ray (a wrong ray
// offset), wrong pdfs of light or direction sampling, wrong MIS weights, roulette without division, an O
// applied from the wrong side, and miscounted bounces.

namespace duolux::test {

namespace {

// A different albedo per channel: each case is three.
const glm::vec3 kAlbedo{0.1f, 0.5f, 0.8f};

/// White metal, which reflects everything.
struct Metal {
    float metallic, roughness;
};

struct Walls {
    Reflectance reflectance;
    std::uint32_t bounces = 0;
    Sides sides = Sides::kFront;  ///< both of f_opaque and of emission
    Emission emission{{1.0f, 0.5f, 2.0f}, {0.25f, 0.125f, 0.5f}, Sides::kFront};
    std::optional<Metal> metal{};
};

ExactCase enclosure(std::string name, const Walls& walls) {
    SceneBuilder builder;
    Material material;
    material.name = "wall";
    const glm::vec3 albedo = walls.metal ? glm::vec3(1.0f) : kAlbedo;
    material.baseColor = albedo;
    if (walls.metal) {
        material.metallic = walls.metal->metallic;
        material.roughness = walls.metal->roughness;
    }
    material.sides = walls.sides;
    material.emission = walls.emission;
    material.emission.sides = walls.sides;
    builder.sphere(glm::vec3(0.0f), 2.0f, 1, Facing::kInward, builder.add(material));
    LoadedScene& scene = builder.scene;
    scene.reflectance = walls.reflectance;
    scene.camera = {{0.3f, -0.2f, 0.4f}, {1.0f, 0.7f, -0.6f}, {0, 1, 0}, 80.0f};
    scene.settings.width = scene.settings.height = 32;
    scene.settings.bounces = walls.bounces;
    const ChannelMatrix scatter = scaled(albedo, reference::channelsOf(walls.reflectance.opaque));
    const ChannelLight emission = reference::channelsOf(walls.emission.invisible, walls.emission.visible);
    return {std::move(name), scene,
            uniformImage(32, 32, enclosureRadiance(scatter, emission, walls.bounces))};
}

/// Full matrices that differ per channel and do not commute; spectral radius of O below 1.25.
Reflectance fullReflectance() {
    return {{{0.5f, 0.2f, 0.7f}, {0.4f, 0.6f, 0.1f}, {0.3f, 0.9f, 0.5f}, {0.2f, 0.3f, 0.4f}},
            {{0.3f, 0.6f, 0.1f}, {0.2f, 0.1f, 0.5f}, {0.4f, 0.2f, 0.3f}, {0.1f, 0.5f, 0.7f}}};
}

}  // namespace

std::vector<ExactCase> enclosureCases() {
    std::vector<ExactCase> cases;
    for (const Preset& p : presets()) {
        // `one-bounce` without its hyphen: test names are plain.
        const std::string name = p.name == "one-bounce" ? "OneBounce" : std::string(p.name);
        cases.push_back(enclosure("EnclosureFront" + name, {blendReflectance(p.t, p.o), 24}));
        cases.push_back(enclosure("EnclosureBoth" + name, {blendReflectance(p.t, p.o), 24, Sides::kBoth}));
    }
    cases.push_back(enclosure("EnclosureBlend37", {blendReflectance(0.3f, 0.7f), 24, Sides::kBoth}));
    cases.push_back(enclosure("EnclosureBlend55", {blendReflectance(0.5f, 0.5f), 24}));
    Reflectance opaqueOnly = fullReflectance();
    opaqueOnly.transparent = {};
    cases.push_back(enclosure("EnclosureFullOpaque", {opaqueOnly, 24}));
    cases.push_back(enclosure("EnclosureFull", {fullReflectance(), 24, Sides::kBoth}));

    // The series itself: the n-th term is present if and only if n bounces are allowed.
    for (std::uint32_t bounces : {0u, 1u, 2u, 3u, 5u}) {
        cases.push_back(enclosure("EnclosureFullBounces" + std::to_string(bounces),
                                  {fullReflectance(), bounces, Sides::kBoth}));
    }
    // Deep paths: the limit leaves 0.8^65 = 5e-7 out of the infinite sum, and so does the expectation.
    cases.push_back(enclosure("EnclosureDeep", {preset("global"), 64}));
    // Spectral radius 1.6 in blue: each bounce returns more than it receives; six bounces have a finite sum.
    cases.push_back(enclosure("EnclosureGrowing", {Reflectance{matrix(2.0f, 0.0f, 1.0f, 0.0f), {}}, 6}));
    cases.push_back(enclosure("EnclosureDark", {preset("shadowless"), 24, Sides::kBoth, {}}));
    // Only visible light, and an O that turns it into invisible light and back.
    cases.push_back(enclosure("EnclosureExchange", {Reflectance{matrix(0.0f, 1.0f, 1.0f, 0.0f), {}},
                                                    24,
                                                    Sides::kFront,
                                                    {glm::vec3(0.0f), {1.0f, 2.0f, 0.5f}, Sides::kFront}}));
    return cases;
}

std::vector<ExactCase> metalCases() {
    // Each bounce passes on half of the light. The fits of multiple scattering are accurate to 1 %.
    const Reflectance half{matrix(0.5f, 0.0f, 1.0f, 0.0f), {}};
    const Emission emission = Walls{}.emission;
    std::vector<ExactCase> cases;
    const auto add = [&](const char* name, const Reflectance& reflectance, const Metal& metal) {
        Walls walls{reflectance, 12, Sides::kFront, emission, metal};
        cases.push_back(enclosure(std::string("EnclosureMetal") + name, walls));
        cases.back().relative = 0.01;
    };
    add("Rough", half, {1.0f, 0.9f});
    add("Glossy", half, {1.0f, 0.4f});
    add("Mixed", half, {0.5f, 0.6f});
    add("Crossed", {half.opaque, matrix(0.5f, 0.0f, 0.0f, 0.0f)}, {1.0f, 0.7f});
    // Exact, but light paths cannot connect a mirror to the camera.
    add("Mirror", half, {1.0f, 0.0f});
    cases.back().relative = 1e-5;
    cases.back().onePoint = true;
    return cases;
}

}  // namespace duolux::test
