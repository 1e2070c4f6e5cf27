#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace duolux::test {

/// A test file: GLSL with TEST(name) { ... } blocks, see prelude.glsl.
struct GlslFile {
    /// One EXPECT_... or NOTE of the file, which may span lines.
    struct Site {
        std::size_t firstLine, lastLine;
        std::string text;
    };
    struct Test {
        std::string name;
        std::size_t line, lastLine;
        std::uint32_t count;  ///< invocations
    };

    std::string name;  ///< relative to a root of the source tree, as in #include
    std::size_t lines = 0;
    std::vector<Test> tests;
    std::vector<Site> sites;  ///< expectations
    std::vector<Site> notes;
    std::vector<std::string> source;  ///< its lines

    /// The expectation to which a line belongs, or nullptr.
    const Site* siteAt(std::size_t line) const;
};

/// Finds the tests and the expectations of a file. Throws std::runtime_error with file and line if the text
/// is invalid: no test, an unclosed bracket, two expectations on a line, an expectation in an included file.
GlslFile parseGlslFile(std::string_view name, std::string_view text);

/// The kernel with all tests of a file; the specialisation constant kSpecTest selects one.
std::string kernelOf(const GlslFile& file);

}  // namespace duolux::test
