#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "shaders/shared/path_layout.h"
#include "tests/reference/pinhole.h"
#include "tests/support/run_kernel.h"

namespace duolux::spirv {
extern const std::span<const std::uint32_t> kCameraTest;
}

// How light paths see the camera, against the camera rays of the reference in double precision.

namespace duolux::test {
namespace {

using reference::Vec3;

struct CameraOutput {
    std::uint32_t visible, pixel;
    glm::vec3 direction;
    float distance, importance;
};

constexpr std::uint32_t kWidth = 37, kHeight = 23;
const Camera kCamera{{1.5f, -2.0f, 0.5f}, {-3.0f, 1.0f, 2.0f}, {0.2f, 1.0f, -0.1f}, 71.0f};

shared::PathParams paramsOf(const Camera& camera) {
    const Vec3 forward = glm::normalize(Vec3(camera.target) - Vec3(camera.position));
    const Vec3 right = glm::normalize(glm::cross(forward, Vec3(camera.up)));
    const double half = std::tan(static_cast<double>(camera.vfov) * std::numbers::pi / 360.0);
    shared::PathParams params{};
    params.width = kWidth;
    params.height = kHeight;
    params.cameraPosition = camera.position;
    params.cameraForward = forward;
    params.cameraRight = right * (half * kWidth / kHeight);
    params.cameraUp = glm::cross(right, forward) * half;
    params.imageArea = static_cast<float>(4.0 * half * half * kWidth / kHeight);
    return params;
}

std::vector<CameraOutput> connect(const std::vector<glm::vec3>& points) {
    const shared::PathParams params = paramsOf(kCamera);
    const Buffer input = Buffer::upload<glm::vec3>(device(), BufferUse::kStorage, points, "points");
    const Buffer block =
        Buffer::upload(device(), BufferUse::kUniform, std::as_bytes(std::span(&params, 1)), "parameters");
    const auto count = static_cast<std::uint32_t>(points.size());
    return runKernel<CameraOutput>(spirv::kCameraTest, {{0, &input}, {2, &block}}, 1, count, count);
}

TEST(CameraConnection, SeesAPointWhereTheCamerasRayGoes) {
    const reference::Pinhole pinhole(kCamera, kWidth, kHeight);
    std::mt19937 engine(3);
    std::uniform_real_distribution<double> uniform;
    std::vector<glm::vec3> points;
    std::vector<glm::dvec2> film;
    for (int i = 0; i < 4096; ++i) {
        // Within the pixels, as single precision cannot tell on which side of an edge a point is.
        const double x = static_cast<int>(uniform(engine) * kWidth) + 0.001 + 0.998 * uniform(engine);
        const double y = static_cast<int>(uniform(engine) * kHeight) + 0.001 + 0.998 * uniform(engine);
        film.emplace_back(x, y);
        const reference::Ray ray = pinhole.ray(x, y);
        points.emplace_back(ray.origin + std::exp(8.0 * uniform(engine) - 4.0) * ray.direction);
    }
    const std::vector<CameraOutput> seen = connect(points);
    // The directions of the corners, for the area of the image plane at distance 1.
    const Vec3 forward = glm::normalize(Vec3(kCamera.target) - Vec3(kCamera.position));
    const auto onPlane = [&](double x, double y) {
        const Vec3 d = pinhole.ray(x, y).direction;
        return d / glm::dot(d, forward);
    };
    const double area =
        glm::length(onPlane(kWidth, 0) - onPlane(0, 0)) * glm::length(onPlane(0, kHeight) - onPlane(0, 0));
    for (std::size_t i = 0; i < points.size(); ++i) {
        ASSERT_EQ(seen[i].visible, 1u) << i;
        EXPECT_EQ(seen[i].pixel,
                  static_cast<std::uint32_t>(film[i].y) * kWidth + static_cast<std::uint32_t>(film[i].x));
        const Vec3 offset = Vec3(kCamera.position) - Vec3(points[i]);
        const double distance = glm::length(offset);
        EXPECT_NEAR(seen[i].distance, distance, 1e-5 * distance);
        EXPECT_LT(glm::length(Vec3(seen[i].direction) - offset / distance), 2e-5);
        const double cosine = -glm::dot(offset, forward) / distance;
        EXPECT_NEAR(static_cast<double>(seen[i].importance) * area * std::pow(cosine, 3), 1.0, 1e-4);
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
    for (const double x : {0.5, 18.0, 36.5}) {  // what a ray backwards meets
        points.emplace_back(pinhole.ray(x, 7).origin - 2.0 * pinhole.ray(x, 7).direction);
    }
    const std::vector<CameraOutput> seen = connect(points);
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_EQ(seen[i].visible, 0u) << i;
}

/// Light of radiance 1 from everywhere fills every pixel with 1: the importance, which is that of the image
/// as a whole, integrates over the directions of a pixel to one part in the number of pixels.
TEST(CameraConnection, ImportanceOfAPixelIntegratesToItsPart) {
    std::mt19937 engine(4);
    std::normal_distribution<float> normal;
    std::vector<glm::vec3> points(1 << 20);
    for (glm::vec3& p : points) {
        const glm::vec3 d(normal(engine), normal(engine), normal(engine));
        p = kCamera.position + 2.0f * glm::normalize(d);
    }
    const std::vector<CameraOutput> seen = connect(points);
    std::vector<double> sum(kWidth * kHeight), squares(kWidth * kHeight);
    double whole = 0.0;
    for (const CameraOutput& s : seen) {
        const double value =
            s.visible != 0 ? static_cast<double>(s.importance) * 4.0 * std::numbers::pi : 0.0;
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

}  // namespace
}  // namespace duolux::test
