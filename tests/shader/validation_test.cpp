#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "host/vk/buffer.h"
#include "host/vk/commands.h"
#include "host/vk/device.h"
#include "tests/support/device.h"

namespace duolux::test {
namespace {

/// A hazard must give a validation message; otherwise the absence of messages in other tests shows nothing.
TEST(Validation, ReportsASynchronizationHazard) {
    Device device(deviceSelector(), Validation::kOn);
    const std::vector<std::uint32_t> zeros(64);
    const Buffer buffer = Buffer::upload<std::uint32_t>(device, BufferUse::kStorage, zeros, "zeros");
    runOnce(device, "filling", [&](const Commands& commands) { commands.fill(buffer, 0, 256, 1); });
    EXPECT_THAT(device.validationMessages(), testing::IsEmpty());
    runOnce(device, "filling twice without a barrier", [&](const Commands& commands) {
        commands.fill(buffer, 0, 256, 1);
        commands.fill(buffer, 0, 256, 2);
    });
    EXPECT_THAT(device.validationMessages(), testing::Contains(testing::HasSubstr("WRITE_AFTER_WRITE")));
}

}  // namespace
}  // namespace duolux::test
