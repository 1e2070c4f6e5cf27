#include "host/film/sheet.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "host/app/commands.h"
#include "host/base/error.h"
#include "host/base/version.h"
#include "host/cli/options.h"
#include "host/cli/outputs.h"
#include "host/film/image.h"

namespace duolux {

namespace {

struct SheetOptions {
    std::string output;
    std::uint32_t columns = 4;
    std::vector<std::string> labels;
    std::vector<std::string> images;
};

void runSheet(const SheetOptions& options) {
    checkOutputs({{"-o", options.output}}, options.images);
    if (options.labels.size() > options.images.size()) {
        throw UsageError(
            fmt::format("--label was given {} times for {} images; expected at most one for each image",
                        options.labels.size(), options.images.size()));
    }
    std::vector<SheetCell> cells;
    for (std::size_t i = 0; i < options.images.size(); ++i) {
        const std::filesystem::path path = options.images[i];
        RadianceImage image = readImage(path);
        if (i > 0) requireSameSize(image, path, cells[0].image, options.images[0]);
        cells.push_back(
            {std::move(image), i < options.labels.size() ? options.labels[i] : path.stem().string()});
    }
    ImageOptions imageOptions;
    imageOptions.metadata.emplace_back("Software", fmt::format("duolux {}", versionString()));
    const RadianceImage image = makeSheet(cells, options.columns);
    WriteAll write;
    write(options.output, [&](const std::filesystem::path& path) { writeImage(path, image, imageOptions); });
    write.finish();
}

}  // namespace

void addSheetCommand(CLI::App& app) {
    auto options = std::make_shared<SheetOptions>();
    CLI::App* command = app.add_subcommand("sheet", "Arrange images side by side with captions");
    command->add_option("-o,--output", options->output, fmt::format("The sheet: {}", imageExtensions()))
        ->required()
        ->type_name("FILE");
    command->add_option("--columns", options->columns, "Images in a row")
        ->check(wholeNumber(1, 1000))
        ->capture_default_str()
        ->type_name("N");
    addRepeatable(*command, "--label", options->labels,
                  "Caption of the first, second, ... image (default: the file's name)")
        ->type_name("TEXT");
    command->add_option("IMAGE", options->images, "Images of one size")->required()->type_name("");
    command->callback([options] { runSheet(*options); });
}

}  // namespace duolux
