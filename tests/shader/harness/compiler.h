#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace duolux::test {

/// Where `#include "NAME"` is looked for, in this order: NAME is relative to these folders. At first there
/// are the project's root and, if that is another, the harness's; what is put before them takes the place of
/// files of the same name.
std::vector<std::filesystem::path>& sourceRoots();

/// Root of the project whose shaders are tested.
std::filesystem::path projectRoot();

/// The text of a file that is named like an included one. Throws std::runtime_error if no root has it.
std::string readSource(std::string_view name);

/// GLSL that does not compile. what() is the compiler's report by lines, "ERROR: FILE:LINE: ...".
class CompileError : public std::runtime_error {
  public:
    explicit CompileError(const std::string& report) : std::runtime_error(report) {}
    struct Place {
        std::string file;
        std::size_t line = 0;  ///< 0: the report names none
    };
    /// Of the first error.
    Place place() const;
};

/// Compiles a compute kernel for Vulkan 1.2, with the compiler that builds the program; `roots`: as of
/// sourceRoots(), which other threads must not read. Throws CompileError. May be called from several threads.
std::vector<std::uint32_t> compileKernel(std::string_view glsl,
                                         const std::vector<std::filesystem::path>& roots = sourceRoots());

/// First lines of every kernel: the version, the extensions that the harness needs, and, where coverage is
/// measured, what instrumented libraries call.
std::string kernelHeader();

}  // namespace duolux::test
