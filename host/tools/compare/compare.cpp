#include "host/tools/compare/compare.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "host/base/srgb.h"
#include "host/tools/compare/flip.h"

namespace duolux {

namespace {

std::vector<glm::vec3> displayedImage(const RadianceImage& image, const CompareOptions& options,
                                      Transfer transfer) {
    std::vector<glm::vec3> pixels = image.displayed(options.display);
    const double scale = std::exp2(static_cast<double>(options.exposure));
    for (glm::vec3& pixel : pixels) {
        for (int c = 0; c < 3; ++c) {
            const double value = std::clamp(scale * static_cast<double>(pixel[c]), 0.0, 1.0);
            pixel[c] = static_cast<float>(transfer == Transfer::kSrgb ? srgbEncode(value) : value);
        }
    }
    return pixels;
}

double epsOf(glm::dvec3 difference) {
    return std::sqrt(glm::dot(difference, difference) / 3.0);
}

double sum(glm::dvec3 v) {
    return v.x + v.y + v.z;
}

}  // namespace

const char* nameOf(Transfer transfer) {
    switch (transfer) {
        case Transfer::kSrgb:
            return "srgb";
        case Transfer::kLinear:
            return "linear";
    }
    return "";
}

std::vector<std::pair<std::string_view, double>> Comparison::metrics() const {
    return {{"eps_mean", epsMean},
            {"eps_max", epsMax},
            {"eps_above_1_255", epsAboveOneCode},
            {"average_colour", averageColour},
            {"signed_mean", signedMean},
            {"rmse", rmse},
            {"relative_mse", relativeMse},
            {"psnr", psnr},
            {"flip", flip}};
}

std::vector<float> epsMap(const RadianceImage& image, const RadianceImage& reference,
                          const CompareOptions& options) {
    const std::vector<glm::vec3> a = displayedImage(image, options, options.transfer);
    const std::vector<glm::vec3> b = displayedImage(reference, options, options.transfer);
    std::vector<float> result(a.size());
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = static_cast<float>(epsOf(glm::dvec3(a[i]) - glm::dvec3(b[i])));
    return result;
}

Comparison compare(const RadianceImage& image, const RadianceImage& reference,
                   const CompareOptions& options) {
    assert(image.width == reference.width && image.height == reference.height);
    const std::vector<glm::vec3> linear = image.displayed(options.display);
    const std::vector<glm::vec3> linearReference = reference.displayed(options.display);
    const std::vector<glm::vec3> shown = displayedImage(image, options, options.transfer);
    const std::vector<glm::vec3> shownReference = displayedImage(reference, options, options.transfer);
    const std::vector<float> seen =
        flip(displayedImage(image, options, Transfer::kSrgb),
             displayedImage(reference, options, Transfer::kSrgb), image.width, image.height);

    Comparison result;
    glm::dvec3 colour(0.0);
    double shownSquares = 0.0;
    for (std::size_t i = 0; i < linear.size(); ++i) {
        if (!options.mask.empty() && !options.mask[i]) continue;
        ++result.pixels;
        if (!glm::all(glm::equal(linear[i] * 0.0f + linearReference[i] * 0.0f, glm::vec3(0.0f))))
            ++result.nonFinite;
        const glm::dvec3 shownDifference = glm::dvec3(shown[i]) - glm::dvec3(shownReference[i]);
        const double eps = epsOf(shownDifference);
        result.epsMean += eps;
        result.epsMax = std::max(result.epsMax, eps);
        result.epsAboveOneCode += eps > 1.0 / 255.0 ? 1.0 : 0.0;
        colour += shownDifference;
        shownSquares += eps * eps;
        const glm::dvec3 r(linearReference[i]);
        const glm::dvec3 difference = glm::dvec3(linear[i]) - r;
        const glm::dvec3 squares = difference * difference;
        result.signedMean += sum(difference) / 3.0;
        result.rmse += sum(squares) / 3.0;
        result.relativeMse += sum(squares / (r * r + 0.01)) / 3.0;
        result.flip += static_cast<double>(seen[i]);
    }
    assert(result.pixels > 0);
    if (result.nonFinite > 0) {
        constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
        const std::uint64_t pixels = result.pixels;
        return {pixels, result.nonFinite, kNaN, kNaN, kNaN, kNaN, kNaN, kNaN, kNaN, kNaN, kNaN};
    }
    const auto n = static_cast<double>(result.pixels);
    for (double* mean : {&result.epsMean, &result.epsAboveOneCode, &result.signedMean, &result.rmse,
                         &result.relativeMse, &result.flip, &shownSquares})
        *mean /= n;
    result.rmse = std::sqrt(result.rmse);
    result.averageColour = epsOf(colour / n);
    result.psnr =
        shownSquares > 0.0 ? -10.0 * std::log10(shownSquares) : std::numeric_limits<double>::infinity();
    return result;
}

}  // namespace duolux
