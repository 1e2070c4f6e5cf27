#include "tests/shader/harness/shader_function.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "host/vk/commands.h"
#include "tests/shader/harness/compiler.h"
#include "tests/shader/harness/kernel_run.h"
#include "tests/shader/harness/report_layout.h"
#include "tests/support/device.h"

namespace duolux::test {

namespace {

const std::vector<std::uint32_t>& compiled(const std::string& glsl) {
    static std::map<std::string, std::vector<std::uint32_t>> kernels;
    auto found = kernels.find(glsl);
    if (found == kernels.end()) found = kernels.emplace(glsl, compileKernel(glsl)).first;
    return found->second;
}

std::string numbered(const std::string& text) {
    std::istringstream lines(text);
    std::string out;
    int number = 0;
    for (std::string line; std::getline(lines, line);)
        out += fmt::format("{:>4} {}\n", ++number, line);
    return out;
}

}  // namespace

ShaderLibrary& ShaderLibrary::texels(std::string_view function, std::span<const std::byte> bytes) {
    const auto same = [&](const auto& entry) { return entry.first == function; };
    const auto old = std::find_if(texels_.begin(), texels_.end(), same);
    if (old != texels_.end()) texels_.erase(old);
    texels_.emplace_back(function, std::vector<std::byte>(bytes.begin(), bytes.end()));
    return *this;
}

std::size_t ShaderLibrary::invocations(std::initializer_list<std::size_t> sizes) {
    std::size_t count = 1;
    for (const std::size_t size : sizes) {
        if (size == 0) throw std::logic_error("an argument without elements");
        if (size != 1 && count != 1 && size != count) {
            throw std::logic_error(fmt::format("arguments of different sizes, {} and {}", count, size));
        }
        if (size != 1) count = size;
    }
    return count;
}

std::string ShaderLibrary::kernel(std::string_view statements, const std::vector<Array>& arguments,
                                  const Array& result) const {
    std::string glsl = kernelHeader();
    glsl += fmt::format("layout(local_size_x = {}) in;\n", shared::kTestWorkgroup) + code_;
    std::set<std::string_view> declared;
    const auto declare = [&](const Array& array) {
        if (!array.fields.empty() && declared.insert(array.type).second) {
            glsl += fmt::format("struct {} {{ {} }};\n", array.type, array.fields);
        }
    };
    std::string values;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const Array& a = arguments[i];
        declare(a);
        glsl += fmt::format(
            "layout(binding = {0}, scalar) readonly buffer Argument{0} {{ {1} argument{0}[]; }};\n", i,
            a.type);
        const bool one = a.bytes.size() == a.itemSize;
        values += fmt::format("    {0} x{1} = argument{1}[{2}];\n", a.type, i, one ? "0" : "invocation_");
    }
    declare(result);
    std::size_t binding = arguments.size();
    glsl += fmt::format("layout(binding = {}, scalar) writeonly buffer Results {{ {} results_[]; }};\n",
                        binding, result.type);
    for (const auto& [function, bytes] : texels_) {
        ++binding;
        glsl += fmt::format(
            "layout(binding = {0}, rgba32ui) uniform readonly uimageBuffer texels{0};\n"
            "uvec4 {1}(uint index) {{ return imageLoad(texels{0}, int(index)); }}\n",
            binding, function);
    }
    glsl += fmt::format(
        "layout(push_constant, scalar) uniform Push {{ uint count_; }};\n"
        "void main() {{\n    uint invocation_ = gl_GlobalInvocationID.x;\n    if (invocation_ >= count_) "
        "return;\n{}"
        "    {} result;\n    {}\n    results_[invocation_] = result;\n}}\n",
        values, result.type, statements);
    return glsl;
}

void ShaderLibrary::run(std::string_view statements, const std::vector<Array>& arguments, const Array& result,
                        std::span<std::byte> results) const {
    const std::string glsl = kernel(statements, arguments, result);
    const std::vector<std::uint32_t>* spirv = nullptr;
    try {
        spirv = &compiled(glsl);
    } catch (const CompileError& e) {
        throw CompileError(fmt::format("in a call of the host, {}\n{}of the kernel\n{}", statements, e.what(),
                                       numbered(glsl)));
    }
    std::vector<Specialization> constants;
    for (const auto& [id, value] : constants_)
        constants.push_back({id, value});
    std::vector<Buffer> texels;
    for (const auto& [function, bytes] : texels_)
        texels.push_back(Buffer::upload(device(), BufferUse::kTexels, bytes, function));
    const std::size_t total = results.size() / result.itemSize;
    std::size_t largest = result.itemSize;
    for (const Array& a : arguments)
        largest = std::max(largest, a.itemSize);
    const std::size_t most = std::min<std::size_t>(
        kInvocationsPerDispatch, std::max<std::size_t>(device().info().maxStorageBufferRange / largest, 1));
    for (std::size_t first = 0; first < total; first += most) {
        const std::size_t count = std::min(most, total - first);
        std::vector<Buffer> inputs;
        for (const Array& a : arguments) {
            const bool one = a.bytes.size() == a.itemSize;
            const auto part = one ? a.bytes : a.bytes.subspan(first * a.itemSize, count * a.itemSize);
            inputs.push_back(Buffer::upload(device(), BufferUse::kStorage, part, "arguments"));
        }
        const Buffer output = Buffer::readback(device(), count * result.itemSize, "results");
        std::vector<Binding> bindings;
        for (const Buffer& b : inputs)
            bindings.push_back({static_cast<std::uint32_t>(bindings.size()), &b});
        bindings.push_back({static_cast<std::uint32_t>(bindings.size()), &output});
        for (const Buffer& b : texels)
            bindings.push_back({static_cast<std::uint32_t>(bindings.size()), &b});
        const Kernel kernel = harnessKernel(statements, *spirv, bindings, constants, sizeof(std::uint32_t));
        runOnce(device(), statements, [&](const Commands& commands) {
            const auto push = static_cast<std::uint32_t>(count);
            kernel.dispatch(commands, push, (push + shared::kTestWorkgroup - 1) / shared::kTestWorkgroup);
        });
        output.invalidate();
        std::memcpy(results.data() + first * result.itemSize, output.mapped(), count * result.itemSize);
    }
}

}  // namespace duolux::test
