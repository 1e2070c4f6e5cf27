#include "tests/statistical/renders.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "host/base/error.h"
#include "tests/reference/estimates_image.h"
#include "tests/support/device.h"

namespace duolux::test {

namespace {

/// Writes a PFM of each component and a PNG of the displayed one.
void writeAll(const std::filesystem::path& stem, const RadianceImage& image) {
    ImageOptions options;
    writeImage(stem.string() + "-visible.pfm", image, options);
    writeImage(stem.string() + "-visible.png", image, options);
    options.display = {1.0f, 0.0f};
    writeImage(stem.string() + "-invisible.pfm", image, options);
}

}  // namespace

Renders renderSeeds(LoadedScene scene, std::uint32_t spp, std::uint32_t seeds, std::uint32_t firstSeed,
                    const RenderControl& control) {
    Renders renders;
    scene.settings.spp = spp;
    for (std::uint32_t i = 0; i < seeds; ++i) {
        scene.settings.seed = firstSeed + i;
        const RenderOutput output = render(device(), scene, control);
        EXPECT_EQ(output.statistics.nonFiniteSamples, 0u);
        EXPECT_FALSE(output.statistics.filmOverflowed);
        EXPECT_EQ(scene.settings.integrator == Integrator::kLightTracer ? output.film.lightPaths()
                                                                        : output.film.totalSamples(),
                  std::uint64_t{scene.settings.width} * scene.settings.height * spp);
        renders.images.push_back(output.film.resolve());
        renders.directLightInClosedForm = output.statistics.directLightInClosedForm;
    }
    return renders;
}

std::optional<Renders> renderOtherEstimator(const LoadedScene& scene, std::uint32_t spp, std::uint32_t seeds,
                                            const Renders& renders) {
    RenderControl other;
    other.directLight = renders.directLightInClosedForm ? DirectLight::kSampled : DirectLight::kClosedForm;
    try {
        Renders others = renderSeeds(scene, spp, seeds, 1, other);
        EXPECT_NE(others.directLightInClosedForm, renders.directLightInClosedForm);
        return others;
    } catch (const UsageError&) {
        return std::nullopt;
    }
}

Renders renderByLight(LoadedScene scene, std::uint32_t spp, std::uint32_t seeds) {
    scene.settings.integrator = Integrator::kLightTracer;
    return renderSeeds(std::move(scene), spp, seeds);
}

reference::Estimates estimatesOf(const Renders& renders) {
    const RadianceImage& first = renders.images.front();
    const auto count = static_cast<double>(renders.images.size());
    reference::Estimates estimates{
        first.width, first.height, static_cast<std::uint32_t>(renders.images.size()), {}};
    estimates.pixels.resize(first.visible.size());
    for (std::size_t pixel = 0; pixel < estimates.pixels.size(); ++pixel) {
        for (int component = 0; component < 2; ++component) {
            for (int channel = 0; channel < 3; ++channel) {
                const auto value = [&](const RadianceImage& image) {
                    return static_cast<double>(
                        (component == 0 ? image.invisible : image.visible)[pixel][channel]);
                };
                double& mean = estimates.pixels[pixel].mean[component][channel];
                double& variance = estimates.pixels[pixel].variance[component][channel];
                for (const RadianceImage& image : renders.images)
                    mean += value(image) / count;
                for (const RadianceImage& image : renders.images)
                    variance += (value(image) - mean) * (value(image) - mean) / (count * (count - 1.0));
            }
        }
    }
    return estimates;
}

void expectAgreement(const std::string& name, const Renders& renders, const reference::Estimates& expected,
                     Criterion criterion) {
    const Agreement agreement = judge(renders.images, expected, criterion);
    if (agreement.agrees) return;
    const std::filesystem::path folder = DUOLUX_ARTEFACTS;
    std::filesystem::create_directories(folder);
    writeAll(folder / (name + "-rendered"), agreement.meanImage);
    writeAll(folder / (name + "-expected"), imageOf(expected));
    writeAll(folder / (name + "-t"), agreement.z);
    ADD_FAILURE() << agreement.report << "pictures: " << (folder / name).string() << "-*";
}

}  // namespace duolux::test
