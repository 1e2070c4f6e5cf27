#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "host/app/commands.h"
#include "host/base/error.h"
#include "host/generators/two_spheres.h"

namespace duolux {

namespace {

struct Options {
    std::string name;
    std::int64_t triangles = 500'000;
    std::string folder;
};

void makeScene(const Options& options) {
    if (options.name != "two-spheres") {
        throw UsageError(
            fmt::format("make-scene: no scene is called \"{}\"; expected two-spheres", options.name));
    }
    constexpr std::int64_t kFewest = kFewestTwoSpheresTriangles, kMost = kMostTwoSpheresTriangles;
    if (options.triangles < kFewest || options.triangles > kMost) {
        throw UsageError(fmt::format("--triangles: is {}; expected a whole number from {} to {}",
                                     options.triangles, kFewest, kMost));
    }
    const std::filesystem::path folder(options.folder);
    const std::size_t written = writeTwoSpheres(folder, static_cast<std::size_t>(options.triangles));
    fmt::print("{}: {} triangles\n", (folder / "two_spheres.json").string(), written);
}

}  // namespace

void addMakeSceneCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("make-scene", "Write one of the built-in scenes to a folder");
    auto options = std::make_shared<Options>();
    command->add_option("NAME", options->name, "two-spheres: the scene of the paper's evaluation")
        ->required();
    command->add_option("--triangles", options->triangles, "Number of triangles, within 1 %")
        ->capture_default_str();
    command
        ->add_option("-o,--output", options->folder,
                     "Folder for the OBJ, MTL and JSON files; created if it does not exist")
        ->required();
    command->callback([options] { makeScene(*options); });
}

}  // namespace duolux
