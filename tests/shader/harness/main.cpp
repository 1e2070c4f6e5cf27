// GoogleTest's main() for shader tests: GLSL test files beside those in C++, and options of its own.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/shader/harness/compiler.h"
#include "tests/shader/harness/coverage.h"
#include "tests/shader/harness/glsl_test.h"

int main(int argc, char** argv) {
    using namespace duolux::test;
    CLI::App app(
        "Tests of the shader library on a Vulkan device. All of GoogleTest's --gtest_... options apply.");
    std::string device;
    std::string sources;
    app.add_option(
        "--device", device,
        "device to run on: cpu, gpu, an index, or a part of a name (default: $DUOLUX_DEVICE, else cpu)");
    app.add_option("--sources", sources,
                   "folder whose files stand in for those of the same name in the project")
        ->check(CLI::ExistingDirectory);
    std::string coverage;
    app.add_option("--coverage", coverage,
                   "file for a report on which functions and branches of the library the tests reach");
    const bool help =
        argc == 2 && (std::string_view(argv[1]) == "--help" || std::string_view(argv[1]) == "-h");
    if (!help) testing::InitGoogleTest(&argc, argv);  // takes its own options away
    CLI11_PARSE(app, argc, argv);
    if (!device.empty()) setenv("DUOLUX_DEVICE", device.c_str(), 1);
    if (!sources.empty()) sourceRoots().insert(sourceRoots().begin(), std::filesystem::absolute(sources));
    registerGlslTests(DUOLUX_GLSL_TESTS);
    if (!coverage.empty()) measureCoverage(DUOLUX_GLSL_LIBRARY, coverage);
    return RUN_ALL_TESTS();
}
