#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "host/render/render.h"
#include "tests/statistical/renders.h"
#include "tests/support/closed_form.h"
#include "tests/support/device.h"
#include "tests/support/exact_case.h"
#include "tests/support/scene_builder.h"

// Materials beyond diffuse ones: what absorbs nothing is invisible in uniform light, and both integrators
// agree on all.

namespace duolux::test {

namespace {

struct MaterialCase {
    std::string name;
    Material material;
};

/// For messages of the test framework.
void PrintTo(const MaterialCase& c, std::ostream* out) {
    *out << c.name;
}

Material white() {
    Material material;
    material.name = "object";
    material.baseColor = glm::vec3(1.0f);
    return material;
}

template <typename Change>
MaterialCase caseOf(std::string name, const Change& change) {
    Material material = white();
    change(material);
    return {std::move(name), material};
}

/// Materials that absorb nothing.
std::vector<MaterialCase> whiteCases() {
    return {caseOf("Dielectric",
                   [](Material& m) {
                       m.specular = 1.0f;
                       m.roughness = 0.3f;
                   }),
            caseOf("Glass",
                   [](Material& m) {
                       m.specular = m.transmission = 1.0f;
                       m.roughness = 0.0f;
                   }),
            caseOf("RoughGlass",
                   [](Material& m) {
                       m.specular = m.transmission = 1.0f;
                       m.roughness = 0.5f;
                   }),
            caseOf("ThinGlass",
                   [](Material& m) {
                       m.specular = m.transmission = 1.0f;
                       m.roughness = 0.4f;
                       m.thin = true;
                   }),
            caseOf("Clearcoat",
                   [](Material& m) {
                       m.metallic = 1.0f;
                       m.roughness = 0.6f;
                       m.clearcoat = 1.0f;
                   }),
            caseOf("StretchedMetal",
                   [](Material& m) {
                       m.metallic = 1.0f;
                       m.roughness = 0.4f;
                       m.anisotropy = 0.8f;
                   }),
            caseOf("Sheen",
                   [](Material& m) {
                       m.sheenColor = glm::vec3(1.0f);
                       m.sheenRoughness = 0.4f;
                   }),
            caseOf("Blend", [](Material& m) {
                m.specular = 1.0f;
                m.roughness = 0.4f;
                m.alpha = {AlphaMode::kBlend, 0.4f, 0.5f};
            })};
}

double meanVisible(const RadianceImage& image) {
    double sum = 0.0;
    for (const glm::vec3& v : image.visible)
        sum += static_cast<double>(v.x + v.y + v.z) / 3.0;
    return sum / static_cast<double>(image.visible.size());
}

/// Radiance 1 in both components from everywhere: a black box around the origin that emits inwards.
SceneBuilder uniformLight(float halfSize) {
    SceneBuilder builder;
    Material wall;
    wall.name = "wall";
    wall.baseColor = glm::vec3(0.0f);
    wall.emission = {glm::vec3(1.0f), glm::vec3(1.0f), Sides::kFront};
    builder.box(glm::vec3(-halfSize), glm::vec3(halfSize), Facing::kInward, builder.add(wall));
    return builder;
}

class WhiteFurnace : public testing::TestWithParam<MaterialCase> {};

/// Radiance 1 everywhere, in front of and behind an object of any shape.
TEST_P(WhiteFurnace, HidesWhatAbsorbsNothing) {
    SceneBuilder builder = uniformLight(4.0f);
    const std::uint32_t object = builder.add(GetParam().material);
    builder.sphere({0, 0, 0}, 1.0f, 2, Facing::kOutward, object);
    LoadedScene& scene = builder.scene;
    scene.reflectance = preset("global");
    scene.camera = {{0.3f, 0.4f, 3.0f}, {0, 0, 0}, {0, 1, 0}, 40.0f};
    scene.settings.width = scene.settings.height = 16;
    scene.settings.bounces = 64;
    const ChannelLight one = {{{1.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}}};
    LoadedScene gathered = scene;
    gathered.settings.spp = 1024;
    EXPECT_NEAR(meanVisible(render(device(), gathered).film.resolve()), 1.0, 0.005);
    expectAgreement("WhiteFurnace" + GetParam().name, renderSeeds(scene, 32, 16), uniformImage(16, 16, one),
                    {.relative = 0.01});
}

INSTANTIATE_TEST_SUITE_P(Often, WhiteFurnace, testing::ValuesIn(oftenCases(whiteCases())),
                         [](const auto& test) { return test.param.name; });
INSTANTIATE_TEST_SUITE_P(Nightly, WhiteFurnace, testing::ValuesIn(nightlyCases(whiteCases())),
                         [](const auto& test) { return test.param.name; });

/// Microfacets that do not bend light.
INSTANTIATE_TEST_SUITE_P(AirInAir, WhiteFurnace,
                         testing::Values(caseOf("RoughGlassWithTheIndexOfAir",
                                                [](Material& m) {
                                                    m.specular = m.transmission = 1.0f;
                                                    m.roughness = 0.5f;
                                                    m.ior = 1.0f;
                                                })),
                         [](const auto& test) { return test.param.name; });

/// As whiteCases(), but with colours, and without smooth surfaces, which light paths do not show.
std::vector<MaterialCase> rougherCases() {
    std::vector<MaterialCase> cases = whiteCases();
    std::erase_if(cases, [](const MaterialCase& c) { return c.name == "Glass"; });
    for (MaterialCase& c : cases) {
        c.material.baseColor = {0.9f, 0.6f, 0.3f};
        c.material.clearcoatRoughness = 0.4f;
    }
    cases.push_back(caseOf("Anisotropic", [](Material& m) {
        m.metallic = 1.0f;
        m.roughness = 0.5f;
        m.anisotropy = 0.7f;
        m.anisotropyRotation = 30.0f;
    }));
    cases.push_back(caseOf("TintedGlass", [](Material& m) {
        m.specular = m.transmission = 1.0f;
        m.roughness = 0.7f;
        m.attenuationColor = {0.9f, 0.5f, 0.2f};
        m.attenuationDistance = 0.5f;
    }));
    cases.push_back(caseOf("Everything", [](Material& m) {
        m.baseColor = {0.9f, 0.6f, 0.3f};
        m.specular = 0.8f;
        m.metallic = 0.2f;
        m.transmission = 0.4f;
        m.roughness = 0.4f;
        m.clearcoat = 0.5f;
        m.clearcoatRoughness = 0.3f;
        m.sheenColor = {0.2f, 0.3f, 0.4f};
        m.sheenRoughness = 0.5f;
        m.alpha = {AlphaMode::kBlend, 0.7f, 0.5f};
    }));
    return cases;
}

class MaterialPair : public testing::TestWithParam<MaterialCase> {};

/// A sphere on a floor, lit by a lamp.
LoadedScene sphereOnFloor(const Material& material, const Reflectance& reflectance) {
    SceneBuilder builder;
    builder.sphere({0, 1, 0}, 1.0f, 2, Facing::kOutward, builder.add(material));
    Geometry& geometry = builder.scene.geometry;
    geometry.normalIndices = geometry.triangles;
    for (const glm::vec3& p : geometry.positions)
        geometry.normals.push_back(glm::normalize(p - glm::vec3(0, 1, 0)));
    Material floor;
    floor.name = "floor";
    floor.baseColor = {0.3f, 0.6f, 0.8f};
    builder.quad({-3, -0.2f, -3}, {-3, -0.2f, 3}, {3, -0.2f, 3}, {3, -0.2f, -3}, builder.add(floor));
    Material lamp;
    lamp.name = "lamp";
    lamp.baseColor = glm::vec3(0.0f);
    lamp.emission = {{20, 15, 10}, {5, 10, 15}, Sides::kFront};
    builder.quad({-1.5f, 4, 0}, {-1.5f, 3, 1}, {-2.5f, 2, 0}, {-2.5f, 3, -1}, builder.add(lamp));
    geometry.normalIndices.resize(geometry.triangles.size(), glm::uvec3(Geometry::kNoNormal));
    LoadedScene& scene = builder.scene;
    scene.reflectance = reflectance;
    scene.camera = {{0.5f, 2.5f, 5}, {0, 0.7f, 0}, {0, 1, 0}, 40.0f};
    scene.settings.width = scene.settings.height = 16;
    scene.settings.bounces = 4;
    return scene;
}

TEST_P(MaterialPair, GatheringAndShootingAgree) {
    const LoadedScene scene = sphereOnFloor(GetParam().material, blendReflectance(0.6f, 0.7f));
    expectAgreement("Material" + GetParam().name + "Light", renderByLight(scene, 128, 16),
                    estimatesOf(renderSeeds(scene, 64, 16, 1000)), {.lightPaths = true});
}

INSTANTIATE_TEST_SUITE_P(Often, MaterialPair, testing::ValuesIn(oftenCases(rougherCases())),
                         [](const auto& test) { return test.param.name; });
INSTANTIATE_TEST_SUITE_P(Nightly, MaterialPair, testing::ValuesIn(nightlyCases(rougherCases())),
                         [](const auto& test) { return test.param.name; });

/// A black sheet with a smooth clearcoat, of index 1.5, in uniform light: both sides reflect 4 % at normal
/// incidence.
TEST(Clearcoat, LiesOnBothSidesOfAnOpaqueSheet) {
    SceneBuilder builder = uniformLight(9.0f);
    Material varnished = white();
    varnished.baseColor = glm::vec3(0.0f);
    varnished.clearcoat = 1.0f;
    builder.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, builder.add(varnished));
    LoadedScene& scene = builder.scene;
    scene.reflectance = preset("global");
    scene.settings.width = scene.settings.height = 8;
    for (const float side : {1.0f, -1.0f}) {
        scene.camera = {{0, 0, 5.0f * side}, {0, 0, 0}, {0, 1, 0}, 0.2f};
        EXPECT_NEAR(meanVisible(render(device(), scene).film.resolve()), 0.04, 1e-4)
            << "from z = " << 5 * side;
    }
}

/// Under `local` nothing stops invisible light, but a wall hides from the camera what is behind it, also
/// behind a pane that is there in part.
TEST(Blend, PaneShowsTheWallBehindIt) {
    SceneBuilder builder;
    Material pane;
    pane.name = "pane";
    pane.baseColor = glm::vec3(0.0f);
    pane.alpha = {AlphaMode::kBlend, 0.5f, 0.5f};
    Material wall = pane;
    wall.name = "wall";
    wall.alpha = {};
    Material lamp = wall;
    lamp.name = "lamp";
    lamp.emission = {glm::vec3(1.0f), glm::vec3(1.0f), Sides::kBoth};
    float z = 1.0f;
    for (const Material& material : {pane, wall, lamp}) {
        builder.quad({-4, -4, z}, {4, -4, z}, {4, 4, z}, {-4, 4, z}, builder.add(material));
        z -= 1.0f;
    }
    LoadedScene& scene = builder.scene;
    scene.reflectance = preset("local");
    scene.camera = {{0.2f, 0.1f, 5}, {0, 0, 0}, {0, 1, 0}, 40.0f};
    scene.settings.width = scene.settings.height = 8;
    scene.settings.spp = 4;
    for (const std::uint32_t bounces : {0u, 1u, 4u}) {
        scene.settings.bounces = bounces;
        const RadianceImage image = render(device(), scene).film.resolve();
        for (std::size_t i = 0; i < image.visible.size(); ++i) {
            EXPECT_EQ(image.visible[i], glm::vec3(0.0f)) << bounces << " bounces, pixel " << i;
            EXPECT_NEAR(image.invisible[i].y, 1.0f, 1e-5f) << bounces << " bounces, pixel " << i;
        }
    }
}

/// A lamp over a floor, with black panes in between that are there by the fractions `alphas`.
LoadedScene lampBehindPanes(const std::vector<float>& alphas, const Reflectance& reflectance) {
    SceneBuilder builder;
    Material floor = white();
    floor.baseColor = {0.8f, 0.5f, 0.3f};
    builder.quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}, builder.add(floor));
    Material lamp;
    lamp.name = "lamp";
    lamp.baseColor = glm::vec3(0.0f);
    lamp.emission = {glm::vec3(4.0f), glm::vec3(4.0f), Sides::kFront};
    builder.quad({-1, -1, 4}, {-1, 1, 4}, {1, 1, 4}, {1, -1, 4}, builder.add(lamp));
    float z = 2.0f;
    for (const float alpha : alphas) {
        Material pane = lamp;
        pane.name = "pane";
        pane.emission = {};
        pane.alpha = {AlphaMode::kBlend, alpha, 0.5f};
        builder.quad({-20, -20, z}, {20, -20, z}, {20, 20, z}, {-20, 20, z}, builder.add(pane));
        z += 0.5f;
    }
    LoadedScene& scene = builder.scene;
    scene.reflectance = reflectance;
    scene.settings.width = scene.settings.height = 16;
    scene.settings.bounces = 2;
    return scene;
}

