#include "tests/support/device.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <optional>

#include "host/cli/temporary_folder.h"
#include "host/vk/handles.h"
#include "tests/support/run_program.h"

// The device on which tests run, and the behaviour if there is none.

namespace duolux::test {
namespace {

TEST(TestDevice, IsLavapipeUnlessAnotherIsAskedFor) {
    const auto driver =
        device()
            .handles()
            .physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>()
            .get<vk::PhysicalDeviceDriverProperties>();
    RecordProperty("device", device().info().name);
    RecordProperty("driver", device().info().driver);
    const std::string selector = deviceSelector();
    if (selector == "cpu" || selector == "llvmpipe") {
        EXPECT_EQ(driver.driverID, vk::DriverId::eMesaLlvmpipe) << device().info().driver;
    } else {
        EXPECT_FALSE(device().info().driver.empty());
    }
}

ProgramResult runWith(const std::vector<std::string>& environment,
                      const std::vector<std::string>& arguments) {
    const TemporaryFolder folder;
    return runProgram(DUOLUX_SHADER_TEST, folder.path(), arguments, std::nullopt, std::chrono::seconds(60),
                      environment);
}

const std::vector<std::string> kNoDriver{"VK_ICD_FILENAMES=/nowhere", "VK_DRIVER_FILES=/nowhere"};

TEST(TestDevice, NoDriverIsAFailure) {
    const ProgramResult result = runWith(kNoDriver, {"--gtest_filter=WarpGlsl.CosineHemisphereIsUnit"});
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, testing::HasSubstr("no Vulkan driver found; install one"));
}

TEST(TestDevice, ListsItsTestsWithoutOne) {
    const ProgramResult result = runWith(kNoDriver, {"--gtest_list_tests"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, testing::HasSubstr("WarpGlsl."));
}

/// CTest would count a missing test as passed.
TEST(TestDevice, ATestThatDoesNotExistIsAFailure) {
    const TemporaryFolder folder;
    const ProgramResult result =
        runProgram(DUOLUX_SHADER_TEST, folder.path(), {"--gtest_filter=WarpGlsl.Nowhere"});
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, testing::HasSubstr("no test's name matches WarpGlsl.Nowhere"));
}

TEST(TestDevice, OneThatIsNotThereIsAFailure) {
    const std::vector<std::string> arguments{"--gtest_filter=WarpGlsl.CosineHemisphereIsUnit"};
    for (const ProgramResult& result :
         {runWith({"DUOLUX_DEVICE=no such device"}, arguments),
          runWith({"DUOLUX_DEVICE=cpu"}, {"--device", "no such device", arguments[0]})}) {
        EXPECT_EQ(result.status, 1);
        EXPECT_THAT(result.err, testing::HasSubstr("DUOLUX_DEVICE=no such device: "));
        EXPECT_THAT(result.err, testing::HasSubstr("no such usable device"));
    }
}

}  // namespace
}  // namespace duolux::test
