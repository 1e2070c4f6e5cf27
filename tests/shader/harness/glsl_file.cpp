#include "tests/shader/harness/glsl_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <stdexcept>

#include "tests/shader/harness/compiler.h"
#include "tests/shader/harness/source_text.h"

namespace duolux::test {

namespace {

constexpr std::uint32_t kDefaultInvocations = 4096;

[[noreturn]] void fail(std::string_view file, std::size_t line, std::string_view what) {
    throw std::runtime_error(fmt::format("{}:{}: {}", file, line, what));
}

using Matches = std::vector<std::cmatch>;

Matches allMatches(std::string_view text, const std::regex& pattern) {
    Matches out;
    for (std::cregex_iterator i(text.data(), text.data() + text.size(), pattern), end; i != end; ++i)
        out.push_back(*i);
    return out;
}

}  // namespace

const GlslFile::Site* GlslFile::siteAt(std::size_t line) const {
    for (const Site& site : sites) {
        if (site.firstLine <= line && line <= site.lastLine) return &site;
    }
    return nullptr;
}

GlslFile parseGlslFile(std::string_view name, std::string_view text) {
    static const std::regex kTest(R"(\bTEST(_N)?\s*\(\s*(\w+)\s*(?:,\s*(\d+)u?\s*)?\)\s*\{)");
    static const std::regex kExpectation(R"(\bEXPECT_\w+\s*\()");
    const std::string code = blankComments(text);
    GlslFile file;
    file.name = name;
    file.lines = lineAt(code, code.size());
    for (const std::cmatch& m : allMatches(code, kTest)) {
        const auto begin = static_cast<std::size_t>(m.position());
        const std::size_t line = lineAt(code, begin);
        if (m[1].matched != m[3].matched)
            fail(name, line, "expected TEST(name) or TEST_N(name, invocations)");
        const std::size_t end = closingBracket(code, begin + static_cast<std::size_t>(m.length()) - 1);
        if (end == std::string::npos) fail(name, line, "the test's body has no end");
        const std::uint32_t count =
            m[3].matched ? static_cast<std::uint32_t>(std::stoul(m[3])) : kDefaultInvocations;
        if (count == 0) fail(name, line, "a test needs at least one invocation");
        file.tests.push_back({m[2], line, lineAt(code, end), count});
    }
    if (file.tests.empty()) fail(name, 1, "there is no TEST(name) in this file");
    for (const std::cmatch& m : allMatches(code, kExpectation)) {
        const auto begin = static_cast<std::size_t>(m.position());
        const std::size_t end = closingBracket(code, begin + static_cast<std::size_t>(m.length()) - 1);
        const std::size_t line = lineAt(code, begin);
        if (end == std::string::npos) fail(name, line, "the expectation has no closing parenthesis");
        if (!file.sites.empty() && file.sites.back().lastLine >= line) {
            fail(name, line, "two expectations on one line cannot be told apart");
        }
        file.sites.push_back({line, lineAt(code, end), collapseSpaces(code.substr(begin, end + 1 - begin))});
    }
    return file;
}

std::string kernelOf(const GlslFile& file) {
    std::string glsl = fmt::format("{}#include \"tests/shader/harness/prelude.glsl\"\n#include \"{}\"\n",
                                   kernelHeader(), file.name);
    glsl +=
        "void main() {\n    if (testIndex() >= testCount()) return;\n"
        "    seedRandom(testDispatch.seed, testIndex());\n";
    for (std::size_t i = 0; i < file.tests.size(); ++i)
        glsl += fmt::format("    if (kTest == {}u) test_{}();\n", i, file.tests[i].name);
    return glsl + "}\n";
}

}  // namespace duolux::test