/// The floor behind panes gets as much less light as they are there, and so does the camera, by every way.
TEST(Blend, PanesWeakenLightByAsMuchAsIsThere) {
    const double through = (1.0 - 0.5) * (1.0 - 0.7);
    struct View {
        Camera camera;
        double factor;
    };
    const View views[] = {
        {{{2, 1, 1}, {0, 0, 0}, {0, 0, 1}, 60.0f}, through},               // of the lit floor
        {{{2, 1, 3.5f}, {0, 0, 0}, {0, 0, 1}, 60.0f}, through * through},  // through the panes
        {{{2, 1, 1}, {0, 0, 4}, {0, 0, 1}, 30.0f}, through}};              // of the lamp
    for (const Integrator integrator : {Integrator::kPathTracer, Integrator::kLightTracer}) {
        for (const View& view : views) {
            LoadedScene clear = lampBehindPanes({}, preset("global"));
            LoadedScene weakened = lampBehindPanes({0.5f, 0.7f}, preset("global"));
            for (LoadedScene* scene : {&clear, &weakened}) {
                scene->camera = view.camera;
                scene->settings.integrator = integrator;
                scene->settings.spp = 256;
            }
            const double expected = view.factor * meanVisible(render(device(), clear).film.resolve());
            EXPECT_NEAR(meanVisible(render(device(), weakened).film.resolve()) / expected, 1.0, 0.01)
                << "from z = " << view.camera.position.z
                << (integrator == Integrator::kLightTracer ? ", light" : "");
        }
    }
}

