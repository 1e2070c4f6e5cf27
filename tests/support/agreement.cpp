#include "tests/support/agreement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "tests/support/statistics.h"

namespace duolux::test {

namespace {

constexpr const char* kComponent[2] = {"invisible", "visible"};
/// A pixel has few distinct values, so a few renders may agree by chance, which leaves no variance for a
/// test.
constexpr std::size_t kEnoughForPixels = 10;
constexpr char kChannel[3] = {'r', 'g', 'b'};

/// Pixels [x0, x1) x [y0, y1).
struct Block {
    std::uint32_t x0, y0, x1, y1;
};

struct RenderedMean {
    Mean mean;
    std::size_t reached = 0;  ///< renders in which it is not 0
};

/// Mean over the renders of one component and channel of a block.
RenderedMean meanOver(std::span<const RadianceImage> renders, int component, const Block& block,
                      int channel) {
    const auto count = static_cast<double>(renders.size());
    const double pixels = static_cast<double>(block.x1 - block.x0) * (block.y1 - block.y0);
    std::vector<double> values;
    std::size_t reached = 0;
    double sum = 0.0;
    for (const RadianceImage& image : renders) {
        const std::vector<glm::vec3>& radiance = component == 0 ? image.invisible : image.visible;
        double total = 0.0;
        for (std::uint32_t y = block.y0; y < block.y1; ++y) {
            for (std::uint32_t x = block.x0; x < block.x1; ++x)
                total += static_cast<double>(radiance[std::size_t{y} * image.width + x][channel]);
        }
        values.push_back(total / pixels);
        sum += values.back();
        reached += values.back() != 0.0 ? 1 : 0;
    }
    const double mean = sum / count;
    double squares = 0.0;
    for (double value : values)
        squares += (value - mean) * (value - mean);
    return {{mean, squares / (count * (count - 1.0)), count - 1.0}, reached};
}

/// Mean over pixels of independent means, with Satterthwaite's degrees of freedom.
class BlockMean {
  public:
    void add(const Mean& m) {
        value_ += m.value;
        variance_ += m.variance;
        spread_ += m.variance * m.variance / m.degrees;
        ++count_;
    }
    Mean mean() const {
        const double degrees = spread_ > 0.0 ? variance_ * variance_ / spread_ : 1.0;
        return {value_ / count_, variance_ / (count_ * count_), degrees};
    }

  private:
    double value_ = 0.0, variance_ = 0.0, spread_ = 0.0, count_ = 0.0;
};

struct Values {
    std::uint32_t width, height;
    std::vector<Mean> rendered, expected;  ///< per pixel, component and channel
    double varianceToMean[2][3] = {};      ///< of the rendered pixels, over the image

