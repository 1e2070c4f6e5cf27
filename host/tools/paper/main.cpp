// duolux-paper: the evaluation of the paper, repeated against OpenGL.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "host/base/file.h"
#include "host/cli/options.h"
#include "host/cli/program.h"
#include "host/tools/paper/experiment.h"
#include "host/tools/paper/report.h"

namespace duolux {

namespace {

void parseAndRun(int argc, char** argv) {
    ExperimentSetup setup;
    std::string folder;
    CLI::App app{
        "Repeats the paper's evaluation: `local` by transport against OpenGL, with pictures, tables and "
        "speeds, as a\n"
        "page (index.html), as tables (tables.md) and as JSON (results.json).",
        "duolux-paper"};
    setUpProgram(app);
    app.add_option("-o,--output", folder, "Folder for the report; created if it does not exist")
        ->required()
        ->type_name("DIR");
    app.add_option("--duolux", setup.duolux, "The renderer")->required()->type_name("PROGRAM");
    app.add_option("--duolux-gl", setup.duoluxGl, "OpenGL's renderer")->required()->type_name("PROGRAM");
    app.add_option("--triangles", setup.triangles,
                   "Triangles of the two-spheres scene (speed is measured at 1,000 to 2,000,000)")
        ->check(wholeNumber(1000, 50'000'000))
        ->capture_default_str()
        ->type_name("N");
    app.add_option("--size", setup.size, "Width and height of the pictures")
        ->check(wholeNumber(32, 4096))
        ->capture_default_str()
        ->type_name("N");
    app.add_flag("--quick", setup.quick, "A short run that only checks that everything works");
    if (!parseArguments(app, {argv + 1, argv + argc})) return;
    setup.folder = folder;
    if (setup.quick) {
        setup.spp = {4, 16};
        setup.passes = 16;
        setup.crossing = {1000, 2000};
        setup.repetitions = 1;
    }
    const Experiment experiment = runExperiment(setup);
    writeFile(setup.folder / "tables.md", markdownTables(setup, experiment));
    writeFile(setup.folder / "results.json", jsonReport(setup, experiment));
    writeFile(setup.folder / "index.html", htmlReport(setup, experiment));
    fmt::print("{}", markdownTables(setup, experiment));
    fmt::print("The report: {}\n", (setup.folder / "index.html").string());
}

}  // namespace

}  // namespace duolux

int main(int argc, char** argv) {
    return duolux::runMain("duolux-paper", [&] { duolux::parseAndRun(argc, argv); });
}
