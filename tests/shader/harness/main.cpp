// GoogleTest's main() for shader tests: registers GLSL test files in addition to C++ tests, and has its own
// options.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>

#include "tests/shader/harness/compiler.h"
#include "tests/shader/harness/coverage.h"
#include "tests/shader/harness/glsl_test.h"
#include "tests/support/device.h"

namespace {

using namespace duolux::test;

int run(int argc, char** argv) {
    CLI::App app(
        "Tests of the shader library on a Vulkan device. All of GoogleTest's --gtest_... options apply.");
    std::string device;
    std::string sources;
    std::string coverage;
    app.add_option(
        "--device", device,
        "device to run on: cpu, gpu, an index, or a part of a name (default: $DUOLUX_DEVICE, else cpu)");
    app.add_option("--sources", sources,
                   "folder whose files stand in for those of the same name in the project")
        ->check(CLI::ExistingDirectory);
    app.add_option("--coverage", coverage,
                   "file for a report on which functions and branches of the library the tests reach");
    app.add_option("--seed", randomSeed(), "makes the random inputs of GLSL tests other ones")
        ->capture_default_str();
    const bool help = std::any_of(argv + 1, argv + argc, [](const char* argument) {
        return std::string_view(argument) == "--help" || std::string_view(argument) == "-h";
    });
    if (help) app.allow_extras();
    if (!help) testing::InitGoogleTest(&argc, argv);  // removes its own options
    CLI11_PARSE(app, argc, argv);
    if (!device.empty()) setenv("DUOLUX_DEVICE", device.c_str(), 1);
    if (!sources.empty()) sourceRoots().insert(sourceRoots().begin(), std::filesystem::absolute(sources));
    registerGlslTests(DUOLUX_GLSL_TESTS);
    if (!coverage.empty()) measureCoverage(DUOLUX_GLSL_LIBRARY, coverage);
    const bool list = testing::GTEST_FLAG(list_tests);
    // Without a device, report one failure instead of one for every test.
    if (!list) duolux::test::device();
    const int status = RUN_ALL_TESTS();
    if (!list && testing::UnitTest::GetInstance()->test_to_run_count() == 0) {
        throw std::runtime_error(
            fmt::format("no test's name matches {}", std::string(testing::GTEST_FLAG(filter))));
    }
    return status;
}

}  // namespace

int main(int argc, char** argv) {
    int status = 1;
    try {
        status = run(argc, argv);
    } catch (const std::exception& e) {
        fmt::print(stderr, "shader_test: {}\n", e.what());
    }
    closeDevice();
    return status;
}
