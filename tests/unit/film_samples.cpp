#include "tests/unit/film_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <random>

namespace duolux::test {

RadianceImage variedImage(std::uint32_t width, std::uint32_t height) {
    std::mt19937 random(width * 31 + height);
    std::uniform_real_distribution<float> mantissa(-1.0f, 1.0f);
    std::uniform_int_distribution<int> exponent(-40, 40);
    const auto value = [&] { return std::ldexp(mantissa(random), exponent(random)); };
    RadianceImage image{width, height, {}, {}};
    for (std::size_t i = 0; i < std::size_t{width} * height; ++i) {
        image.invisible.emplace_back(value(), value(), value());
        image.visible.emplace_back(value(), value(), value());
    }
    return image;
}

RadianceImage plainImage(std::uint32_t width, std::uint32_t height, glm::vec3 colour) {
    const std::size_t count = std::size_t{width} * height;
    return {width, height, std::vector<glm::vec3>(count, glm::vec3(0.0f)),
            std::vector<glm::vec3>(count, colour)};
}

bool sameBits(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(glm::vec3)) == 0;
}

std::string encoded(Encode* encode, const RadianceImage& image, const ImageOptions& options) {
    const TemporaryFolder folder;
    writeFileAtomically(folder / "image", [&](FileWriter& file) { encode(rowsOf(image), options, file); });
    return readFile(folder / "image");
}

void writeText(const std::filesystem::path& path, std::string_view bytes) {
    std::ofstream out(path, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    ASSERT_TRUE(out.flush());
}

}  // namespace duolux::test
