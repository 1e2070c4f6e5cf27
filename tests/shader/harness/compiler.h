#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace duolux::test {

/// The folders in which `#include "NAME"` is searched, in this order. Initially the project's root and, if
/// different, the harness's root; folders inserted before them override files of the same name.
std::vector<std::filesystem::path>& sourceRoots();

/// Root of the project whose shaders are tested.
std::filesystem::path projectRoot();

/// The text of a file, named as in #include. Throws std::runtime_error if no root contains it.
std::string readSource(std::string_view name);

/// GLSL that does not compile. what() is the compiler's report, with lines "ERROR: FILE:LINE: ...".
class CompileError : public std::runtime_error {
  public:
    explicit CompileError(const std::string& report) : std::runtime_error(report) {}
    struct Place {
        std::string file;
        std::size_t line = 0;  ///< 0: the report gives none
    };
    /// Of the first error.
    Place place() const;
};

/// Compiles a compute kernel for Vulkan 1.2, with the compiler that builds the program; `roots`: as of
/// sourceRoots(), which other threads must not read. Throws CompileError. May be called from several threads.
std::vector<std::uint32_t> compileKernel(std::string_view glsl,
                                         const std::vector<std::filesystem::path>& roots = sourceRoots());

/// The first lines of every kernel: the version, the extensions that the harness needs and, if coverage is
/// measured, the functions that instrumented libraries call.
std::string kernelHeader();

}  // namespace duolux::test
