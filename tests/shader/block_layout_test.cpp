#include <gtest/gtest.h>

#include "host/vk/commands.h"
#include "host/vk/kernel.h"
#include "shaders/shared/light_tracer_layout.h"
#include "shaders/shared/trace_layout.h"
#include "tests/shader/harness/compiler.h"
#include "tests/shader/layout_words.h"
#include "tests/support/device.h"

// Structures in blocks: the host writes a sentinel into every word, and the device reads each word by name
// through the same kind of block as the kernels; and vice versa.

namespace duolux::test {
namespace {

constexpr std::size_t kStructures = 3;  // in storage buffers, to test the stride

/// Runs `statements` once, after `declarations` and with `uint words[]` at binding 1; returns `words`.
template <typename Push>
std::vector<std::uint32_t> run(const std::string& declarations, const std::string& statements,
                               const std::vector<Binding>& inputs, const Push& push, std::size_t words) {
    const std::string glsl =
        std::string(kernelHeader()) +
        "layout(local_size_x = 1) in;\n#include \"shaders/shared/bvh_layout.h\"\n"
        "#include \"shaders/shared/light_tracer_layout.h\"\n#include \"shaders/shared/trace_layout.h\"\n" +
        "layout(binding = 1, scalar) buffer Words { uint words[]; };\n" + declarations + "\nvoid main() {\n" +
        statements + "}\n";
    const Buffer output = Buffer::readback(device(), words * sizeof(std::uint32_t), "words");
    std::vector<Binding> bindings = inputs;
    bindings.push_back({1, &output});
    const Kernel kernel(device(), "layout", compileKernel(glsl), bindings, {}, sizeof(Push));
    runOnce(device(), "probing a layout",
            [&](const Commands& commands) { kernel.dispatch(commands, push, 1); });
    output.invalidate();
    std::vector<std::uint32_t> result(words);
    std::memcpy(result.data(), output.mapped(), words * sizeof(std::uint32_t));
    return result;
}

/// GLSL that copies every word of `object`, by its name, to words[first ...].
template <typename S>
std::string copyWords(const std::string& object, std::size_t first) {
    std::string glsl;
    for (const LayoutWord& word : layoutWords<S>()) {
        const std::string value = object + "." + word.name;
        glsl += "words[" + std::to_string(first++) +
                "] = " + (word.isFloat ? "floatBitsToUint(" + value + ")" : value) + ";\n";
    }
    return glsl;
}

template <typename S>
void expectSentinels(const std::vector<std::uint32_t>& seen, std::size_t structures) {
    const std::vector<LayoutWord> words = layoutWords<S>();
    for (std::size_t i = 0; i < structures; ++i) {
        for (std::size_t w = 0; w < words.size(); ++w)
            EXPECT_EQ(seen[i * words.size() + w], sentinel(i, w)) << i << ": " << words[w].name;
    }
}

template <typename S>
void expectArrivesByUniform() {
    const std::string name = structureName<S>();
    SCOPED_TRACE(name);
    const std::vector<S> items = sentinels<S>(1);
    const Buffer block = Buffer::upload<S>(device(), BufferUse::kUniform, items, "block");
    expectSentinels<S>(run("layout(binding = 0, scalar) uniform Block { " + name + " block; };",
                           copyWords<S>("block", 0), {{0, &block}}, 0u, layoutWords<S>().size()),
                       1);
}

template <typename S>
void expectArrivesByPush() {
    const std::string name = structureName<S>();
    SCOPED_TRACE(name);
    expectSentinels<S>(run("layout(push_constant, scalar) uniform Block { " + name + " block; };",
                           copyWords<S>("block", 0), {}, sentinels<S>(1)[0], layoutWords<S>().size()),
                       1);
}

template <typename S>
void expectArrivesByStorage() {
    const std::string name = structureName<S>();
    SCOPED_TRACE(name);
    const std::vector<S> items = sentinels<S>(kStructures);
    const Buffer block = Buffer::upload<S>(device(), BufferUse::kStorage, items, "block");
    std::string statements;
    for (std::size_t i = 0; i < kStructures; ++i)
        statements += copyWords<S>("blocks[" + std::to_string(i) + "]", i * layoutWords<S>().size());
    expectSentinels<S>(run("layout(binding = 0, scalar) readonly buffer Block { " + name + " blocks[]; };",
                           statements, {{0, &block}}, 0u, kStructures * layoutWords<S>().size()),
                       kStructures);
}

/// The device writes every word by name, and the host reads the structures.
template <typename S>
void expectReturnsByStorage() {
    const std::string name = structureName<S>();
    SCOPED_TRACE(name);
    const std::vector<LayoutWord> words = layoutWords<S>();
    std::string statements;
    for (std::size_t i = 0; i < kStructures; ++i) {
        for (std::size_t w = 0; w < words.size(); ++w) {
            const std::string value = std::to_string(sentinel(i, w)) + "u";
            statements += "blocks[" + std::to_string(i) + "]." + words[w].name + " = " +
                          (words[w].isFloat ? "uintBitsToFloat(" + value + ")" : value) + ";\n";
        }
    }
    const std::size_t size = kStructures * sizeof(S);
    const Buffer output = Buffer::readback(device(), size, "block");
    run("layout(binding = 0, scalar) writeonly buffer Block { " + name + " blocks[]; };", statements,
        {{0, &output}}, 0u, 1);
    output.invalidate();
    const std::vector<S> expected = sentinels<S>(kStructures);
    std::vector<S> seen(kStructures);
    std::memcpy(seen.data(), output.mapped(), size);
    for (std::size_t i = 0; i < kStructures; ++i) {
        for (const LayoutWord& word : words) {
            const auto at = [&](const std::vector<S>& items) {
                std::uint32_t value = 0;
                std::memcpy(&value, reinterpret_cast<const std::byte*>(&items[i]) + word.offset,
                            sizeof(value));
                return value;
            };
            EXPECT_EQ(at(seen), at(expected)) << i << ": " << word.name;
        }
    }
}

TEST(BlockLayout, UniformParametersArriveFieldByField) {
    expectArrivesByUniform<shared::PathParams>();
    expectArrivesByUniform<shared::DeviceReflectanceMatrix>();
}

TEST(BlockLayout, PushedParametersArriveFieldByField) {
    expectArrivesByPush<shared::PathTracerDispatch>();
    expectArrivesByPush<shared::LightTracerDispatch>();
    expectArrivesByPush<shared::TraceDispatch>();
}

TEST(BlockLayout, ProgressGoesBothWaysFieldByField) {
    expectArrivesByStorage<shared::TeamProgress>();
    expectReturnsByStorage<shared::TeamProgress>();
}

TEST(BlockLayout, RaysArriveFieldByField) {
    expectArrivesByStorage<shared::TraceRay>();
}

TEST(BlockLayout, ResultsReturnFieldByField) {
    expectReturnsByStorage<shared::TraceHit>();
    expectReturnsByStorage<shared::TraceCounts>();
    expectReturnsByStorage<shared::PixelResult>();
    expectReturnsByStorage<shared::LaneResult>();
}

}  // namespace
}  // namespace duolux::test
