#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "host/device_scene/device_camera.h"
#include "host/scene/image_plane.h"
#include "tests/reference/pinhole.h"
#include "tests/shader/harness/census.h"
#include "tests/shader/oracles.h"

// Compares camera rays, and connections from light paths to the camera, with the reference's rays in double
// precision.

DUOLUX_GLSL_TYPE(duolux::shared::DeviceCamera, "DeviceCamera", "");

namespace duolux::test {

/// CameraConnection as stored in a buffer.
struct Seen {
    std::uint32_t visible, pixel;
    glm::vec3 direction;
    float distance, importance;
};

}  // namespace duolux::test

DUOLUX_GLSL_TYPE(duolux::test::Seen, "Seen",
                 "uint visible; uint pixel; vec3 direction; float distance; float importance;");

namespace duolux::test {
namespace {

using reference::Vec3;

constexpr std::uint32_t kWidth = 37, kHeight = 23;
const Camera kCamera{{1.5f, -2.0f, 0.5f}, {-3.0f, 1.0f, 2.0f}, {0.2f, 1.0f, -0.1f}, 71.0f};

const ShaderLibrary& cameraLibrary() {
    static const ShaderLibrary library("shaders/lib/camera.glsl");
    return library;
}

/// Bounds for which no camera in these tests is distant.
constexpr Bounds kNear{{-100.0f, -100.0f, -100.0f}, {100.0f, 100.0f, 100.0f}};

shared::DeviceCamera recordOf(const Camera& camera, std::uint32_t width = kWidth,
                              std::uint32_t height = kHeight, const Bounds& bounds = kNear) {
    return deviceCamera(camera, width, height, bounds);
}

std::vector<glm::vec3> directionsThrough(const shared::DeviceCamera& camera,
                                         const std::vector<glm::vec2>& positions) {
    return cameraLibrary().evaluate<glm::vec3>("result = cameraRay(x0, x1).direction;", camera, positions);
}

std::vector<Seen> connect(const shared::DeviceCamera& camera, const std::vector<glm::vec3>& points) {
    return cameraLibrary().evaluate<Seen>(
        "CameraConnection c = connectToCamera(x0, x1);"
        "result = Seen(c.visible ? 1u : 0u, c.pixel, c.direction, c.distance, c.importance);",
        camera, points);
}

TEST(CameraDirection, IsThatOfTheReference) {
    for (const float vfov : {1.0f, 40.0f, 71.0f, 150.0f}) {
        for (const glm::uvec2 size : {glm::uvec2(37, 23), glm::uvec2(1, 1), glm::uvec2(2048, 16)}) {
            Camera view = kCamera;
            view.vfov = vfov;
            const reference::Pinhole pinhole(view, size.x, size.y);
            // Corners, the centre, and random positions.
            const glm::vec2 extent(size);
            std::vector<glm::vec2> positions{{0, 0}, {extent.x, 0}, {0, extent.y}, extent, 0.5f * extent};
            std::mt19937 engine(1);
            std::uniform_real_distribution<float> uniform;
            while (positions.size() < 500)
                positions.push_back(extent * glm::vec2(uniform(engine), uniform(engine)));
            const auto directions = directionsThrough(recordOf(view, size.x, size.y), positions);
            for (std::size_t i = 0; i < positions.size(); ++i) {
                const Vec3 expected =
                    pinhole.ray(static_cast<double>(positions[i].x), static_cast<double>(positions[i].y))
                        .direction;
                EXPECT_LT(glm::length(Vec3(directions[i]) - expected), 4e-7) << vfov << ", " << i;
            }
        }
    }
}

// A kind without a branch in a dispatch gets the results of another kind for the same record.
TEST(CameraKinds, AreToldApart) {
    const shared::DeviceCamera record = recordOf(kCamera);
    const std::vector<glm::vec2> position{{3.5f, 7.5f}};
    const std::vector<glm::vec3> point{kCamera.target + glm::vec3(0.3f, 0.2f, 0.1f)};
    std::vector<glm::vec3> rays, connections;
    for (std::uint32_t kind = 0; kind < shared::kCameraKinds; ++kind) {
        ShaderLibrary library("shaders/lib/camera.glsl");
        library.constant(shared::kSpecCamera, kind);
        rays.push_back(
            library.evaluate<glm::vec3>("result = cameraRay(x0, x1).direction;", record, position)[0]);
        connections.push_back(
            library.evaluate<glm::vec3>("result = connectToCamera(x0, x1).direction;", record, point)[0]);
        for (std::uint32_t other = 0; other < kind; ++other) {
            EXPECT_NE(rays[kind], rays[other]) << kind << " and " << other;
            EXPECT_NE(connections[kind], connections[other]) << kind << " and " << other;
        }
    }
}

// A scene of size 1, seen from up to a million times that distance: rays start in front of it and deviate
// from the exact rays by at most a unit in the last place of its coordinates, and its points are seen in the
// pixels of those rays.
TEST(CameraRay, FromFarAwayBeginsBeforeTheScene) {
    const Bounds bounds{{-0.5f, 2.0f, -0.25f}, {0.5f, 3.0f, 0.25f}};
    const glm::dvec3 centre(0.0, 2.5, 0.0);
    for (const float distance : {5.0f, 1e3f, 1e6f}) {
        Camera view;
        view.target = glm::vec3(centre);
        view.position =
            glm::vec3(centre + static_cast<double>(distance) * glm::normalize(glm::dvec3(3, 2, -1)));
        view.vfov = static_cast<float>(2.0 * glm::degrees(std::atan(0.7 / static_cast<double>(distance))));
        const RayStart start = rayStart(view, bounds);
        EXPECT_EQ(start.depth == 0.0f, distance < 10.0f);
        const shared::DeviceCamera record = recordOf(view, kWidth, kHeight, bounds);
        EXPECT_EQ(record.startDepth, start.depth);
        const reference::Pinhole pinhole(view, kWidth, kHeight);
        std::vector<glm::vec2> positions;
        for (int i = 0; i < 200; ++i)
            positions.emplace_back(0.5f + static_cast<float>(i % kWidth),
                                   0.5f + static_cast<float>(i % kHeight));
        const auto origins =
            cameraLibrary().evaluate<glm::vec3>("result = cameraRay(x0, x1).origin;", record, positions);
        std::vector<glm::vec3> points;
        const glm::dvec3 forward = glm::normalize(glm::dvec3(view.target) - glm::dvec3(view.position));
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const reference::Ray ray = pinhole.ray(positions[i].x, positions[i].y);
            const double along = glm::dot(glm::dvec3(origins[i]) - ray.origin, ray.direction);
            const double beside = glm::length(glm::dvec3(origins[i]) - ray.origin - along * ray.direction);
            EXPECT_LT(beside, distance < 10.0f ? 1e-6 : 3e-6) << distance << ", " << i;
            const double depth = glm::dot(centre - ray.origin, forward) / glm::dot(ray.direction, forward);
            EXPECT_LT(along, depth - 0.5);
            points.emplace_back(ray.origin + depth * ray.direction);
        }
        const std::vector<Seen> seen = connect(record, points);
        for (std::size_t i = 0; i < positions.size(); ++i)
            EXPECT_EQ(seen[i].pixel, static_cast<std::uint32_t>(positions[i].y) * kWidth +
                                         static_cast<std::uint32_t>(positions[i].x));
    }
}

TEST(CameraConnection, SeesAPointWhereTheCamerasRayGoes) {
    const reference::Pinhole pinhole(kCamera, kWidth, kHeight);
    std::mt19937 engine(3);
    std::uniform_real_distribution<double> uniform;
    std::vector<glm::vec3> points;
    std::vector<glm::dvec2> film;
    for (int i = 0; i < 4096; ++i) {
        // Keeps away from pixel edges, where single precision cannot tell the side of a point.
        const double x = static_cast<int>(uniform(engine) * kWidth) + 0.001 + 0.998 * uniform(engine);
        const double y = static_cast<int>(uniform(engine) * kHeight) + 0.001 + 0.998 * uniform(engine);
        film.emplace_back(x, y);
        const reference::Ray ray = pinhole.ray(x, y);
        points.emplace_back(ray.origin + std::exp(8.0 * uniform(engine) - 4.0) * ray.direction);
    }
    const std::vector<Seen> seen = connect(recordOf(kCamera), points);
    // The directions of the corners, for the area of the image plane at distance 1.
    const Vec3 forward = glm::normalize(Vec3(kCamera.target) - Vec3(kCamera.position));
    const auto onPlane = [&](double x, double y) {
        const Vec3 d = pinhole.ray(x, y).direction;
        return d / glm::dot(d, forward);
    };
    const double area =
        glm::length(onPlane(kWidth, 0) - onPlane(0, 0)) * glm::length(onPlane(0, kHeight) - onPlane(0, 0));
    Census pixels("visible and pixel"), distances("distance"), directions("direction"),
        importances("importance");
    for (std::size_t i = 0; i < points.size(); ++i) {
        pixels.compare(i, seen[i].visible, 1u);
        pixels.compare(
            i, seen[i].pixel,
            static_cast<std::uint32_t>(film[i].y) * kWidth + static_cast<std::uint32_t>(film[i].x));
        const Vec3 offset = Vec3(kCamera.position) - Vec3(points[i]);
        const double distance = glm::length(offset);
        distances.compare(i, seen[i].distance, distance, 1e-5 * distance);
        directions.compare(i, glm::length(Vec3(seen[i].direction) - offset / distance), 0.0, 2e-5);
        const double cosine = -glm::dot(offset, forward) / distance;
        importances.compare(
            i, static_cast<double>(seen[i].importance) * area * std::pow(cosine, 3) * distance * distance,
            1.0, 1e-4);
    }
}

TEST(CameraConnection, SeesNothingBesideOrBehind) {
    const reference::Pinhole pinhole(kCamera, kWidth, kHeight);
    std::vector<glm::vec3> points;
    for (const double x : {-1e4, -5.0, -0.01, kWidth + 0.01, kWidth + 5.0, 1e4}) {
        points.emplace_back(pinhole.ray(x, 0.5 * kHeight).origin +
                            3.0 * pinhole.ray(x, 0.5 * kHeight).direction);
        points.emplace_back(pinhole.ray(10, x).origin +
                            3.0 * pinhole.ray(10, x - (x > 0 ? kWidth - kHeight : 0)).direction);
    }
    for (const double x : {0.5, 18.0, 36.5}) {  // behind the camera
        points.emplace_back(pinhole.ray(x, 7).origin - 2.0 * pinhole.ray(x, 7).direction);
    }
    const std::vector<Seen> seen = connect(recordOf(kCamera), points);
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_EQ(seen[i].visible, 0u) << i;
}

/// Uniform radiance 1 gives every pixel the value 1: the importance is that of the whole image, so its
/// integral over the directions of a pixel is 1 / (number of pixels).
TEST(CameraConnection, ImportanceOfAPixelIntegratesToItsPart) {
    std::mt19937 engine(4);
    std::normal_distribution<float> normal;
    constexpr double kRadius = 2.0;
    std::vector<glm::vec3> points(1 << 20);
    for (glm::vec3& p : points) {
        const glm::vec3 d(normal(engine), normal(engine), normal(engine));
        p = kCamera.position + static_cast<float>(kRadius) * glm::normalize(d);
    }
    const std::vector<Seen> seen = connect(recordOf(kCamera), points);
    std::vector<double> sum(kWidth * kHeight), squares(kWidth * kHeight);
    double whole = 0.0;
    for (const Seen& s : seen) {
        const double value =
            s.visible != 0 ? static_cast<double>(s.importance) * kRadius * kRadius * 4.0 * std::numbers::pi
                           : 0.0;
        if (value == 0.0) continue;
        sum[s.pixel] += value;
        squares[s.pixel] += value * value;
        whole += value;
    }
    const auto n = static_cast<double>(points.size());
    EXPECT_NEAR(whole / n, 1.0, 0.01);  // 5 standard errors
    int beyond = 0;
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const double mean = sum[i] / n * kWidth * kHeight;
        const double error = std::sqrt(squares[i]) / n * kWidth * kHeight;
        beyond += std::abs(mean - 1.0) > 4.5 * error ? 1 : 0;
    }
    EXPECT_EQ(beyond, 0);  // of 851 pixels, 0.006 expected
}

