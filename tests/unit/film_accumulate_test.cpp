#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <numeric>
#include <random>

#include "host/film/film.h"

namespace duolux {
namespace {

constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();

TEST(Film, RowsAreThoseOfTheImage) {
    Film film(3, 40, 0.25f);
    for (std::uint32_t pixel = 0; pixel < 120; ++pixel) {
        const Film::PixelSum sum{{pixel, 2 * pixel, 3}, {5 * pixel, 7, pixel}};
        film.add(std::span(&pixel, 1), std::span(&sum, 1), pixel % 4);
    }
    const RadianceImage image = film.resolve();
    std::vector<glm::vec3> invisible(2 * 3), visible(2 * 3);
    for (std::uint32_t y = 0; y < 40; y += 2) {
        film.rows().read(y, invisible, visible);
        for (std::size_t i = 0; i < 6; ++i) {
            EXPECT_EQ(invisible[i], image.invisible[3 * y + i]);
            EXPECT_EQ(visible[i], image.visible[3 * y + i]);
        }
    }
}

TEST(Film, IsBlackBeforeAnySample) {
    const Film film(3, 2, 0.25f);
    const RadianceImage image = film.resolve();
    EXPECT_EQ(image.width, 3u);
    EXPECT_EQ(image.height, 2u);
    ASSERT_EQ(image.visible.size(), 6u);
    for (int i = 0; i < 6; ++i) {
        EXPECT_EQ(image.visible[i], glm::vec3(0.0f));
        EXPECT_EQ(image.invisible[i], glm::vec3(0.0f));
    }
    EXPECT_EQ(film.totalSamples(), 0u);
}

TEST(Film, ResolvesToTheMeanOfEachPixel) {
    Film film(2, 1, 0.25f);
    const std::uint32_t both[] = {0, 1};
    const Film::PixelSum sums[] = {{{4, 8, -12}, {1, 2, 3}}, {{0, 0, 0}, {400, 0, 0}}};
    film.add(both, sums, 2);
    const std::uint32_t second[] = {1};
    const Film::PixelSum more[] = {{{0, 0, 0}, {200, 0, 0}}};
    film.add(second, more, 4);
    const RadianceImage image = film.resolve();
    EXPECT_EQ(image.invisible[0], glm::vec3(0.5f, 1.0f, -1.5f));
    EXPECT_EQ(image.visible[0], glm::vec3(0.125f, 0.25f, 0.375f));
    EXPECT_EQ(image.visible[1], glm::vec3(600.0f * 0.25f / 6.0f, 0.0f, 0.0f));
    EXPECT_EQ(film.samplesOf(0), 2u);
    EXPECT_EQ(film.samplesOf(1), 6u);
    EXPECT_EQ(film.totalSamples(), 8u);
    EXPECT_FALSE(film.overflowed());
}

TEST(Film, LightPathsAreCountedByTheImageAndKeptApart) {
    Film film(2, 1, 0.5f);
    const Film::PixelSum light[] = {{{8, 0, 4}, {16, 2, 0}}, {{0, 0, 0}, {6, 0, 0}}};
    film.addLightPathSums(0, std::span(light).first(1));
    film.addLightPathSums(1, std::span(light).last(1));
    film.countLightPaths(8);
    EXPECT_EQ(film.lightPaths(), 8u);
    EXPECT_EQ(film.totalSamples(), 0u);
    // 8 paths are 4 per pixel.
    const RadianceImage image = film.resolve();
    EXPECT_EQ(image.invisible[0], glm::vec3(1.0f, 0.0f, 0.5f));
    EXPECT_EQ(image.visible[0], glm::vec3(2.0f, 0.25f, 0.0f));
    EXPECT_EQ(image.visible[1], glm::vec3(0.75f, 0.0f, 0.0f));

    // Pixel samples and light paths have separate means, which are added.
    const std::uint32_t both[] = {0, 1};
    const Film::PixelSum gathered[] = {{{2, 0, 0}, {4, 0, 0}}, {{0, 0, 0}, {0, 0, 0}}};
    film.add(both, gathered, 2);
    EXPECT_EQ(film.resolve().invisible[0], glm::vec3(1.5f, 0.0f, 0.5f));
    EXPECT_EQ(film.resolve().visible[1], glm::vec3(0.75f, 0.0f, 0.0f));

    Film twice = film;
    twice.add(film);
    EXPECT_EQ(twice.lightPaths(), 16u);
    EXPECT_EQ(twice.totalSamples(), 8u);
    EXPECT_EQ(twice.resolve().visible, film.resolve().visible);

    // A sum whose sign changed on the device.
    Film passed(2, 1, 0.5f);
    const Film::PixelSum beyond[] = {{{0, 0, 0}, {0, kMin, 0}}, {{0, 0, 0}, {0, 1, 0}}};
    passed.addLightPathSums(0, beyond);
    EXPECT_TRUE(passed.overflowed());
    EXPECT_EQ(passed.lightPathSums()[0].visible[1], kMax);
    EXPECT_EQ(passed.lightPathSums()[1].visible[1], 1);
}

TEST(Film, HoldsSumsBeyond64Bits) {
    const std::uint32_t pixel[] = {0};
    const Film::PixelSum most[] = {{{kMax, 5, 0}, {0, kMin, 0}}};
    Film film(1, 1, 0x1p-30f);
    for (int i = 0; i < 1000; ++i)
        film.add(pixel, most, 32);
    EXPECT_EQ(film.carries().size(), 2u);
    const RadianceImage image = film.resolve();
    EXPECT_FLOAT_EQ(image.invisible[0].x, 0x1p28f);
    EXPECT_FLOAT_EQ(image.visible[0].y, -0x1p28f);
    EXPECT_FLOAT_EQ(image.invisible[0].y, 5.0f / 32.0f * 0x1p-30f);
    EXPECT_FALSE(film.overflowed());

    // Two halves give the same; then everything is subtracted again.
    Film half(1, 1, 0x1p-30f);
    for (int i = 0; i < 500; ++i)
        half.add(pixel, most, 32);
    half.add(Film(half));
    EXPECT_EQ(half.sums()[0].invisible[0], film.sums()[0].invisible[0]);
    EXPECT_EQ(half.carries(), film.carries());
    const Film::PixelSum least[] = {{{-kMax, -5, 0}, {0, kMax, 0}}};
    for (int i = 0; i < 1000; ++i)
        film.add(pixel, least, 1);
    EXPECT_TRUE(film.carries().empty());
    EXPECT_EQ(film.sums()[0].invisible[0], 0);
    EXPECT_EQ(film.sums()[0].visible[1], -1000);

    Film light(1, 1, 0x1p-30f);
    const Film::PixelSum bright[] = {{{0, 0, 0}, {kMax, 0, 0}}};
    for (int i = 0; i < 100; ++i)
        light.addLightPathSums(0, bright);
    light.countLightPaths(6400);
    EXPECT_FALSE(light.overflowed());
    EXPECT_FLOAT_EQ(light.resolve().visible[0].x, 0x1p27f);
}

// The limit is 2^58 quanta with either integrator, for any number of samples.
TEST(Film, ClampsAtTheLargestRadianceAndTells) {
    const std::uint32_t pixel[] = {0};
    constexpr std::int64_t kLargest = std::int64_t{1} << 58;
    for (const float quantum : {0x1p-30f, 1.0f}) {
        const float largest = 0x1p58f * quantum;
        for (const std::uint32_t samples : {1u, 1u << 24}) {
            for (const std::int64_t excess : {std::int64_t{0}, kLargest >> 20}) {
                const Film::PixelSum sum[] = {{{0, 0, 0}, {0, kLargest + excess, 0}}};
                Film gathered(1, 1, quantum), shot(1, 1, quantum);
                EXPECT_EQ(gathered.largestRadiance(), static_cast<double>(largest));
                for (std::uint32_t i = 0; i < 16; ++i) {
                    gathered.add(pixel, sum, 1);
                    shot.addLightPathSums(0, sum);
                }
                shot.countLightPaths(16);
                for (std::uint32_t doubled = 16; doubled < samples; doubled *= 2) {
                    gathered.add(Film(gathered));
                    shot.add(Film(shot));
                }
                for (const Film* film : {&gathered, &shot}) {
                    EXPECT_EQ(film->overflowed(), excess > 0);
                    EXPECT_EQ(film->resolve().visible[0].y, largest);
                }
            }
        }
    }
}

TEST(Film, OfAnotherQuantumIsAddedExactly) {
    const std::uint32_t both[] = {0, 1};
    Film coarse(2, 1, 0x1p-20f), fine(2, 1, 0x1p-23f);
    const Film::PixelSum a[] = {{{kMax, 1, 2}, {3, -4, 5}}, {{0, kMin, 0}, {7, 0, 0}}};
    const Film::PixelSum b[] = {{{1, 10, 20}, {30, 40, 50}}, {{60, 70, 80}, {90, 100, 110}}};
    coarse.add(both, a, 1);
    fine.add(both, b, 1);
    fine.addLightPathSums(0, b);
    fine.countLightPaths(2);
    Film sum = coarse, other = fine;
    sum.add(fine);
    other.add(coarse);
    EXPECT_EQ(sum.quantum(), 0x1p-23f);
    EXPECT_EQ(other.quantum(), 0x1p-23f);
    EXPECT_EQ(sum.carries(), other.carries());
    EXPECT_EQ(sum.resolve().invisible, other.resolve().invisible);
    EXPECT_EQ(sum.resolve().visible, other.resolve().visible);
    EXPECT_EQ(sum.sums()[0].invisible[1], 18);
    EXPECT_EQ(sum.sums()[0].visible[1], 8);
    EXPECT_EQ(sum.lightPathSums()[1].visible[2], 110);
    // 8 (2^63 - 1) + 1 = 2^66 - 7
    EXPECT_EQ(sum.sums()[0].invisible[0], -7);
    EXPECT_EQ(sum.carries().at(0), 4);
}

TEST(Film, IsTheSameBitsInWhateverOrderPartsAreAdded) {
    constexpr std::uint32_t kPixels = 16;
    constexpr int kParts = 64;
    std::mt19937_64 random(1);
    std::vector<std::vector<Film::PixelSum>> parts(kParts, std::vector<Film::PixelSum>(kPixels));
    for (auto& part : parts) {
        for (Film::PixelSum& sum : part) {
            for (int c = 0; c < 3; ++c) {
                sum.invisible[c] = static_cast<std::int64_t>(random());
                sum.visible[c] = static_cast<std::int64_t>(random()) / (2 * kParts);
            }
        }
    }
    std::vector<std::uint32_t> pixels(kPixels);
    std::iota(pixels.begin(), pixels.end(), 0u);

    Film forward(kPixels, 1, 0x1p-20f);
    for (const auto& part : parts)
        forward.add(pixels, part, 3);

    // A different order of parts and of pixels, with every part in two pieces.
    Film shuffled(kPixels, 1, 0x1p-20f);
    std::ranges::shuffle(parts, random);
    for (const auto& part : parts) {
        std::vector<std::uint32_t> order = pixels;
        std::ranges::shuffle(order, random);
        std::vector<Film::PixelSum> sums;
        for (std::uint32_t pixel : order)
            sums.push_back(part[pixel]);
        const std::span<const std::uint32_t> orderSpan(order);
        const std::span<const Film::PixelSum> sumSpan(sums);
        shuffled.add(orderSpan.subspan(5), sumSpan.subspan(5), 3);
        shuffled.add(orderSpan.first(5), sumSpan.first(5), 3);
    }

    EXPECT_FALSE(forward.carries().empty());
    EXPECT_EQ(forward.carries(), shuffled.carries());
    EXPECT_EQ(forward.totalSamples(), shuffled.totalSamples());
    for (std::uint32_t i = 0; i < kPixels; ++i) {
        for (int c = 0; c < 3; ++c) {
            EXPECT_EQ(forward.sums()[i].invisible[c], shuffled.sums()[i].invisible[c]);
            EXPECT_EQ(forward.sums()[i].visible[c], shuffled.sums()[i].visible[c]);
        }
    }
    EXPECT_EQ(forward.resolve().visible, shuffled.resolve().visible);
    EXPECT_EQ(forward.resolve().invisible, shuffled.resolve().invisible);
}

/// The resident memory of this process in bytes.
std::size_t residentBytes() {
    std::size_t all = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> all >> resident;
    return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

TEST(Film, TakesMemoryOnlyAsItIsFilled) {
    const std::size_t before = residentBytes();
    Film film(8192, 4096, 0x1p-20f);
    EXPECT_LT(residentBytes() - before, 64u << 20) << "of 1.6 GiB";
    const std::array<std::uint32_t, 1> pixel{8192u * 4095u};
    film.add(pixel, std::array{Film::PixelSum{{1, 2, 3}, {4, 5, 6}}}, 2);
    EXPECT_EQ(film.samplesOf(pixel[0]), 2u);
    EXPECT_EQ(film.samplesOf(pixel[0] + 1), 0u);
    EXPECT_EQ(film.sums()[pixel[0]].visible[2], 6);
    EXPECT_EQ(film.sums()[pixel[0] - 1].visible[2], 0);
}

}  // namespace
}  // namespace duolux
