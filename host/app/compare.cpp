#include "host/tools/compare/compare.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/app/commands.h"
#include "host/app/machine_options.h"
#include "host/base/error.h"
#include "host/base/nearest_name.h"
#include "host/base/version.h"
#include "host/cli/json.h"
#include "host/cli/options.h"
#include "host/cli/outputs.h"
#include "host/tools/compare/heat_map.h"

namespace duolux {

namespace {

struct Arguments {
    std::string image, reference, mask, heatMap, transfer = "srgb";
    float exposure = 0.0f, heatMapRange = 0.05f;
    std::vector<std::string> limits;
    bool json = false;
};

struct Limit {
    std::string metric;
    double value;
};

Limit parseLimit(const std::string& text) {
    const std::size_t equals = text.find('=');
    const auto fail = [&](const std::string& problem) {
        throw UsageError(fmt::format("--fail-above {}: {}", text, problem));
    };
    if (equals == std::string::npos) fail("expected METRIC=VALUE, such as eps_mean=0.004");
    Limit limit{text.substr(0, equals), 0.0};
    std::vector<std::string> known;
    for (const auto& [name, value] : Comparison{}.metrics()) {
        if (name != "psnr") known.emplace_back(name);
    }
    if (limit.metric == "psnr") fail("a higher psnr is better; expected a metric that grows with the error");
    if (std::find(known.begin(), known.end(), limit.metric) == known.end()) {
        fail(fmt::format("unknown metric; {}", suggestName(limit.metric, known)));
    }
    if (!CLI::detail::lexical_cast(text.substr(equals + 1), limit.value) || !(limit.value >= 0.0) ||
        !std::isfinite(limit.value)) {
        fail("expected a number >= 0 after the =");
    }
    return limit;
}

RadianceImage readSameSize(const std::string& path, const RadianceImage& first,
                           const std::string& firstPath) {
    RadianceImage image = readDisplayedImage(path);
    requireSameSize(image, path, first, firstPath);
    return image;
}

std::vector<bool> readMask(const Arguments& arguments, const RadianceImage& image) {
    const RadianceImage mask = readSameSize(arguments.mask, image, arguments.image);
    std::vector<bool> counts;
    for (const glm::vec3& pixel : mask.visible)
        counts.push_back(std::max({pixel.x, pixel.y, pixel.z}) >= 0.5f);
    if (std::find(counts.begin(), counts.end(), true) == counts.end()) {
        throw InputError(arguments.mask, "", "masks every pixel",
                         "expected white where pixels are to be compared");
    }
    return counts;
}

void print(const Comparison& c) {
    const auto percent = [](double x) { return 100.0 * x; };
    fmt::print("pixels compared           {}\n", c.pixels);
    if (c.nonFinite > 0) fmt::print("pixels not finite         {}: no metric has a value\n", c.nonFinite);
    fmt::print("eps, mean                 {:.4f} %   (the paper's, of displayed values)\n",
               percent(c.epsMean));
    fmt::print("eps, maximum              {:.4f} %\n", percent(c.epsMax));
    fmt::print("pixels with eps > 1/255   {:.4f} %\n", percent(c.epsAboveOneCode));
    fmt::print("average colours differ by {:.4f} %\n", percent(c.averageColour));
    fmt::print("signed mean error         {:+.6g}   (of radiance, as the next two)\n", c.signedMean);
    fmt::print("RMSE                      {:.6g}\n", c.rmse);
    fmt::print("relative MSE              {:.6g}\n", c.relativeMse);
    fmt::print("PSNR                      {:.2f} dB\n", c.psnr);
    fmt::print("FLIP, mean                {:.5f}\n", c.flip);
}

void printJson(const Arguments& arguments, const Comparison& c) {
    nlohmann::ordered_json json;
    json["version"] = 1;
    json["program"] = {{"version", versionString()}, {"commit", commitString()}};
    json["image"] = arguments.image;
    json["reference"] = arguments.reference;
    json["pixels"] = c.pixels;
    json["non_finite"] = c.nonFinite;
    for (const auto& [name, value] : c.metrics()) {
        // JSON has neither infinity nor NaN: PSNR is null for identical images, and all metrics are null if
        // some pixels are not finite.
        json[std::string(name)] =
            std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
    }
    fmt::print("{}", jsonText(json));
}

void checkLimits(const std::vector<Limit>& limits, const Arguments& arguments, const Comparison& c) {
    std::string exceeded;
    for (const Limit& limit : limits) {
        for (const auto& [name, value] : c.metrics()) {
            if (name != limit.metric || std::abs(value) <= limit.value) continue;
            exceeded += fmt::format("{}{} is {:.6g}, above {:g}", exceeded.empty() ? "" : "; ", name, value,
                                    limit.value);
        }
    }
    if (!exceeded.empty()) throw MachineError(fmt::format("{}: {}", arguments.image, exceeded));
}

void run(const Arguments& arguments) {
    std::vector<Limit> limits;
    for (const std::string& text : arguments.limits)
        limits.push_back(parseLimit(text));
    if (!arguments.heatMap.empty()) {
        checkOutputs({{"--heatmap", arguments.heatMap}},
                     {arguments.image, arguments.reference, arguments.mask});
    }
    const RadianceImage image = readDisplayedImage(arguments.image);
    const RadianceImage reference = readSameSize(arguments.reference, image, arguments.image);
    CompareOptions options;
    options.exposure = arguments.exposure;
    options.transfer = named<Transfer>(arguments.transfer).value_or(options.transfer);
    if (!arguments.mask.empty()) options.mask = readMask(arguments, image);
    const Comparison comparison = compare(image, reference, options);
    WriteAll write;
    if (!arguments.heatMap.empty()) {
        std::vector<float> eps = epsMap(image, reference, options);
        for (std::size_t i = 0; i < eps.size(); ++i) {
            if (!options.mask.empty() && !options.mask[i]) eps[i] = 0.0f;
        }
        const RadianceImage map = heatMap(eps, image.width, image.height, arguments.heatMapRange);
        write(arguments.heatMap, [&](const std::filesystem::path& path) { writeImage(path, map, {}); });
    }
    if (arguments.json) {
        printJson(arguments, comparison);
    } else {
        print(comparison);
    }
    write.finish();
    checkLimits(limits, arguments, comparison);
}

}  // namespace

void addCompareCommand(CLI::App& app) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("compare", "Measure how far an image is from a reference");
    command->add_option("IMAGE", arguments->image, fmt::format("The image: {}", imageExtensions()))
        ->required();
    command->add_option("REFERENCE", arguments->reference, "The reference image, of the same size")
        ->required();
    command->add_flag("--json", arguments->json, "Print JSON");
    command
        ->add_option("--mask", arguments->mask,
                     "Compare only the pixels that are white in this image (a channel of at least 0.5 "
                     "linear, sRGB code 188)")
        ->type_name("FILE");
    command->add_option("--heatmap", arguments->heatMap, "Write an image of eps, from black (0) to white")
        ->type_name("FILE");
    command->add_option("--heatmap-range", arguments->heatMapRange, "The eps that is shown as white")
        ->check(between(1e-6, 1.0))
        ->capture_default_str()
        ->type_name("EPS");
    addRepeatable(*command, "--fail-above", arguments->limits,
                  "Exit with status 1 if a metric (named as in the JSON; the magnitude if it is signed) "
                  "exceeds VALUE; may be given several times")
        ->type_name("METRIC=VALUE");
    command
        ->add_option("--exposure", arguments->exposure,
                     "Stops by which both images are brightened for display")
        ->check(between(-64.0, 64.0))
        ->type_name("STOPS");
    command
        ->add_option("--transfer", arguments->transfer,
                     "Displayed values: srgb-encoded as in PNG files, or linear as in the paper; eps and "
                     "PSNR use them")
        ->check(oneOf(namesOfAll<Transfer>()))
        ->capture_default_str()
        ->type_name("NAME");
    addThreadsOption(*command);
    command->callback([arguments] { run(*arguments); });
}

}  // namespace duolux
