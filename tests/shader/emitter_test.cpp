#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "host/device_scene/emitter_table.h"
#include "host/scene/emitters.h"
#include "tests/shader/density.h"
#include "tests/shader/inputs.h"
#include "tests/shader/mirror_types.h"
#include "tests/shader/no_scene.h"
#include "tests/support/scene_builder.h"
#include "tests/support/statistics.h"

// Points on emitters: the probability of each emitter, the distribution of points on it, and the flux of a
// light path.

namespace duolux::test {
namespace {

using mirror::single::EmitterChoice;
using mirror::single::EmitterPoint;
using reference::Vec3;

/// Emitting triangles with many sizes and radiances, each with its own material, among triangles that do not
/// emit; every third emits on both sides.
Scene randomEmitters(std::size_t count, std::uint32_t seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<float> uniform;
    const auto vector = [&] { return glm::vec3(uniform(engine), uniform(engine), uniform(engine)); };
    SceneBuilder builder;
    const std::uint32_t dark = builder.add({});
    for (std::size_t i = 0; i < count; ++i) {
        Material material;
        const float bright = std::exp2(6.0f * uniform(engine));
        material.emission = {bright * vector(), bright * vector(), i % 3 == 0 ? Sides::kBoth : Sides::kFront};
        const std::uint32_t index = builder.add(material);
        const glm::vec3 corner = 10.0f * vector();
        const float size = std::exp2(4.0f * uniform(engine) - 4.0f);
        builder.triangle(corner, corner + size * vector(), corner + size * vector(), index);
        if (i % 4 == 1) builder.triangle(corner, vector(), vector(), dark);
    }
    return builder.scene;
}

struct Emitter {
    Vec3 v0, v1, v2;
    double area;
    glm::dvec3 power;  ///< W per channel, both components, over the sides that emit
    double chance;     ///< of being chosen, by area and brightness of both components
};

/// In the order of the triangles, in double precision, and independent of the table.
std::vector<Emitter> emittersOf(const Scene& scene) {
    std::vector<Emitter> out;
    double total = 0.0;
    for (std::size_t i = 0; i < scene.geometry.triangles.size(); ++i) {
        const Emission& e = scene.materials[scene.geometry.materials[i]].emission;
        if (!e.any()) continue;
        const auto corner = [&](int k) {
            return Vec3(scene.geometry.positions[scene.geometry.triangles[i][k]]);
        };
        Emitter emitter{corner(0), corner(1), corner(2), 0.0, {}, 0.0};
        emitter.area = 0.5 * glm::length(glm::cross(emitter.v1 - emitter.v0, emitter.v2 - emitter.v0));
        emitter.power = (glm::dvec3(e.invisible) + glm::dvec3(e.visible)) * emitter.area * std::numbers::pi *
                        (e.sides == Sides::kBoth ? 2.0 : 1.0);
        total += emitter.power.x + emitter.power.y + emitter.power.z;
        out.push_back(emitter);
    }
    for (Emitter& e : out)
        e.chance = (e.power.x + e.power.y + e.power.z) / total;
    return out;
}

const char* const kNoScene =
    "uvec4 fetchPlaneTexel(uint index) { return uvec4(0u); }"
    "uvec4 fetchPairTexel(uint index) { return uvec4(0u); }"
    "uvec4 fetchNormalTexel(uint index) { return uvec4(0u); }";

using Records = std::vector<shared::DeviceEmitter>;

ShaderLibrary emitters(const Records& records) {
    ShaderLibrary library("shaders/lib/emitter.glsl");
    library.texels("fetchEmitterTexel", std::span(records));
    library.define(kNoScene).define(kNoVertexRecords).define(kNoEmissionTextures);
    return library;
}

EmitterTable tableOf(const Scene& scene) {
    return buildEmitterTable(scene, listEmitters(scene), true);
}

/// The emitters that the words choose.
std::vector<EmitterChoice> chooseFrom(const Records& records, const std::vector<glm::uvec2>& words) {
    return emitters(records).call<EmitterChoice>("chooseEmitter", static_cast<std::uint32_t>(records.size()),
                                                 words);
}

/// Points on the chosen emitters.
std::vector<EmitterPoint> pointsOn(const Records& records, const std::vector<glm::uvec2>& words) {
    return emitters(records).evaluate<EmitterPoint>(
        "EmitterChoice c = chooseEmitter(x0, x1); result = pointOnEmitter(fetchEmitter(c.index), c.u);",
        static_cast<std::uint32_t>(records.size()), words);
}

constexpr double kAlpha = 1e-4;  // for each family below

// Chi-square over the emitters, with 52 or more points per emitter on average; 4 tests, joint level 1e-4.
TEST(ChooseEmitter, PicksEmittersByPower) {
    for (const std::size_t count : {1u, 2u, 7u, 1000u, 20011u}) {
        const Scene scene = randomEmitters(count, 17);
        const std::vector<Emitter> expectedOf = emittersOf(scene);
        const EmitterTable table = tableOf(scene);
        ASSERT_EQ(table.records.size(), count);
        const auto choices = chooseFrom(table.records, randomWords2(count > 1000 ? 1 << 20 : 1 << 17, 5));
        std::vector<double> observed(count), expected(count);
        for (const EmitterChoice& c : choices) {
            ASSERT_LT(c.index, count);
            observed[c.index] += 1.0;
        }
        for (std::size_t i = 0; i < count; ++i) {
            expected[i] = expectedOf[i].chance * static_cast<double>(choices.size());
            // The density in the record is this probability per unit area.
            EXPECT_NEAR(
                static_cast<double>(table.records[i].density) * expectedOf[i].area / expectedOf[i].chance,
                1.0, 1e-6);
        }
        if (count == 1) continue;  // always chosen
        const ChiSquare test = chiSquare(observed, expected);
        EXPECT_GE(test.p, sidakLevel(kAlpha, 4))
            << count << " emitters: " << test.statistic << " of " << test.degrees << " degrees";
    }
}

// Repeats the choice in 64-bit integers: all 32 bits count. The bits that remain after the choice of a table
// entry decide between the entry and its alias.
TEST(ChooseEmitter, EveryBitDecides) {
    const std::uint32_t count = 20011;
    const Records records = tableOf(randomEmitters(count, 18)).records;
    std::vector<glm::uvec2> us = randomWords2(1 << 18, 6);
    for (std::uint32_t i = 0; i < count; ++i) {
        // The last word that keeps emitter i and the first that does not, or the nearest words that exist.
        const std::uint64_t edge =
            (std::uint64_t{i} << 32) +
            static_cast<std::uint64_t>(static_cast<double>(records[i].threshold) * 0x1p32);
        const auto word = static_cast<std::uint32_t>(std::min<std::uint64_t>(edge / count, 0xffffffffu));
        us.insert(us.end(), {{word, 0u}, {word + 1u, 0u}});
    }
    const auto choices = chooseFrom(records, us);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < us.size(); ++i) {
        const std::uint64_t product = std::uint64_t{us[i].x} * count;
        const std::uint64_t index = product >> 32;
        const std::uint64_t fraction = (product & 0xffffffffu) >> 8;  // in units of 2^-24
        const bool keep =
            static_cast<double>(fraction) < static_cast<double>(records[index].threshold) * 0x1p24;
        kept += keep ? 1 : 0;
        const std::uint64_t picked = keep ? index : records[index].alias;
        ASSERT_EQ(choices[i].index, picked) << us[i].x;
    }
    EXPECT_GT(kept, us.size() / 4);
    EXPECT_LT(kept, us.size() * 7 / 8);
}

/// Emitters on the triangle (0,0), (1,0), (0,1) of the planes z = index, with these entries of the alias
/// table.
Records stackedEmitters(const std::vector<AliasEntry>& table) {
    Records records;
    for (std::uint32_t i = 0; i < table.size(); ++i) {
        const auto z = static_cast<float>(i);
        shared::DeviceEmitter& record = records.emplace_back();
        record.v0 = {0, 0, z};
        record.v1 = {1, 0, z};
        record.v2 = {0, 1, z};
        record.positionError = 0.25f * z;
        record.threshold = table[i].threshold;
        record.alias = table[i].alias;
    }
    return records;
}

// Thresholds 0 and 1, and a word equal to the threshold, which takes the alias.
TEST(ChooseEmitter, ThresholdsByHand) {
    const Records records = stackedEmitters({{0.0f, 3}, {1.0f, 3}, {0.5f, 3}, {1.0f, 3}});
    std::vector<glm::uvec2> us;
    std::vector<std::uint32_t> expected;
    for (const std::uint32_t bits : {0u, 1u, 0x1fffffffu, 0x20000000u, 0x3fffffffu}) {
        for (std::uint32_t i = 0; i < 4; ++i) {
            us.emplace_back(i * 0x40000000u + bits, 0x80000000u);
            expected.push_back(i == 0 || (i == 2 && bits >= 0x20000000u) ? 3 : i);
        }
    }
    const auto choices = chooseFrom(records, us);
    const auto points = pointsOn(records, us);
    for (std::size_t i = 0; i < us.size(); ++i) {
        EXPECT_EQ(choices[i].index, expected[i]) << i;
        EXPECT_EQ(points[i].position.z, static_cast<float>(expected[i])) << i;
        EXPECT_EQ(points[i].positionError, 0.25f * static_cast<float>(expected[i])) << i;
        EXPECT_TRUE(points[i].position.x >= 0.0f && points[i].position.y >= 0.0f &&
                    points[i].position.x + points[i].position.y <= 1.0f)
            << i;
    }
}

// The rest of the first word after the choice is uniform again, whether the emitter was kept or replaced by
// its alias: points have density 2 on the triangle. With s = x + y, (s^2, y / s) is uniform on the unit
// square. Three tests, joint level 1e-4.
TEST(ChooseEmitter, PointsAreUniformOnTheTriangle) {
    const Records records = stackedEmitters({{0.3f, 1}, {1.0f, 0}});
    const std::vector<glm::uvec2> us = randomWords2(1 << 20, 7);
    const auto choices = chooseFrom(records, us);
    const auto samples = pointsOn(records, us);
    std::array<std::vector<glm::dvec2>, 3> points;
    for (std::size_t i = 0; i < us.size(); ++i) {
        const double x = static_cast<double>(samples[i].position.x);
        const double y = static_cast<double>(samples[i].position.y);
        const double s = x + y;
        const std::size_t way = us[i].x >= 0x80000000u ? 0 : choices[i].index == 0 ? 1 : 2;
        points[way].emplace_back(std::min(s * s, 1.0), s > 0.0 ? y / s : 0.0);
    }
    const std::array<const char*, 3> names{"light-always-kept", "light-kept", "light-by-alias"};
    for (std::size_t way = 0; way < 3; ++way)
        expectDensity(
            names[way], points[way], {{0, 0}, {1, 1}}, [](double, double) { return 1.0; },
            sidakLevel(kAlpha, 3));
}

TEST(ChooseEmitter, PointsLieOnTheTriangleWithTheNormalOfItsFront) {
    const Scene scene = randomEmitters(500, 19);
    const std::vector<Emitter> expected = emittersOf(scene);
    const Records records = tableOf(scene).records;
    const std::vector<glm::uvec2> words = randomWords2(20000, 8);
    const auto choices = chooseFrom(records, words);
    const auto points = pointsOn(records, words);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const EmitterPoint& s = points[i];
        const Emitter& e = expected[choices[i].index];
        const Vec3 across = glm::cross(e.v1 - e.v0, e.v2 - e.v0);
        // The normal is on the side from which the corners are counter-clockwise. Thin triangles lose digits.
        const double flat = glm::length(e.v1 - e.v0) * glm::length(e.v2 - e.v0) / glm::length(across);
        ASSERT_LT(glm::length(Vec3(s.normal) - glm::normalize(across)), 1e-6 * flat);
        ASSERT_NEAR(glm::length(Vec3(s.normal)), 1.0, 2e-7);
        const Vec3 p = Vec3(s.position) - e.v0;
        const double error = static_cast<double>(s.positionError);
        ASSERT_LE(std::abs(glm::dot(p, glm::normalize(across))), error);
        // Barycentric coordinates, times twice the area.
        const double b = glm::dot(glm::cross(p, e.v2 - e.v0), glm::normalize(across));
        const double c = glm::dot(glm::cross(e.v1 - e.v0, p), glm::normalize(across));
        const double slack = error * (glm::length(e.v1 - e.v0) + glm::length(e.v2 - e.v0));
        ASSERT_GE(std::min({b, c, 2.0 * e.area - b - c}), -slack);
        ASSERT_EQ(s.positionError, records[choices[i].index].positionError);
    }
}

