#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "host/base/error.h"
#include "host/render/render.h"
#include "tests/reference/pinhole.h"
#include "tests/reference/triangles.h"
#include "tests/statistical/films.h"
#include "tests/support/cornell.h"
#include "tests/support/device.h"
#include "tests/support/exact_case.h"
#include "tests/support/scene_builder.h"
#include "tests/support/tunings.h"

// The layer `normal`: the normal of the first surface along camera rays, on the side of the camera, compared
// with closed forms and with a ray caster in double precision.

namespace duolux::test {

namespace {

using reference::Vec3;

std::vector<Vec3> normalsOf(const Film& film) {
    const std::vector<float> values = film.resolve(kLayerNormal);
    std::vector<Vec3> normals;
    for (std::size_t i = 0; i < values.size(); i += 3)
        normals.emplace_back(values[i], values[i + 1], values[i + 2]);
    return normals;
}

LoadedScene withNormals(LoadedScene scene, std::uint32_t width, std::uint32_t height, std::uint32_t spp) {
    scene.settings.width = width;
    scene.settings.height = height;
    scene.settings.spp = spp;
    scene.settings.bounces = 2;
    scene.settings.layers = kLayerNormal;
    return scene;
}

/// Means over pixels of `normalAt` for the first surface, by a grid of rays; and whether the pixel and a
/// margin around it show only one normal.
struct Expected {
    std::vector<Vec3> means;
    std::vector<bool> uniform;
};

template <typename NormalAt>
Expected expectedNormals(const LoadedScene& scene, NormalAt normalAt) {
    constexpr int kGrid = 24;  // rays across a pixel
    const auto width = scene.settings.width, height = scene.settings.height;
    const reference::Pinhole camera(scene.camera, width, height);
    const reference::Triangles triangles(scene.geometry);
    std::vector<reference::Crossing> crossings;
    const auto normalOf = [&](double x, double y) {
        const reference::Ray ray = camera.ray(x, y);
        triangles.crossings(ray, 1e30, reference::Triangles::kNone, reference::Triangles::kNone, crossings);
        if (crossings.empty()) return Vec3(0.0);
        const reference::Crossing& hit = crossings.front();
        const Vec3 flat = triangles.normal(hit.triangle) * (hit.front ? 1.0 : -1.0);
        return Vec3(normalAt(ray.origin + hit.distance * ray.direction, flat));
    };
    Expected expected;
    for (std::uint32_t pixel = 0; pixel < width * height; ++pixel) {
        const double left = pixel % width, top = pixel / width;
        const Vec3 centre = normalOf(left + 0.5, top + 0.5);
        Vec3 sum(0.0);
        bool uniform = true;
        for (int row = -1; row <= kGrid; ++row) {
            for (int column = -1; column <= kGrid; ++column) {
                const Vec3 normal = normalOf(left + (column + 0.5) / kGrid, top + (row + 0.5) / kGrid);
                uniform = uniform && glm::length(normal - centre) < 1e-9;
                const bool inside = std::min(row, column) >= 0 && std::max(row, column) < kGrid;
                if (inside) sum += normal;
            }
        }
        expected.means.push_back(sum / double(kGrid * kGrid));
        expected.uniform.push_back(uniform);
    }
    return expected;
}

/// 1024 points of a Sobol sequence and a grid of 576 differ by about 0.01 at an edge.
void expectNormals(const LoadedScene& scene, const Expected& expected, std::size_t uniformAtLeast) {
    const std::vector<Vec3> normals = normalsOf(render(device(), scene).film);
    ASSERT_EQ(normals.size(), expected.means.size());
    std::size_t uniform = 0;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const double tolerance = expected.uniform[i] ? 1e-6 : 0.03;
        EXPECT_LT(glm::length(normals[i] - expected.means[i]), tolerance)
            << i << ": " << normals[i].x << ' ' << normals[i].y << ' ' << normals[i].z << " for "
            << expected.means[i].x << ' ' << expected.means[i].y << ' ' << expected.means[i].z;
        uniform += expected.uniform[i] ? 1 : 0;
    }
    EXPECT_GE(uniform, uniformAtLeast);
}

Vec3 flatNormal(const Vec3&, const Vec3& normal) {
    return normal;
}

// A roof seen from above, with one side that shows its back, and nothing around it.
TEST(NormalLayer, OfPlanesIsExactOnBothSides) {
    SceneBuilder builder;
    LoadedScene& scene = builder.scene;
    Material lit, oneSided;
    lit.emission.visible = glm::vec3(1.0f);
    oneSided.sides = Sides::kFront;
    builder.quad({-2, -1, 0}, {0, -1, 1}, {0, 1, 1}, {-2, 1, 0}, builder.add(lit));
    builder.quad({0, -1, 1}, {0, 1, 1}, {1, 1, 0}, {1, -1, 0}, builder.add(oneSided));  // its back
    scene.camera = {{0, 0, 8}, {0, 0, 0}, {0, 1, 0}, 30.0f};
    for (const std::uint32_t bounces : {0u, 2u}) {
        LoadedScene rendered = withNormals(scene, 16, 16, 1024);
        rendered.settings.bounces = bounces;
        const std::vector<Vec3> normals = normalsOf(render(device(), rendered).film);
        const auto expectNear = [&](int x, int y, const Vec3& expected) {
            EXPECT_LT(glm::length(normals[16 * y + x] - expected), 1e-6) << x << ' ' << y;
        };
        expectNear(4, 8, glm::normalize(Vec3(-1, 0, 2)));
        expectNear(9, 8, glm::normalize(Vec3(1, 0, 1)));
        expectNear(4, 1, Vec3(0.0));
        expectNear(15, 15, Vec3(0.0));
        expectNormals(rendered, expectedNormals(rendered, flatNormal), 180);
    }
}

TEST(NormalLayer, OfFlatTrianglesIsThatOfTheReference) {
    const LoadedScene scene = withNormals(cornellBox(), 24, 24, 1024);
    expectNormals(scene, expectedNormals(scene, flatNormal), 250);
}

// Corners on a sphere, with the sphere's normals: interpolated, they point away from its centre.
TEST(NormalLayer, OfSmoothTrianglesIsInterpolated) {
    const glm::vec3 centre(0.5f, -1.0f, 2.0f);
    for (const Facing facing : {Facing::kOutward, Facing::kInward}) {
        SceneBuilder builder;
        builder.sphere(centre, 1.5f, 1, facing, builder.add(Material{}));
        LoadedScene& scene = builder.scene;
        for (const glm::vec3& position : scene.geometry.positions)
            scene.geometry.normals.push_back(glm::normalize(position - centre));
        scene.geometry.normalIndices = scene.geometry.triangles;
        scene.camera = {centre + glm::vec3(1, 2, 5), centre, {0, 1, 0}, 40.0f};
        const LoadedScene rendered = withNormals(scene, 24, 24, 1024);
        const Expected expected = expectedNormals(rendered, [&](const Vec3& hit, const Vec3& flat) {
            const Vec3 smooth = glm::normalize(hit - Vec3(centre));
            return glm::dot(smooth, flat) < 0.0 ? -smooth : smooth;
        });
        const std::vector<Vec3> normals = normalsOf(render(device(), rendered).film);
        std::size_t inside = 0;
        for (std::size_t i = 0; i < normals.size(); ++i) {
            // Inside the sphere the normals change slowly within a pixel.
            const bool interior = glm::length(expected.means[i]) > 0.98;
            EXPECT_LT(glm::length(normals[i] - expected.means[i]), interior ? 2e-3 : 0.03) << i;
            inside += interior ? 1 : 0;
        }
        EXPECT_GT(inside, 100u);
    }
}

// The first surface counts, whatever passes through it.
TEST(NormalLayer, DependsOnNothingButGeometry) {
    const LoadedScene first = withNormals(cornellBox(), 17, 11, 9);
    const Film film = render(device(), first).film;
    const auto expectSame = [&](const LoadedScene& scene, const RenderControl& control = {}) {
        EXPECT_TRUE(std::ranges::equal(render(device(), scene, control).film.layerSums(), film.layerSums()));
    };
    for (const Preset& preset : presets()) {
        SCOPED_TRACE(preset.name);
        for (const std::uint32_t bounces : {0u, 1u, 5u}) {
            LoadedScene scene = first;
            scene.reflectance = blendReflectance(preset.t, preset.o);
            scene.settings.bounces = bounces;
            expectSame(scene);
        }
    }
    LoadedScene mixed = withNormals(mixedCornellBox(), 17, 11, 9);
    mixed.geometry = first.geometry;
    for (std::uint32_t& material : mixed.geometry.materials)
        material %= static_cast<std::uint32_t>(mixed.materials.size());
    expectSame(mixed);
    LoadedScene dark = first;
    for (Material& material : dark.materials)
        material.emission = {};
    expectSame(dark);
    for (const TuningChoice& tuning : allTunings(device().info())) {
        if (tuning.layout == Layout::kRayQuery) continue;  // the driver rounds intersections differently
        SCOPED_TRACE(nameOf(tuning));
        RenderControl control;
        control.tuning = tuning;
        expectSame(first, control);
    }
}

/// Behind a sheet that is masked away, whatever light does there.
TEST(NormalLayer, IsOfTheFirstSurfaceThatIsThere) {
    SceneBuilder builder;
    Material sheet, wall;
    sheet.alpha = {AlphaMode::kMask, 0.25f, 0.5f};
    wall.name = "wall";
    const std::uint32_t masked = builder.add(sheet);
    builder.quad({-4, -4, 1}, {4, -4, 2}, {4, 4, 2}, {-4, 4, 1}, masked);
    builder.quad({-4, -4, 2}, {4, -4, 3}, {4, 4, 3}, {-4, 4, 2}, masked);
    builder.quad({-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}, builder.add(wall));
    builder.scene.pointEmitters = {{{0, 0, 3}, glm::vec3(1.0f), glm::vec3(1.0f)}};
    builder.scene.camera = {{0, 0, 8}, {0, 0, 0}, {0, 1, 0}, 30.0f};
    for (const Preset& preset : presets()) {
        for (const std::uint32_t bounces : {0u, 2u}) {
            LoadedScene scene = withNormals(builder.scene, 4, 4, 4);
            scene.reflectance = blendReflectance(preset.t, preset.o);
            scene.settings.bounces = bounces;
            for (const Vec3& normal : normalsOf(render(device(), scene).film))
                EXPECT_LT(glm::length(normal - Vec3(0, 0, 1)), 1e-6) << preset.name << bounces;
        }
    }
}

TEST(NormalLayer, LeavesRadianceAsItIs) {
    LoadedScene scene = withNormals(mixedCornellBox(), 19, 13, 7);
    const Film with = render(device(), scene).film;
    scene.settings.layers = 0;
    const Film without = render(device(), scene).film;
    EXPECT_TRUE(without.layerSums().empty());
    EXPECT_FALSE(sameBits(with, without));
    const Film radiance({.width = with.width(),
                         .height = with.height(),
                         .quantum = with.quantum(),
                         .sums = Film::Sums(with.sums().begin(), with.sums().end()),
                         .samples = Film::Samples(with.samples().begin(), with.samples().end()),
                         .carries = with.carries()});
    EXPECT_TRUE(sameBits(radiance, without));
}

// Parts of all kinds: dispatches, states to resume from, ranges of samples, dispatches that the driver ends
// early.
TEST(NormalLayer, IsTheSameBitsHoweverTheWorkIsSplit) {
    const LoadedScene scene = withNormals(mixedCornellBox(), 19, 13, 21);
    const Film whole = render(device(), scene).film;
    std::vector<RenderState> states;
    RenderControl inParts;
    inParts.limits.maxPixelsPerDispatch = 100;
    inParts.limits.maxSamplesPerDispatch = 6;
    inParts.checkpointSeconds = 0.0;
    inParts.onCheckpoint = [&](const Film& film, const RenderStatistics&) {
        states.push_back({film, 0.0, 0.0, false});
    };
    EXPECT_TRUE(sameBits(render(device(), scene, inParts).film, whole));
    ASSERT_GT(states.size(), 5u);
    for (std::size_t i = 0; i < states.size(); i += 1 + states.size() / 4) {
        RenderControl control;
        control.resume = &states[i];
        EXPECT_TRUE(sameBits(render(device(), scene, control).film, whole)) << i;
    }

    Film sum(whole.width(), whole.height(), whole.quantum(), kLayerNormal);
    const std::uint32_t bounds[] = {0, 1, 8, 21};
    for (const int i : {2, 0, 1}) {
        RenderControl control;
        control.samples = SampleRange{bounds[i], bounds[i + 1]};
        sum.add(render(device(), scene, control).film);
    }
    EXPECT_TRUE(sameBits(sum, whole));

    const LoadedScene panes = withNormals(stackedPanesCase(100).scene, 24, 24, 9);
    RenderControl oneByOne;
    oneByOne.limits.maxSamplesPerLane = 1;
    const RenderOutput panesWhole = render(device(), panes);
    EXPECT_TRUE(sameBits(render(device(), panes, oneByOne).film, panesWhole.film));
}

TEST(NormalLayer, IsRefusedByTheLightTracer) {
    EXPECT_THROW(render(device(), byLight(withNormals(cornellBox(), 8, 8, 1))), UsageError);
}

}  // namespace

}  // namespace duolux::test
