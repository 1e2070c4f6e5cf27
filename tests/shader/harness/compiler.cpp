#include "tests/shader/harness/compiler.h"

#include <fmt/format.h>

#include <charconv>
#include <cstring>

#include "host/base/file.h"
#include "tests/shader/harness/kernel_run.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace duolux::test {

namespace {

/// The compiler's report without its empty lines and with names as they are included.
std::string readable(std::string report, const std::filesystem::path& scratch) {
    const auto replaceAll = [&](const std::string& from, const std::string& to) {
        for (std::size_t at = report.find(from); at != std::string::npos; at = report.find(from, at))
            report.replace(at, from.size(), to);
    };
    replaceAll(scratch.string() + "/", "");
    for (const std::filesystem::path& root : sourceRoots())
        replaceAll(root.string() + "/", "");
    replaceAll("\n\n", "\n");
    return report;
}

}  // namespace

std::vector<std::filesystem::path>& sourceRoots() {
    static std::vector<std::filesystem::path> roots{DUOLUX_SOURCE_ROOT, DUOLUX_HARNESS_ROOT};
    return roots;
}

std::filesystem::path projectRoot() {
    return DUOLUX_SOURCE_ROOT;
}

std::string readSource(std::string_view name) {
    for (const std::filesystem::path& root : sourceRoots()) {
        if (std::filesystem::is_regular_file(root / name)) return readFile(root / name);
    }
    throw std::runtime_error(fmt::format("there is no file {}", name));
}

std::size_t CompileError::lineIn(std::string_view file) const {
    const std::string_view report = what();
    const std::string start = fmt::format("{}:", file);
    for (std::size_t at = report.find(start); at != std::string_view::npos; at = report.find(start, at + 1)) {
        std::size_t line = 0;
        const char* digits = report.data() + at + start.size();
        if (std::from_chars(digits, report.data() + report.size(), line).ec == std::errc()) return line;
    }
    return 0;
}

std::vector<std::uint32_t> compileKernel(std::string_view glsl) {
    const TemporaryFolder scratch;
    const std::filesystem::path source = scratch / "kernel.comp";
    const std::filesystem::path output = scratch / "kernel.spv";
    writeFile(source, glsl);
    std::vector<std::string> arguments{"--quiet", "-V", "--target-env", "vulkan1.2"};
    for (const std::filesystem::path& root : sourceRoots())
        arguments.push_back("-I" + root.string());
    arguments.insert(arguments.end(), {"-o", output, source});
    const ProgramResult result = runProgram(DUOLUX_GLSLANG, scratch.path(), arguments);
    if (result.status != 0) throw CompileError(readable(result.out + result.err, scratch.path()));
    const std::string bytes = readFile(output);
    std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
    std::memcpy(words.data(), bytes.data(), words.size() * sizeof(std::uint32_t));
    return words;
}

std::string kernelHeader() {
    std::string header =
        "#version 460\n"
        "#extension GL_GOOGLE_include_directive : require\n"
        "#extension GL_EXT_scalar_block_layout : require\n";
    if (coverageWords() > 0) header += "#include \"tests/shader/harness/coverage.glsl\"\n";
    return header;
}

}  // namespace duolux::test