// Every light path carries the power of the whole scene, in the colours of its emitter: because points are
// sampled by power, the sum of the channels is the same for all light paths, and the mean of each channel is
// its power (Student's test with the sample's variance; 3 tests, level 1e-4).
TEST(EmittedFlux, AddsUpToThePowerOfTheEmitters) {
    const Scene scene = randomEmitters(300, 20);
    glm::dvec3 power(0.0);
    for (const Emitter& e : emittersOf(scene))
        power += e.power;
    const Records records = tableOf(scene).records;
    const auto samples = chooseFrom(records, randomWords2(1 << 18, 9));
    std::vector<float> density, sides;
    for (const EmitterChoice& c : samples) {
        density.push_back(records[c.index].density);
        sides.push_back((records[c.index].flags & shared::kEmitterBack) != 0 ? 2.0f : 1.0f);
    }
    const auto flux = emitters(records).call<float>("emittedFlux", density, sides);
    glm::dvec3 sum(0.0), squares(0.0);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Emission& e = scene.materials[samples[i].index + 1].emission;
        const glm::dvec3 carried =
            (glm::dvec3(e.invisible) + glm::dvec3(e.visible)) * static_cast<double>(flux[i]);
        ASSERT_NEAR((carried.x + carried.y + carried.z) / (power.x + power.y + power.z), 1.0, 1e-6);
        sum += carried;
        squares += carried * carried;
    }
    const auto n = static_cast<double>(samples.size());
    for (int c = 0; c < 3; ++c) {
        const double mean = sum[c] / n;
        const double error = std::sqrt((squares[c] / n - mean * mean) / n);
        EXPECT_GE(studentTwoSided((mean - power[c]) / error, n - 1.0), sidakLevel(kAlpha, 3)) << c;
    }
}

