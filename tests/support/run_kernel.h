#pragma once

#include <cstring>
#include <span>
#include <vector>

#include "host/vk/commands.h"
#include "host/vk/kernel.h"
#include "tests/support/device.h"

namespace duolux::test {

/// Runs a kernel of 64-wide work groups once for `count` invocations and returns what it wrote to
/// `outputBinding`.
template <typename Output, typename Push>
std::vector<Output> runKernel(std::span<const std::uint32_t> spirv, std::vector<Binding> bindings,
                              std::uint32_t outputBinding, const Push& push, std::uint32_t count) {
    const Buffer output = Buffer::readback(device(), count * sizeof(Output), "outputs");
    bindings.push_back({outputBinding, &output});
    const Kernel kernel(device(), "test", spirv, bindings, {}, sizeof(Push));
    runOnce(device(), "running a test kernel", [&](const vk::raii::CommandBuffer& commands) {
        kernel.dispatch(commands, push, (count + 63) / 64);
    });
    output.invalidate();
    std::vector<Output> result(count);
    std::memcpy(result.data(), output.mapped(), count * sizeof(Output));
    return result;
}

}  // namespace duolux::test