    static std::size_t at(std::size_t pixel, int component, int channel) {
        return pixel * 6 + static_cast<std::size_t>(component * 3 + channel);
    }
};

/// A block that few light paths reach shows too little variance or none. Its variance is assumed to be at
/// least its expected value times the image's ratio of variance to mean.
Mean withVarianceOfImage(RenderedMean rendered, double expected, double varianceToMean) {
    if (rendered.reached < kEnoughForPixels)
        rendered.mean.variance = std::max(rendered.mean.variance, expected * varianceToMean);
    return rendered.mean;
}

Values collect(std::span<const RadianceImage> renders, const reference::Estimates& expected,
               const Criterion& criterion) {
    Values values{expected.width, expected.height, {}, {}};
    const double degrees = std::max(1.0, expected.samples - 1.0);
    std::vector<RenderedMean> rendered;
    double means[2][3] = {};
    for (std::uint32_t pixel = 0; pixel < expected.pixels.size(); ++pixel) {
        const reference::Estimate& e = expected.pixels[pixel];
        const std::uint32_t x = pixel % expected.width, y = pixel / expected.width;
        for (int component = 0; component < 2; ++component) {
            for (int channel = 0; channel < 3; ++channel) {
                rendered.push_back(meanOver(renders, component, {x, y, x + 1, y + 1}, channel));
                values.varianceToMean[component][channel] += rendered.back().mean.variance;
                means[component][channel] += rendered.back().mean.value;
                values.expected.push_back(
                    {e.mean[component][channel], e.variance[component][channel], degrees});
            }
        }
    }
    for (int component = 0; component < 2; ++component) {
        for (int channel = 0; channel < 3; ++channel)
            values.varianceToMean[component][channel] /= std::max(means[component][channel], 1e-30);
    }
    for (std::size_t i = 0; i < rendered.size(); ++i) {
        const double ratio = values.varianceToMean[i % 6 / 3][i % 3];
        values.rendered.push_back(criterion.lightPaths
                                      ? withVarianceOfImage(rendered[i], values.expected[i].value, ratio)
                                      : rendered[i].mean);
    }
    return values;
}

/// Tests all blocks with `size` pixels a side, and stores the statistics in `z` if blocks are pixels.
void judgeScale(const Values& values, std::span<const RadianceImage> renders, std::uint32_t size,
                double alpha, const Criterion& criterion, Agreement& agreement) {
    const std::uint32_t across = (values.width + size - 1) / size, down = (values.height + size - 1) / size;
    const double level = sidakLevel(alpha, std::size_t{across} * down * 6);
    Welch worst;
    std::string worstWhere;
    std::size_t failed = 0;
    for (std::uint32_t block = 0; block < across * down; ++block) {
        const std::uint32_t x0 = block % across * size, y0 = block / across * size;
        const Block pixels{x0, y0, std::min(x0 + size, values.width), std::min(y0 + size, values.height)};
        for (int component = 0; component < 2; ++component) {
            for (int channel = 0; channel < 3; ++channel) {
                BlockMean rendered, expected;
                for (std::uint32_t y = pixels.y0; y < pixels.y1; ++y) {
                    for (std::uint32_t x = pixels.x0; x < pixels.x1; ++x) {
                        const std::size_t i =
                            Values::at(std::size_t{y} * values.width + x, component, channel);
                        rendered.add(values.rendered[i]);
                        expected.add(values.expected[i]);
                    }
                }
                const Mean b = expected.mean();
                Mean a;
                if (!criterion.lightPaths || size == 1) {
                    a = rendered.mean();
                } else {
                    const double count = static_cast<double>(pixels.x1 - pixels.x0) * (pixels.y1 - pixels.y0);
                    a = withVarianceOfImage(meanOver(renders, component, pixels, channel), b.value,
                                            values.varianceToMean[component][channel] / count);
                }
                const Welch test = welch(a, b, criterion.absolute + criterion.relative * std::abs(b.value));
                if (size == 1) {
                    auto& map = component == 0 ? agreement.z.invisible : agreement.z.visible;
                    map[block][channel] = static_cast<float>(std::clamp(test.t, -1e6, 1e6));
                }
                if (test.p < level) ++failed;
                if (!worstWhere.empty() && test.p >= worst.p) continue;
                worst = test;
                worstWhere = fmt::format(
                    "{} {} at ({}, {}): {:.6g} +- {:.2g}, expected {:.6g} +- {:.2g}, t = {:.2f}, p = {:.2g}",
                    kComponent[component], kChannel[channel], x0, y0, a.value, std::sqrt(a.variance), b.value,
                    std::sqrt(b.variance), test.t, test.p);
            }
        }
    }
    if (failed > 0) agreement.agrees = false;
    agreement.report +=
        fmt::format("{}{}x{} blocks of {} pixels: {} beyond level {:.2g}; worst {}\n",
                    failed > 0 ? "FAILED " : "", across, down, size, failed, level, worstWhere);
}

/// Tests whether the pixels of each component and channel scatter about the expectation as their variances
/// predict. The mean square of t is n/(n-2) for n degrees of freedom. A widespread bias of either sign raises
/// it, even if the bias is below a standard error and no single pixel stands out. Allows 6 standard
/// deviations, which needs no table, and 10 % for estimators that are not exactly normal.
void judgeScatter(const Values& values, const Criterion& criterion, Agreement& agreement) {
    double worst = 0.0;
    std::string worstWhere = "none";
    for (int component = 0; component < 2; ++component) {
        for (int channel = 0; channel < 3; ++channel) {
            double count = 0.0, excess = 0.0, variance = 0.0;
            for (std::size_t pixel = 0; pixel < std::size_t{values.width} * values.height; ++pixel) {
                const std::size_t i = Values::at(pixel, component, channel);
                const Mean &a = values.rendered[i], &b = values.expected[i];
                const Welch test = welch(a, b, criterion.absolute + criterion.relative * std::abs(b.value));
                const double n = test.degrees;
                if (test.t == 0.0 || n <= 8.0) continue;
                ++count;
                excess += test.t * test.t - n / (n - 2.0);
                variance += 2.0 * n * n * (n - 1.0) / ((n - 2.0) * (n - 2.0) * (n - 4.0));
            }
            if (count == 0.0) continue;
            const double ratio = excess / (6.0 * std::sqrt(variance) + 0.1 * count);
            if (ratio < worst) continue;
            worst = ratio;
            worstWhere = fmt::format("{} {}: mean square t exceeds its expectation by {:.3g} over {} pixels",
                                     kComponent[component], kChannel[channel], excess / count, count);
        }
    }
    if (worst > 1.0) agreement.agrees = false;
    agreement.report += fmt::format("{}scatter about the expectation: worst at {:.2f} of the limit, {}\n",
                                    worst > 1.0 ? "FAILED " : "", worst, worstWhere);
}

}  // namespace

Agreement judge(std::span<const RadianceImage> renders, const reference::Estimates& expected,
                const Criterion& criterion) {
    assert(renders.size() >= 2);
    const Values values = collect(renders, expected, criterion);
    Agreement agreement;
    RadianceImage blank{expected.width, expected.height, {}, {}};
    blank.invisible.resize(expected.pixels.size());
    blank.visible.resize(expected.pixels.size());
    agreement.meanImage = agreement.z = blank;
    for (std::size_t pixel = 0; pixel < expected.pixels.size(); ++pixel) {
        for (int c = 0; c < 3; ++c) {
            const auto mean = [&](int component) {
                return static_cast<float>(values.rendered[Values::at(pixel, component, c)].value);
            };
            agreement.meanImage.invisible[pixel][c] = mean(0);
            agreement.meanImage.visible[pixel][c] = mean(1);
        }
    }
    const std::uint32_t whole = std::max(expected.width, expected.height);
    if (renders.size() >= kEnoughForPixels) {
        judgeScale(values, renders, 1, criterion.alpha / 4, criterion, agreement);
        judgeScatter(values, criterion, agreement);
    }
    for (std::uint32_t size : {4u, 8u, whole})
        judgeScale(values, renders, size, criterion.alpha / 4, criterion, agreement);
    return agreement;
}

}  // namespace duolux::test