// The density per steradian of uniform points on a triangle integrates to 1 over the directions in which the
// triangle is seen. Directions are points of a plane at distance 1 (where dw = cos^3 dA), onto which the
// triangle is projected; distance and cosine are those where the ray meets the triangle's plane.
TEST(PdfAreaToSolidAngle, IntegratesToOneOverDirections) {
    std::mt19937 engine(21);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const ShaderLibrary library = emitters(stackedEmitters({{1.0f, 0}}));
    for (int t = 0; t < 20; ++t) {
        // Seen from the origin, at distances from 1.1 along -z, of either winding, also obliquely.
        std::array<Vec3, 3> v;
        for (Vec3& p : v)
            p = Vec3(uniform(engine), uniform(engine), -2.0 - 0.9 * uniform(engine));
        const Vec3 across = glm::cross(v[1] - v[0], v[2] - v[0]);
        const Vec3 normal = glm::normalize(across);
        std::array<glm::dvec2, 3> seen;
        for (std::size_t k = 0; k < 3; ++k)
            seen[k] = glm::dvec2(v[k]) / -v[k].z;
        const glm::dvec2 e1 = seen[1] - seen[0], e2 = seen[2] - seen[0];
        const double jacobian = std::abs(e1.x * e2.y - e1.y * e2.x);
        // The first integrate() collects the points; the second uses the device's results in the same order.
        std::vector<float> squared, cosine;
        std::vector<double> weight;
        const Rectangle square{{0.0, 0.0}, {1.0, 1.0}};
        integrate(
            [&](double x, double y) {
                // Maps the square to the triangle.
                const glm::dvec2 at = seen[0] + x * e1 + y * (1.0 - x) * e2;
                const Vec3 direction = glm::normalize(Vec3(at, -1.0));
                const double distance = glm::dot(v[0], normal) / glm::dot(direction, normal);
                squared.push_back(static_cast<float>(distance * distance));
                cosine.push_back(static_cast<float>(glm::dot(direction, normal)));
                weight.push_back((1.0 - x) * jacobian * std::pow(-direction.z, 3.0));
                return 0.0;
            },
            square, 16);
        const auto density = static_cast<float>(2.0 / glm::length(across));
        const auto pdf = library.call<float>("pdfAreaToSolidAngle", density, squared, cosine);
        std::size_t next = 0;
        const double integral = integrate(
            [&](double, double) {
                const std::size_t i = next++;
                return weight[i] * static_cast<double>(pdf[i]);
            },
            square, 16);
        EXPECT_NEAR(integral, 1.0, 1e-6) << t;
    }
}

