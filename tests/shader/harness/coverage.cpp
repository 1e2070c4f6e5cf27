#include "tests/shader/harness/coverage.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <numeric>
#include <regex>
#include <set>
#include <tuple>

#include "host/base/file.h"
#include "host/cli/temporary_folder.h"
#include "tests/shader/harness/compiler.h"
#include "tests/shader/harness/kernel_run.h"
#include "tests/shader/harness/source_text.h"

namespace duolux::test {

namespace {

struct Insertion {
    std::size_t at;
    std::string text;
};

/// The start of the condition of the `?` at `question`: after the nearest token to its left with a lower
/// precedence than the operators of a condition.
std::size_t conditionBegin(std::string_view code, std::size_t question) {
    int depth = 0;
    std::size_t i = question;
    while (i > 0) {
        const char c = code[i - 1];
        if (c == ')' || c == ']') ++depth;
        if ((c == '(' || c == '[') && depth-- == 0) break;
        if (depth == 0) {
            if (c == ',' || c == ';' || c == '{' || c == '}' || c == '?' || c == ':') break;
            const char before = i > 1 ? code[i - 2] : ' ';
            const bool comparison =
                code[i] == '=' || before == '=' || before == '<' || before == '>' || before == '!';
            if (c == '=' && !comparison) break;
            if (c == 'n' && i >= 6 && code.substr(i - 6, 6) == "return" && !isWordCharacter(code[i])) break;
        }
        --i;
    }
    while (code[i] == ' ' || code[i] == '\n')
        ++i;
    return i;
}

class Instrumenter {
  public:
    Instrumenter(std::string_view file, std::string_view text, std::vector<CoveragePoint>& points)
        : file_(file), text_(text), code_(blankComments(text)), points_(points) {}

    std::string run() {
        functions();
        statements();
        ternaries();
        // Of two that begin at the same position, the first found is the outer one; ends precede beginnings.
        std::stable_sort(insertions_.begin(), insertions_.end(),
                         [](const Insertion& a, const Insertion& b) { return a.at < b.at; });
        std::string out;
        std::size_t done = 0;
        for (const Insertion& insertion : insertions_) {
            out += text_.substr(done, insertion.at - done);
            out += insertion.text;
            done = insertion.at;
        }
        return out + std::string(text_.substr(done));
    }

  private:
    std::size_t add(std::size_t at, std::string text, bool isCondition) {
        points_.push_back({file_, lineAt(code_, at), collapseSpaces(text), isCondition});
        return points_.size() - 1;
    }

    void wrap(std::size_t begin, std::size_t end) {
        while (end > begin && (code_[end - 1] == ' ' || code_[end - 1] == '\n'))
            --end;
        const std::size_t id = add(begin, code_.substr(begin, end - begin), true);
        insertions_.push_back({begin, fmt::format("coverCondition_({}u, ", id)});
        insertions_.push_back({end, ")"});
    }

    void functions() {
        static const std::regex kFunction(R"((?:^|\n)(?!struct )(?:[\w\[\]]+ )+(\w+)\([^;{}]*\)\s*\{)");
        for (std::sregex_iterator i(code_.begin(), code_.end(), kFunction), end; i != end; ++i) {
            const auto name = static_cast<std::size_t>(i->position(1));
            const auto brace = static_cast<std::size_t>(i->position() + i->length());
            const std::size_t id = add(name, (*i)[1], false);
            insertions_.push_back({brace, fmt::format(" coverFunction_({}u);", id)});
        }
    }

    void statements() {
        static const std::regex kStatement(R"(\b(if|while|for) ?\()");
        for (std::sregex_iterator i(code_.begin(), code_.end(), kStatement), end; i != end; ++i) {
            std::size_t begin = static_cast<std::size_t>(i->position() + i->length());
            std::size_t finish = closingBracket(code_, begin - 1);
            if ((*i)[1] == "for") {
                begin = code_.find(';', begin) + 1;
                finish = code_.find(';', begin);
            }
            while (begin < finish && std::isspace(static_cast<unsigned char>(code_[begin])) != 0)
                ++begin;
            if (begin < finish) wrap(begin, finish);  // the condition of for (;;) is empty
        }
    }

