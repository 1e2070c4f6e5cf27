#include "tests/shader/harness/glsl_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>
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

namespace {

const std::regex& expectationPattern() {
    static const std::regex pattern(R"(\bEXPECT_\w+\s*\()");
    return pattern;
}

/// The positions of EXPECT_... and NOTE calls. Two calls on one line have the same position.
std::vector<GlslFile::Site> findSites(std::string_view file, const std::string& code,
                                      const std::regex& pattern) {
    std::vector<GlslFile::Site> sites;
    for (const std::cmatch& m : allMatches(code, pattern)) {
        const auto begin = static_cast<std::size_t>(m.position());
        const std::size_t end = closingBracket(code, begin + static_cast<std::size_t>(m.length()) - 1);
        const std::size_t line = lineAt(code, begin);
        if (end == std::string::npos) fail(file, line, "this has no closing parenthesis");
        if (!sites.empty() && sites.back().lastLine >= line) {
            fail(file, line, "two expectations, or notes, on one line cannot be told apart");
        }
        sites.push_back({line, lineAt(code, end), collapseSpaces(code.substr(begin, end + 1 - begin))});
    }
    return sites;
}

/// Only line numbers distinguish expectations, so those of included files would be mistaken for this file's.
void refuseExpectationsInIncludes(const std::string& code, std::set<std::string>& seen) {
    static const std::regex kInclude("(?:^|\\n)\\s*#\\s*include\\s*\"([^\"]+)\"");
    for (const std::cmatch& m : allMatches(code, kInclude)) {
        const std::string name = m[1];
        if (!seen.insert(name).second) continue;
        std::string included;
        try {
            included = blankComments(readSource(name));
        } catch (const std::runtime_error&) {
            continue;  // the compiler reports the missing file
        }
        for (const std::cmatch& e : allMatches(included, expectationPattern())) {
            fail(name, lineAt(included, static_cast<std::size_t>(e.position())),
                 "an expectation in an included file; it belongs in the test file itself");
        }
        refuseExpectationsInIncludes(included, seen);
    }
}

}  // namespace

GlslFile parseGlslFile(std::string_view name, std::string_view text) {
    static const std::regex kAnyTest(R"(\bTEST(_N)?\s*\()");
    static const std::regex kTest(R"(TEST(_N)?\s*\(\s*(\w+)\s*(?:,\s*(\d{1,9})u?\s*)?\)\s*\{)");
    static const std::regex kNote(R"(\bNOTE\s*\()");
    const std::string code = blankComments(text);
    GlslFile file;
    file.name = name;
    file.lines = lineAt(code, code.size());
    std::istringstream lines{std::string(text)};
    for (std::string line; std::getline(lines, line);)
        file.source.push_back(line);
    for (const std::cmatch& any : allMatches(code, kAnyTest)) {
        const auto begin = static_cast<std::size_t>(any.position());
        const std::size_t line = lineAt(code, begin);
        std::cmatch m;
        const bool understood = std::regex_search(code.data() + begin, code.data() + code.size(), m, kTest,
                                                  std::regex_constants::match_continuous);
        if (!understood || m[1].matched != m[3].matched) {
            fail(name, line,
                 "expected TEST(name) { or TEST_N(name, invocations) {, invocations being up to nine digits");
        }
        const std::size_t end = closingBracket(code, begin + static_cast<std::size_t>(m.length()) - 1);
        if (end == std::string::npos) fail(name, line, "the test's body has no end");
        const std::uint32_t count =
            m[3].matched ? static_cast<std::uint32_t>(std::stoul(m[3])) : kDefaultInvocations;
        if (count == 0) fail(name, line, "a test needs at least one invocation");
        file.tests.push_back({m[2], line, lineAt(code, end), count});
    }
    if (file.tests.empty()) fail(name, 1, "there is no TEST(name) in this file");
    file.sites = findSites(name, code, expectationPattern());
    file.notes = findSites(name, code, kNote);
    for (const GlslFile::Site& note : file.notes) {
        if (file.siteAt(note.firstLine) != nullptr || file.siteAt(note.lastLine) != nullptr) {
            fail(name, note.firstLine, "two expectations, or notes, on one line cannot be told apart");
        }
    }
    std::set<std::string> seen;
    refuseExpectationsInIncludes(code, seen);
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