TEST(EmitterOracles, Densities) {
    std::mt19937 engine(22);
    std::uniform_real_distribution<float> uniform(-30.0f, 30.0f);
    std::vector<float> a, b, cosine, sides;
    for (int i = 0; i < 4096; ++i) {
        a.push_back(i % 16 == 0 ? 0.0f : std::exp2(uniform(engine)));
        b.push_back(i % 16 <= 1 ? 0.0f : std::exp2(uniform(engine)));
        cosine.push_back(i % 16 == 0 ? 0.0f : uniform(engine) / 30.0f);
        sides.push_back(i % 2 == 0 ? 1.0f : 2.0f);
    }
    const ShaderLibrary library = emitters(stackedEmitters({{1.0f, 0}}));
    EXPECT_ORACLES(library, balanceHeuristic, (Budget{4, 0}), a, b);
    EXPECT_ORACLES(library, pdfAreaToSolidAngle, (Budget{4, 0}), a, b, cosine);
    std::vector<float> positive = a;
    for (float& x : positive)
        x = std::max(x, 1e-9f);
    EXPECT_ORACLES(library, emittedFlux, (Budget{4, 0}), positive, sides);
}

TEST(EmitterOracles, Samples) {
    const Records records = tableOf(randomEmitters(500, 23)).records;
    mirror::texels().emitters.resize(records.size() * shared::kEmitterTexels);
    std::memcpy(mirror::texels().emitters.data(), records.data(), std::as_bytes(std::span(records)).size());
    const ShaderLibrary library = emitters(records);
    std::vector<std::uint32_t> indices(500);
    for (std::uint32_t i = 0; i < 500; ++i)
        indices[i] = i;
    EXPECT_ORACLES(library, fetchEmitter, (Budget{0, 0}), indices);
    EXPECT_ORACLES(library, fetchAliasEntry, (Budget{0, 0}), indices);
    // The choice is exact on the device and in both oracles, because it uses only a word and one product. The
    // remainder of a random number within a small threshold loses digits.
    std::vector<std::uint32_t> counts(20000, 500u);
    EXPECT_ORACLES(library, chooseEmitter, (Budget{2, 4e-6}), counts, randomWords2(20000, 10));
}

}  // namespace
}  // namespace duolux::test
