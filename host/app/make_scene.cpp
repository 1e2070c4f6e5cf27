#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

#include "host/app/commands.h"
#include "host/base/error.h"
#include "host/cli/options.h"
#include "host/generators/two_spheres.h"

namespace duolux {

namespace {

struct Options {
    std::string name;
    std::size_t triangles = 500'000;
    std::string folder;
};

void makeScene(const Options& options) {
    if (options.name != "two-spheres") {
        throw UsageError(
            fmt::format("make-scene: no scene is called \"{}\"; expected two-spheres", options.name));
    }
    const std::filesystem::path folder(options.folder);
    const std::size_t written = writeTwoSpheres(folder, options.triangles);
    fmt::print("{}: {} triangles\n", (folder / "two_spheres.json").string(), written);
}

}  // namespace

void addMakeSceneCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("make-scene", "Write one of the built-in scenes to a folder");
    auto options = std::make_shared<Options>();
    command->add_option("NAME", options->name, "two-spheres: the scene of the paper's evaluation")
        ->required()
        ->type_name("");
    command->add_option("--triangles", options->triangles, "Number of triangles, within 1 %")
        ->check(wholeNumber(kFewestTwoSpheresTriangles, kMostTwoSpheresTriangles))
        ->capture_default_str()
        ->type_name("N");
    command
        ->add_option("-o,--output", options->folder,
                     "Folder for the OBJ, MTL and JSON files; created if it does not exist")
        ->required()
        ->type_name("FOLDER");
    command->callback([options] { makeScene(*options); });
}

}  // namespace duolux
