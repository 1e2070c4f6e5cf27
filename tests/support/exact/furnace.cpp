#include <cmath>
#include <utility>

#include "tests/support/closed_form.h"
#include "tests/support/exact_case.h"
#include "tests/support/scene_builder.h"

// Every surface m of a closed scene emits E_m = (1 - q) (I - T_m) L on both sides and scatters so that albedo
// O_m L = q (I - T_m) L, for one vector L and number q. Radiance L everywhere then solves eq. 16, and n
// bounces leave out q^(n+1) L: along any ray, the sum over crossings of T_1..T_(k-1) (I - T_k) L telescopes
// to L, because the outermost T is 0. So the image is (1 - q^(n+1)) L in every pixel, for any shapes and any
// T in any order. Objects that intersect without symmetry test every product of matrices.

namespace duolux::test {

namespace {

const ChannelLight kLight = {{{1.0, 0.5}, {0.8, 1.6}, {0.3, 1.0}}};
const double kKept[3] = {0.5, 0.75, 0.25};  ///< q per channel
constexpr double kFurnaceAlbedo = 0.5;

/// The material of that furnace for a transmittance; `lean`, 0..1, divides O between its columns.
Material furnaceMaterial(const char* name, const ReflectanceMatrix& transparent, double lean) {
    Material material;
    material.name = name;
    material.baseColor = glm::vec3(static_cast<float>(kFurnaceAlbedo));
    material.reflectance = Reflectance{{}, transparent};
    ReflectanceMatrix& o = material.reflectance->opaque;
    material.emission.sides = Sides::kBoth;
    const ChannelMatrix t = reference::channelsOf(transparent);
    for (int c = 0; c < 3; ++c) {
        const auto i = static_cast<std::size_t>(c);
        const reference::Vec2 withheld = kLight[i] - t[i] * kLight[i];
        const reference::Vec2 scattered = kKept[c] * withheld / kFurnaceAlbedo;
        o.m00[c] = static_cast<float>(lean * scattered.x / kLight[i].x);
        o.m01[c] = static_cast<float>((1.0 - lean) * scattered.x / kLight[i].y);
        o.m10[c] = static_cast<float>((1.0 - lean) * scattered.y / kLight[i].x);
        o.m11[c] = static_cast<float>(lean * scattered.y / kLight[i].y);
        material.emission.invisible[c] = static_cast<float>((1.0 - kKept[c]) * withheld.x);
        material.emission.visible[c] = static_cast<float>((1.0 - kKept[c]) * withheld.y);
    }
    return material;
}

ExactCase furnace(std::string name, bool panes, std::uint32_t bounces) {
    // T L <= L in both components, so emission and scattering are non-negative.
    const ReflectanceMatrix a{{0.2f, 0.6f, 0.1f}, {0.5f, 0.1f, 0.2f}, {0.1f, 0.7f, 0.9f}, {0.2f, 0.5f, 0.1f}};
    const ReflectanceMatrix b{{0.7f, 0.1f, 0.2f}, {0.1f, 0.3f, 0.1f}, {0.2f, 0.2f, 0.4f}, {0.4f, 0.3f, 0.7f}};
    const ReflectanceMatrix c{{0.0f, 0.2f, 0.3f}, {0.8f, 0.2f, 0.1f}, {0.3f, 0.0f, 0.5f}, {0.0f, 0.6f, 0.2f}};
    SceneBuilder builder;
    const std::uint32_t wall = builder.add(furnaceMaterial("wall", {}, 0.7));
    builder.box({-2, -1.5f, -2.5f}, {2, 1.5f, 2}, Facing::kInward, wall);
    const std::uint32_t first = builder.add(furnaceMaterial("first", a, 0.3));
    const std::uint32_t second = builder.add(furnaceMaterial("second", b, 0.9));
    const std::uint32_t third = builder.add(furnaceMaterial("third", c, 0.5));
    builder.sphere({-0.4f, 0.1f, -0.6f}, 0.7f, 0, Facing::kOutward, first);
    builder.sphere({0.3f, -0.1f, -0.9f}, 0.8f, 0, Facing::kInward, second);
    builder.box({-1.2f, -1.4f, -1.9f}, {0.1f, -0.3f, -0.7f}, Facing::kOutward, third);
    if (panes) {
        builder.quad({-1.5f, -1.2f, 0.2f}, {1.4f, -1.0f, -0.1f}, {1.3f, 1.1f, -0.4f}, {-1.6f, 0.9f, 0.1f},
                     first);
        builder.quad({-1.0f, -1.1f, -0.3f}, {0.9f, -1.3f, 0.5f}, {1.1f, 1.2f, 0.3f}, {-0.8f, 1.0f, -0.2f},
                     third);
        builder.quad({1.2f, -0.9f, -1.5f}, {1.0f, -0.8f, 1.0f}, {1.3f, 0.9f, 1.2f}, {1.1f, 1.0f, -1.4f},
                     second);
    }
    LoadedScene& scene = builder.scene;
    scene.reflectance = preset("global");
    scene.camera = {{0.2f, 0.3f, 1.7f}, {-0.1f, -0.1f, -1.0f}, {0, 1, 0}, 60.0f};
    scene.settings.width = scene.settings.height = 32;
    scene.settings.bounces = bounces;
    ChannelLight expected;
    for (std::size_t i = 0; i < 3; ++i)
        expected[i] = (1.0 - std::pow(kKept[i], bounces + 1.0)) * kLight[i];
    return {std::move(name), scene, uniformImage(32, 32, expected)};
}

}  // namespace

std::vector<ExactCase> furnaceCases() {
    std::vector<ExactCase> cases;
    for (std::uint32_t bounces : {0u, 1u, 2u, 6u}) {
        cases.push_back(furnace("FurnaceSolids" + std::to_string(bounces), false, bounces));
        cases.push_back(furnace("FurnacePanes" + std::to_string(bounces), true, bounces));
    }
    // Both components count, whatever is displayed.
    for (const auto& [name, display] : {std::pair("FurnaceDisplayInvisible", glm::vec2(1.0f, 0.0f)),
                                        std::pair("FurnaceDisplayDifference", glm::vec2(-1.0f, 0.5f))}) {
        cases.push_back(furnace(name, true, 2));
        cases.back().scene.display = display;
    }
    return cases;
}

}  // namespace duolux::test
