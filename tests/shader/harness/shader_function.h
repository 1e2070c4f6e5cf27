#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <initializer_list>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace duolux::test {

/// The GLSL name of a C++ type; `fields`: the fields of a structure that the kernel must declare, otherwise
/// empty. With scalar block layout, members of 4 bytes, or vectors of these, have the same offsets as in C++.
/// Buffers have no bool: pass uint.
template <typename T>
struct GlslType;

// NOLINTBEGIN(bugprone-macro-parentheses)
#define DUOLUX_GLSL_TYPE(Type, glslName, glslFields)           \
    template <>                                                \
    struct duolux::test::GlslType<Type> {                      \
        static constexpr std::string_view name = glslName;     \
        static constexpr std::string_view fields = glslFields; \
    }
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace duolux::test

DUOLUX_GLSL_TYPE(float, "float", "");
DUOLUX_GLSL_TYPE(std::int32_t, "int", "");
DUOLUX_GLSL_TYPE(std::uint32_t, "uint", "");
DUOLUX_GLSL_TYPE(glm::vec2, "vec2", "");
DUOLUX_GLSL_TYPE(glm::vec3, "vec3", "");
DUOLUX_GLSL_TYPE(glm::vec4, "vec4", "");
DUOLUX_GLSL_TYPE(glm::ivec2, "ivec2", "");
DUOLUX_GLSL_TYPE(glm::ivec3, "ivec3", "");
DUOLUX_GLSL_TYPE(glm::ivec4, "ivec4", "");
DUOLUX_GLSL_TYPE(glm::uvec2, "uvec2", "");
DUOLUX_GLSL_TYPE(glm::uvec3, "uvec3", "");
DUOLUX_GLSL_TYPE(glm::uvec4, "uvec4", "");

namespace duolux::test {

/// Functions of a GLSL library, called from the host for many inputs at once: a kernel is generated, compiled
/// and run on device().
///
///     const ShaderLibrary warp("shaders/lib/warp.glsl");
///     std::vector<glm::vec3> w = warp.call<glm::vec3>("cosineHemisphere", us);  // us:
///     std::vector<glm::vec2>
///
/// An argument is a std::vector with one element for each invocation, or a single value for all. If a
/// function name is not sufficient (out parameters, a part of the result), evaluate() takes statements that
/// use x0, x1, ... and set `result`. Throws CompileError if they do not compile, MachineError if the device
/// fails.
class ShaderLibrary {
  public:
    /// `file`: as in #include; "" for none.
    explicit ShaderLibrary(std::string_view file) { code_ = include(file); }
    ShaderLibrary(std::initializer_list<std::string_view> files) {
        for (const std::string_view file : files)
            code_ += include(file);
    }

    /// Adds GLSL after the library: functions that the library requires from kernels.
    ShaderLibrary& define(std::string_view glsl) {
        code_ += std::string(glsl) + "\n";
        return *this;
    }

    /// Defines `uvec4 function(uint index)` to fetch from these bytes, as kernels do from texel buffers.
    template <typename T>
    ShaderLibrary& texels(std::string_view function, std::span<const T> items) {
        return texels(function, std::as_bytes(items));
    }
    ShaderLibrary& texels(std::string_view function, std::span<const std::byte> bytes);

    /// Sets a specialisation constant of the library.
    ShaderLibrary& constant(std::uint32_t id, std::uint32_t value) {
        constants_[id] = value;
        return *this;
    }

    template <typename Result, typename... Arguments>
    std::vector<Result> call(std::string_view function, const Arguments&... arguments) const {
        std::string names;
        for (std::size_t i = 0; i < sizeof...(arguments); ++i)
            names += (i > 0 ? ", x" : "x") + std::to_string(i);
        return evaluate<Result>("result = " + std::string(function) + "(" + names + ");", arguments...);
    }

    template <typename Result, typename... Arguments>
    std::vector<Result> evaluate(std::string_view statements, const Arguments&... arguments) const {
        std::vector<Result> results(invocations({sizeOf(arguments)...}));
        run(statements, {argument(arguments)...},
            {GlslType<Result>::name, GlslType<Result>::fields, sizeof(Result), {}},
            std::as_writable_bytes(std::span(results)));
        return results;
    }

  private:
    struct Array {
        std::string_view type, fields;
        std::size_t itemSize;
        std::span<const std::byte> bytes;
    };

    template <typename T>
    static std::size_t sizeOf(const std::vector<T>& items) {
        return items.size();
    }
    template <typename T>
    static std::size_t sizeOf(const T&) {
        return 1;
    }
    template <typename T>
    static Array argument(const std::vector<T>& items) {
        return {GlslType<T>::name, GlslType<T>::fields, sizeof(T), std::as_bytes(std::span(items))};
    }
    template <typename T>
    static Array argument(const T& item) {
        return {GlslType<T>::name, GlslType<T>::fields, sizeof(T), std::as_bytes(std::span(&item, 1))};
    }

    static std::string include(std::string_view file) {
        return file.empty() ? "" : "#include \"" + std::string(file) + "\"\n";
    }
    /// The common size of all arrays; arrays of size 1 are used for all invocations.
    static std::size_t invocations(std::initializer_list<std::size_t> sizes);
    void run(std::string_view statements, const std::vector<Array>& arguments, const Array& result,
             std::span<std::byte> results) const;
    std::string kernel(std::string_view statements, const std::vector<Array>& arguments,
                       const Array& result) const;

    std::string code_;
    std::vector<std::pair<std::string, std::vector<std::byte>>> texels_;
    std::map<std::uint32_t, std::uint32_t> constants_;
};

}  // namespace duolux::test
