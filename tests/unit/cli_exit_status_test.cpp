#include <gtest/gtest.h>

#include "host/cli/exit_status.h"
#include "host/vk/device_info.h"

namespace duolux {
namespace {

TEST(ExitStatus, FollowsFromTheError) {
    EXPECT_EQ(statusOf(InputError("f", "", "p", "")), ExitStatus::kBadInput);
    EXPECT_EQ(statusOf(UsageError("u")), ExitStatus::kUsage);
    EXPECT_EQ(statusOf(MachineError("m")), ExitStatus::kMachineFailed);
    EXPECT_EQ(statusOf(DeviceError("d")), ExitStatus::kMachineFailed);
    EXPECT_EQ(statusOf(MemoryError("m")), ExitStatus::kMachineFailed);
    EXPECT_EQ(statusOf(NoDriverError("n")), ExitStatus::kMachineFailed);
    EXPECT_EQ(statusOf(Stopped(ExitStatus::kTerminated, "t")), ExitStatus::kTerminated);
}

}  // namespace
}  // namespace duolux