/// A parallel plate of smooth glass without absorption in uniform light behind it: all inner reflections
/// together transmit (1 - R) / (1 + R) at normal incidence, where R = ((n - 1) / (n + 1))^2 is that of one
/// interface.
TEST(Glass, PlateTransmitsTheSeriesOfInnerReflections) {
    SceneBuilder builder;
    Material glass = white();
    glass.specular = glass.transmission = 1.0f;
    glass.roughness = 0.0f;
    glass.ior = 2.0f;
    builder.box({-50, -50, -0.5f}, {50, 50, 0.5f}, Facing::kOutward, builder.add(glass));
    Material lamp;
    lamp.name = "lamp";
    lamp.baseColor = glm::vec3(0.0f);
    lamp.emission = {glm::vec3(1.0f), glm::vec3(1.0f), Sides::kFront};
    builder.quad({-1, -1, -2}, {1, -1, -2}, {1, 1, -2}, {-1, 1, -2}, builder.add(lamp));
    LoadedScene& scene = builder.scene;
    scene.reflectance = preset("global");
    scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 0.2f};
    scene.settings.width = scene.settings.height = 8;
    scene.settings.bounces = 64;
    const double r = 1.0 / 9.0, expected = (1.0 - r) / (1.0 + r);
    expectAgreement("GlassPlate", renderSeeds(scene, 64, 16),
                    uniformImage(8, 8, {{{expected, expected}, {expected, expected}, {expected, expected}}}),
                    {.relative = 1e-3});
}