template <typename Mirrored>
Mirrored mirrored(const shared::DeviceCamera& camera) {
    return {camera.position, camera.width, camera.forward,    camera.height, camera.right,
            camera.area,     camera.up,    camera.startDepth, camera.start};
}

TEST(CameraOracles, RaysAndConnections) {
    const shared::DeviceCamera record = recordOf(kCamera);
    const auto single = mirrored<mirror::single::DeviceCamera>(record);
    const auto twice = mirrored<mirror::twice::DeviceCamera>(record);
    std::mt19937 engine(6);
    std::uniform_real_distribution<float> uniform;
    std::vector<glm::vec2> positions;
    std::vector<glm::vec3> points;
    const reference::Pinhole pinhole(kCamera, kWidth, kHeight);
    for (int i = 0; i < 8192; ++i) {
        positions.push_back(glm::vec2(kWidth, kHeight) * glm::vec2(uniform(engine), uniform(engine)));
        // Centres of pixels, some of them beside the image, so that rounding does not change the pixel.
        const double x = std::floor(-5.0f + (kWidth + 10.0f) * uniform(engine)) + 0.5f;
        const double y = std::floor(-5.0f + (kHeight + 10.0f) * uniform(engine)) + 0.5f;
        const double distance = std::exp(6.0 * static_cast<double>(uniform(engine)) - 2.0);
        points.emplace_back(Vec3(kCamera.position) + distance * pinhole.ray(x, y).direction);
    }
    EXPECT_WITHIN_ORACLES(
        "direction", directionsThrough(record, positions), Budget{2, 3e-7},
        [&](const auto& p) { return mirror::single::cameraRay(single, p).direction; },
        [&](const auto& p) { return mirror::twice::cameraRay(twice, p).direction; }, positions);
    const std::vector<Seen> seen = connect(record, points);
    std::vector<glm::uvec2> pixels;
    std::vector<glm::vec4> rest;
    std::vector<float> importance;
    for (const Seen& s : seen) {
        pixels.emplace_back(s.visible, s.pixel);
        rest.emplace_back(s.direction, s.distance);
        importance.push_back(s.importance);
    }
    const auto compare = [&](const char* name, const auto& device, const Budget& budget, const auto& part) {
        EXPECT_WITHIN_ORACLES(
            name, device, budget,
            [&](const auto& p) { return part(mirror::single::connectToCamera(single, p)); },
            [&](const auto& p) { return part(mirror::twice::connectToCamera(twice, p)); }, points);
    };
    compare("pixel", pixels, {0, 0}, [](const auto& c) { return glm::uvec2(c.visible, c.pixel); });
    compare("direction, distance", rest, {4, 3e-7},
            [](const auto& c) { return glm::dvec4(c.direction, c.distance); });
    compare("importance", importance, {24, 0}, [](const auto& c) { return c.importance; });
}

}  // namespace
}  // namespace duolux::test