    void ternaries() {
        // Outside functions there are only constants, which cannot be instrumented.
        int depth = 0;
        for (std::size_t i = 0; i < code_.size(); ++i) {
            depth += code_[i] == '{' ? 1 : code_[i] == '}' ? -1 : 0;
            if (code_[i] == '?' && depth > 0) wrap(conditionBegin(code_, i), i);
        }
    }

    std::string file_;
    std::string_view text_;
    std::string code_;
    std::vector<CoveragePoint>& points_;
    std::vector<Insertion> insertions_;
};

/// Owns the measurements and writes the report after all tests.
class Coverage : public testing::Environment {
  public:
    Coverage(const std::filesystem::path& folder, std::filesystem::path report) : report_(std::move(report)) {
        writeFile(report_, "");  // fails now rather than after all tests
        std::set<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(projectRoot() / folder)) {
            if (entry.path().extension() == ".glsl")
                names.insert((folder / entry.path().filename()).string());
        }
        for (const std::string& name : names) {
            std::filesystem::create_directories((copies_ / name).parent_path());
            writeFile(copies_ / name, instrument(name, readSource(name), points_));
        }
        sourceRoots().insert(sourceRoots().begin(), copies_.path());
        coverageWords() = 2 * points_.size();
    }
    void TearDown() override {
        writeFile(report_, coverageReport(points_, takeCoverage()));
        fmt::print("{}: what the tests have reached of the library\n", report_.string());
    }

  private:
    TemporaryFolder copies_;
    std::filesystem::path report_;
    std::vector<CoveragePoint> points_;
};

}  // namespace

std::string instrument(std::string_view file, std::string_view text, std::vector<CoveragePoint>& points) {
    return Instrumenter(file, text, points).run();
}

void measureCoverage(const std::filesystem::path& folder, const std::filesystem::path& report) {
    testing::AddGlobalTestEnvironment(new Coverage(folder, report));  // GoogleTest owns it
}

std::string coverageReport(const std::vector<CoveragePoint>& points,
                           const std::vector<std::uint32_t>& reached) {
    struct Count {
        int functions = 0, functionsReached = 0, outcomes = 0, outcomesReached = 0;
    };
    std::map<std::string, Count> files;
    std::string missing;
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::tie(points[a].file, points[a].line) < std::tie(points[b].file, points[b].line);
    });
    // For a file that was never reached, the table is sufficient.
    std::set<std::string> reachedFiles;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (reached.at(2 * i) != 0 || reached.at(2 * i + 1) != 0) reachedFiles.insert(points[i].file);
    }
    for (const std::size_t i : order) {
        const CoveragePoint& point = points[i];
        const bool first = reached.at(2 * i) != 0;
        const bool second = reached.at(2 * i + 1) != 0;
        Count& count = files[point.file];
        const auto miss = [&](std::string_view what) {
            if (reachedFiles.contains(point.file))
                missing += fmt::format("{}:{}: {} {}\n", point.file, point.line, point.text, what);
        };
        if (point.isCondition) {
            count.outcomes += 2;
            count.outcomesReached += (first ? 1 : 0) + (second ? 1 : 0);
            if (!first) miss("is never false");
            if (!second) miss("is never true");
        } else {
            count.functions += 1;
            count.functionsReached += first ? 1 : 0;
            if (!first) miss("is never called");
        }
    }
    std::string table = fmt::format("{:<34} {:>13} {:>13}\n", "file", "functions", "outcomes");
    Count all;
    const auto row = [&](std::string_view name, const Count& c) {
        table += fmt::format("{:<34} {:>5} of {:>4} {:>5} of {:>4}\n", name, c.functionsReached, c.functions,
                             c.outcomesReached, c.outcomes);
    };
    for (const auto& [name, count] : files) {
        row(name, count);
        all.functions += count.functions;
        all.functionsReached += count.functionsReached;
        all.outcomes += count.outcomes;
        all.outcomesReached += count.outcomesReached;
    }
    row("all", all);
    return table + (missing.empty() ? "" : "\n" + missing);
}

}  // namespace duolux::test
