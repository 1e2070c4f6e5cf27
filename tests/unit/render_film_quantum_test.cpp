#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/render/film_quantum.h"

namespace duolux {
namespace {

/// A first look at an image with these means, by a film that clamps at 2^58 quanta and drops values below one
/// quantum.
struct Picture {
    double invisible, visible;
    int looks = 0;

    float quantum(double brightest) {
        return findQuantum(brightest, [&](float quantum) {
            ++looks;
            const auto quanta = [&](double mean) {
                return std::floor(4096.0 * mean / static_cast<double>(quantum));
            };
            const bool clamped = std::max(invisible, visible) / static_cast<double>(quantum) > 0x1p58;
            return FirstLook{quanta(invisible), quanta(visible), 4096, clamped};
        });
    }
};

TEST(FilmQuantum, IsA2ToTheMinus30thOfThePicturesMean) {
    for (const double mean : {1e-20, 1e-6, 0.3, 7.0, 1e12}) {
        Picture picture{mean, mean};
        const double quantum = static_cast<double>(picture.quantum(mean));
        int exponent = 0;
        EXPECT_EQ(std::frexp(quantum, &exponent), 0.5) << "a power of two";
        EXPECT_LE(quantum, mean * 0x1p-30);
        EXPECT_GT(quantum, mean * 0x1p-31);
        EXPECT_EQ(picture.looks, 1);
    }
}

// A bright emitter out of sight, or surfaces that multiply light.
TEST(FilmQuantum, FollowsThePictureAndNotItsEmitters) {
    for (const double ratio : {1e-20, 1e-12, 1e-6, 1e6, 1e12, 1e18}) {
        Picture picture{0.0, ratio * 5.0};
        const double quantum = static_cast<double>(picture.quantum(5.0));
        EXPECT_LE(quantum, ratio * 5.0 * 0x1p-20) << ratio;
        EXPECT_GT(quantum, ratio * 5.0 * 0x1p-31) << ratio;
        EXPECT_LE(picture.looks, 3);
    }
}

// The film holds the brightest emission up to 2^38 times the mean, even if the first look misses it.
TEST(FilmQuantum, LeavesRoomForTheBrightestEmission) {
    for (const double brightest : {1.0, 1e6, 1e9, 1e11}) {
        Picture picture{1.0, 1.0};
        EXPECT_GE(static_cast<double>(picture.quantum(brightest)) * 0x1p58, brightest);
    }
}

TEST(FilmQuantum, IsThatOfTheDarkerComponentWithinLimits) {
    EXPECT_EQ((Picture{1.0, 0x1p-10}.quantum(1.0)), 0x1p-40f);
    EXPECT_EQ((Picture{0x1p-10, 1.0}.quantum(1.0)), 0x1p-40f);
    EXPECT_EQ((Picture{1.0, 0x1p-40}.quantum(1.0)), 0x1p-43f);
    EXPECT_EQ((Picture{1.0, 0.0}.quantum(1.0)), 0x1p-30f);
}

TEST(FilmQuantum, OfABlackPictureIsThatOfItsEmitters) {
    EXPECT_EQ((Picture{0.0, 0.0}.quantum(4.0)), 0x1p-28f);
    EXPECT_GT((Picture{0.0, 0.0}.quantum(0.0)), 0.0f);
}

}  // namespace
}  // namespace duolux