/// Radiance that a rough interface transmits from a lamp, by quadrature: single scattering, Walter et al.
/// 2007, equation 21. The interface is the plane z = 0, seen from the origin along `view` (unit, away from
/// it), with `eta` the index of the lamp's side relative to that of the view; the lamp of radiance 1 is a
/// square of the half width `a` in the plane z = -depth.
double refractedRadiance(const glm::dvec3& view, double eta, double alpha, double a, double depth) {
    const auto lambda = [&](double z) {
        return 0.5 * (std::sqrt(1.0 + alpha * alpha * (1.0 - z * z) / (z * z)) - 1.0);
    };
    const int n = 2000;
    double sum = 0.0;
    for (int x = 0; x < n; x++) {
        for (int y = 0; y < n; y++) {
            const glm::dvec3 to((2.0 * x + 1.0) / n * a - a, (2.0 * y + 1.0) / n * a - a, -depth);
            const glm::dvec3 wi = glm::normalize(to);
            glm::dvec3 m = glm::normalize(view + eta * wi);
            if (m.z < 0.0) m = -m;
            const double o = glm::dot(view, m), i = glm::dot(wi, m);
            if (o <= 0.0 || i >= 0.0) continue;
            const double sineSquared = (1.0 - o * o) / (eta * eta);
            if (sineSquared >= 1.0) continue;
            const double t = std::sqrt(1.0 - sineSquared);
            const double s = (o - eta * t) / (o + eta * t), p = (eta * o - t) / (eta * o + t);
            const double c = m.z * m.z * (alpha * alpha - 1.0) + 1.0;
            const double d = alpha * alpha / (std::numbers::pi * c * c);
            const double g = 1.0 / (1.0 + lambda(view.z) + lambda(wi.z));
            const double jacobian = o * -i / (view.z * (o + eta * i) * (o + eta * i));
            sum += (1.0 - 0.5 * (s * s + p * p)) * d * g * jacobian * depth / std::pow(glm::length(to), 3);
        }
    }
    return sum * (2.0 * a / n) * (2.0 * a / n);
}

