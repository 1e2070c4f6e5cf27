#include "tests/shader/harness/compiler.h"

#include <fmt/format.h>

#include <cstring>
#include <regex>
#include <sstream>

#include "host/base/file.h"
#include "host/cli/temporary_folder.h"
#include "tests/shader/harness/kernel_run.h"
#include "tests/support/run_program.h"

namespace duolux::test {

namespace {

/// The compiler's report without empty lines, with file names as in #include.
std::string readable(std::string report, const std::filesystem::path& scratch,
                     const std::vector<std::filesystem::path>& roots) {
    const auto replaceAll = [&](const std::string& from, const std::string& to) {
        for (std::size_t at = report.find(from); at != std::string::npos; at = report.find(from, at))
            report.replace(at, from.size(), to);
    };
    replaceAll(scratch.string() + "/", "");
    for (const std::filesystem::path& root : roots)
        replaceAll(root.string() + "/", "");
    // Later messages only follow from the first errors.
    std::istringstream lines(report);
    std::string out;
    for (std::string line; std::getline(lines, line);) {
        const auto has = [&](std::string_view text) { return line.find(text) != std::string::npos; };
        if (line.empty() || has("Linking compute stage") || has("SPIR-V is not generated") ||
            has("No code generated") || (!out.empty() && has("ERROR: kernel.comp:")))
            continue;
        out += line + "\n";
    }
    return out;
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

CompileError::Place CompileError::place() const {
    static const std::regex kPlace(R"(ERROR: ([^:\n]+):(\d+):)");
    std::cmatch m;
    if (!std::regex_search(what(), m, kPlace)) return {};
    return {m[1], static_cast<std::size_t>(std::stoul(m[2]))};
}

std::vector<std::uint32_t> compileKernel(std::string_view glsl,
                                         const std::vector<std::filesystem::path>& roots) {
    const TemporaryFolder scratch;
    const std::filesystem::path source = scratch / "kernel.comp";
    const std::filesystem::path output = scratch / "kernel.spv";
    writeFile(source, glsl);
    std::vector<std::string> arguments{"--quiet", "-V", "--target-env", "vulkan1.2"};
    for (const std::filesystem::path& root : roots)
        arguments.push_back("-I" + root.string());
    arguments.insert(arguments.end(), {"-o", output, source});
    const ProgramResult result = runProgram(DUOLUX_GLSLANG, scratch.path(), arguments);
    if (result.status != 0) throw CompileError(readable(result.out + result.err, scratch.path(), roots));
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
