#include "tests/shader/harness/kernel_run.h"

#include <cstring>
#include <memory>

#include "host/vk/commands.h"
#include "tests/shader/harness/report_layout.h"
#include "tests/support/device.h"

namespace duolux::test {

namespace {

std::unique_ptr<Buffer>& coverageBuffer() {
    static std::unique_ptr<Buffer> buffer;
    return buffer;
}

}  // namespace

Kernel harnessKernel(std::string_view name, std::span<const std::uint32_t> spirv,
                     std::vector<Binding> bindings, std::span<const Specialization> constants,
                     std::uint32_t pushConstantBytes) {
    if (coverageWords() > 0) {
        std::unique_ptr<Buffer>& buffer = coverageBuffer();
        if (buffer == nullptr) {
            buffer = std::make_unique<Buffer>(
                Buffer::readback(device(), coverageWords() * sizeof(std::uint32_t), "coverage"));
            runOnce(device(), "clearing coverage",
                    [&](const Commands& commands) { commands.fill(*buffer, 0); });
        }
        bindings.push_back({shared::kBindingCoverage, buffer.get()});
    }
    return {device(), name, spirv, bindings, constants, pushConstantBytes};
}

std::size_t& coverageWords() {
    static std::size_t words = 0;
    return words;
}

std::vector<std::uint32_t> takeCoverage() {
    std::vector<std::uint32_t> words(coverageWords());
    if (std::unique_ptr<Buffer>& buffer = coverageBuffer(); buffer != nullptr) {
        buffer->invalidate();
        std::memcpy(words.data(), buffer->mapped(), words.size() * sizeof(std::uint32_t));
        buffer.reset();
    }
    return words;
}

}  // namespace duolux::test