/// Direct light on the other side of rough glass, from lamps so large that both ways to find it count: that
/// of the path tracer to the lamp, and scattering towards it. At this roughness single scattering is 99 % of
/// all.
TEST(Glass, RoughInterfaceTransmitsDirectLight) {
    for (const bool fromInside : {false, true}) {
        for (const double a : {0.05, 0.3, 0.7}) {
            SceneBuilder builder;
            Material glass = white();
            glass.specular = glass.transmission = 1.0f;
            glass.roughness = 0.3f;
            const std::uint32_t interface = builder.add(glass);
            const float h = 0.5f;
            if (fromInside) {
                builder.quad({-h, -h, 0}, {-h, h, 0}, {h, h, 0}, {h, -h, 0}, interface);
            } else {
                builder.quad({-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}, interface);
            }
            Material lamp;
            lamp.name = "lamp";
            lamp.baseColor = glm::vec3(0.0f);
            lamp.emission = {glm::vec3(1.0f), glm::vec3(1.0f), Sides::kFront};
            const float w = static_cast<float>(a);
            builder.quad({-w, -w, -2}, {w, -w, -2}, {w, w, -2}, {-w, w, -2}, builder.add(lamp));
            LoadedScene& scene = builder.scene;
            scene.reflectance = preset("global");
            scene.camera = {{0.4f, 0.1f, 3}, {0, 0, 0}, {0, 1, 0}, 0.01f};
            scene.settings.width = scene.settings.height = 8;
            scene.settings.spp = 4096;
            scene.settings.bounces = 1;
            const double eta = fromInside ? 1.0 / 1.5 : 1.5;
            const double expected =
                refractedRadiance(glm::normalize(glm::dvec3(0.4, 0.1, 3)), eta, 0.09, a, 2.0);
            EXPECT_NEAR(meanVisible(render(device(), scene).film.resolve()), expected, 0.015 * expected)
                << fromInside << a;
        }
    }
}

}  // namespace

}  // namespace duolux::test
