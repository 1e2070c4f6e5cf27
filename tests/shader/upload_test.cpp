#include <gmock/gmock.h>

#include <cstring>
#include <string>
#include <vector>

#include "host/vk/buffer.h"
#include "host/vk/commands.h"
#include "host/vk/kernel.h"
#include "tests/shader/harness/compiler.h"
#include "tests/shader/inputs.h"
#include "tests/support/device.h"

// A kernel reads the same values from a buffer that the host has written to it.

namespace duolux::test {
namespace {

std::vector<std::uint32_t> readByKernel(const Buffer& buffer, std::uint32_t count) {
    static const std::vector<std::uint32_t> kernel = compileKernel(std::string(kernelHeader()) + R"(
        layout(local_size_x = 64) in;
        layout(binding = 0, scalar) readonly buffer InputBlock { uint inputs[]; };
        layout(binding = 1, scalar) writeonly buffer OutputBlock { uint outputs[]; };
        layout(push_constant, scalar) uniform PushBlock { uint count; };
        void main() {
            uint i = gl_GlobalInvocationID.x;
            if (i < count) outputs[i] = inputs[i];
        })");
    const Buffer output = Buffer::readback(device(), count * sizeof(std::uint32_t), "outputs");
    const Kernel copy(device(), "copy", kernel, std::vector<Binding>{{0, &buffer}, {1, &output}}, {},
                      sizeof count);
    runOnce(device(), "copying",
            [&](const Commands& commands) { copy.dispatch(commands, count, (count + 63) / 64); });
    output.invalidate();
    std::vector<std::uint32_t> words(count);
    std::memcpy(words.data(), output.mapped(), count * sizeof(std::uint32_t));
    return words;
}

TEST(Upload, ThroughAStagingBufferGivesTheSame) {
    const std::vector<std::uint32_t> words = randomWords(20000);
    const std::span<const std::uint32_t> items(words);
    const auto count = static_cast<std::uint32_t>(words.size());
    const Buffer direct = Buffer::upload(device(), BufferUse::kStorage, items, "inputs");
    const Buffer staged = Buffer::uploadStaged(device(), BufferUse::kStorage, std::as_bytes(items), "inputs");
    EXPECT_EQ(readByKernel(direct, count), words);
    EXPECT_EQ(readByKernel(staged, count), words);
}

}  // namespace
}  // namespace duolux::test
