#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/base/error.h"
#include "host/device_scene/device_scene.h"
#include "host/device_scene/tuning.h"

namespace duolux {
namespace {

using testing::HasSubstr;

constexpr std::uint64_t kMebibyte = 1 << 20;

DeviceInfo deviceOf(DeviceKind kind) {
    DeviceInfo device;
    device.name = "a device";
    device.driver = "a driver";
    device.kind = kind;
    device.subgroupSize = kind == DeviceKind::kCpu ? 8 : 32;
    device.maxWorkgroupSize = 1024;
    device.maxStorageBufferRange = 128 * kMebibyte;
    device.maxTexelBufferElements = 64 * kMebibyte;  // of 16 bytes
    return device;
}

std::string messageOf(const std::function<void()>& what) {
    try {
        what();
    } catch (const Error& e) {
        return e.what();
    }
    return "no error";
}

TEST(Tuning, FollowsTheKindOfDevice) {
    const Tuning cpu = chooseTuning(deviceOf(DeviceKind::kCpu), {});
    EXPECT_EQ(cpu.layout, Layout::kTexel);
    EXPECT_EQ(cpu.kernel, KernelKind::kRefilling);
    EXPECT_EQ(cpu.workgroupSize, 8u);
    EXPECT_EQ(cpu.leaveTraversal, 4u);
    EXPECT_EQ(cpu.leaveTraversalCostly, 0u);
    EXPECT_EQ(cpu.leaveNodes, 3u);
    EXPECT_TRUE(cpu.voteByShuffle);
    const Tuning gpu = chooseTuning(deviceOf(DeviceKind::kGpu), {});
    EXPECT_EQ(gpu.layout, Layout::kStorage);
    EXPECT_EQ(gpu.kernel, KernelKind::kRefilling);
    EXPECT_EQ(gpu.lanes, 32u);
    EXPECT_EQ(gpu.workgroupSize, 64u);
    EXPECT_EQ(gpu.leaveTraversal, 16u);
    EXPECT_EQ(gpu.leaveTraversalCostly, 16u);
    EXPECT_FALSE(gpu.voteByShuffle);
    DeviceInfo wide = deviceOf(DeviceKind::kCpu);
    wide.subgroupSize = 16;
    EXPECT_FALSE(chooseTuning(wide, {}).voteByShuffle);
}

TEST(Tuning, WorkGroupsAreWholeSubgroupsWithinTheLimit) {
    DeviceInfo device = deviceOf(DeviceKind::kGpu);
    device.subgroupSize = 128;
    EXPECT_EQ(chooseTuning(device, {}).workgroupSize, 128u);
    device.subgroupSize = 16;
    device.maxWorkgroupSize = 40;
    EXPECT_EQ(chooseTuning(device, {}).workgroupSize, 32u);
    device.subgroupSize = 0;
    EXPECT_EQ(chooseTuning(device, {}).lanes, 1u);
}

TEST(Tuning, WhatIsAskedForTakesTheFirstPlace) {
    for (const DeviceKind kind : {DeviceKind::kCpu, DeviceKind::kGpu}) {
        for (const Layout layout : {Layout::kTexel, Layout::kStorage})
            EXPECT_EQ(chooseTuning(deviceOf(kind), {.layout = layout, .kernel = {}}).layout, layout);
        const Tuning plain = chooseTuning(deviceOf(kind), {.layout = {}, .kernel = KernelKind::kPlain});
        EXPECT_EQ(plain.kernel, KernelKind::kPlain);
        // At a threshold of 0 lanes, no vote ends a loop.
        EXPECT_EQ(plain.leaveTraversal, 0u);
        EXPECT_EQ(plain.leaveTraversalCostly, 0u);
        EXPECT_EQ(plain.leaveNodes, 0u);
    }
}

TEST(Tuning, RayQueriesAreForDevicesThatHaveThem) {
    DeviceInfo device = deviceOf(DeviceKind::kCpu);
    const auto choose = [&](std::optional<KernelKind> kernel) {
        return chooseTuning(device, {.layout = Layout::kRayQuery, .kernel = kernel});
    };
    EXPECT_EQ(messageOf([&] { choose({}); }),
              "layout ray-query: a device (a driver) has no ray queries; expected texel or storage");
    device.rayQueries = true;
    EXPECT_EQ(choose({}).layout, Layout::kRayQuery);
    EXPECT_EQ(choose({}).kernel, KernelKind::kPlain);
    EXPECT_EQ(choose(KernelKind::kPlain).kernel, KernelKind::kPlain);
    EXPECT_THAT(messageOf([&] { choose(KernelKind::kRefilling); }), HasSubstr("kernel refilling: lanes"));
    EXPECT_EQ(chooseTuning(device, {}).layout, Layout::kTexel);  // only if asked for
}

TEST(Tuning, AnotherLayoutTakesWhatDoesNotFitUnlessOneIsAskedFor) {
    const DeviceInfo device = deviceOf(DeviceKind::kGpu);
    const auto fitted = [&](Layout chosen, std::uint64_t bytes) {
        return layoutThatFits(device, chosen, {}, bytes);
    };
    const auto asked = [&](Layout chosen, std::uint64_t bytes) {
        return layoutThatFits(device, chosen, {.layout = chosen, .kernel = {}}, bytes);
    };
    EXPECT_EQ(fitted(Layout::kStorage, 128 * kMebibyte), Layout::kStorage);
    EXPECT_EQ(fitted(Layout::kStorage, 128 * kMebibyte + 1), Layout::kTexel);
    EXPECT_EQ(fitted(Layout::kTexel, 1024 * kMebibyte), Layout::kTexel);
    EXPECT_EQ(fitted(Layout::kStorage, 1024 * kMebibyte + 1), Layout::kStorage);  // the upload fails
    EXPECT_EQ(fitted(Layout::kRayQuery, 1024 * kMebibyte + 1), Layout::kRayQuery);
    EXPECT_EQ(asked(Layout::kStorage, 128 * kMebibyte), Layout::kStorage);
    EXPECT_EQ(messageOf([&] { asked(Layout::kStorage, 128 * kMebibyte + 16); }),
              "layout storage: a buffer of this scene takes 134217744 bytes, but a device (a driver) "
              "can bind at most 134217728 bytes with this layout; layout texel can hold it");
    DeviceInfo small = device;
    small.maxTexelBufferElements = 65536;
    EXPECT_EQ(layoutThatFits(small, Layout::kTexel, {}, kMebibyte), Layout::kTexel);
    EXPECT_EQ(layoutThatFits(small, Layout::kTexel, {}, kMebibyte + 16), Layout::kStorage);
}

TEST(DeviceMemory, OfAGpuMustHoldTheScene) {
    DeviceInfo device;
    device.kind = DeviceKind::kGpu;
    device.name = "Card";
    device.driver = "driver 1";
    device.memoryBytes = std::uint64_t{8} << 30;
    LoadedScene scene;
    scene.source = "big.obj";
    scene.geometry.triangles.resize(7);
    EXPECT_NO_THROW(requireDeviceMemory(device, device.memoryBytes, scene));
    try {
        requireDeviceMemory(device, device.memoryBytes + 1, scene);
        ADD_FAILURE() << "expected MemoryError";
    } catch (const MemoryError& e) {
        EXPECT_STREQ(
            e.what(),
            "big.obj: 7 triangles take 8193 MiB of device memory, but Card (driver 1) has 8192; expected "
            "fewer triangles, or a device with more memory, such as the CPU");
    }
    device.kind = DeviceKind::kCpu;
    EXPECT_NO_THROW(requireDeviceMemory(device, device.memoryBytes + 1, scene));
}

}  // namespace
}  // namespace duolux
