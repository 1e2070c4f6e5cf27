// Changes the shader library in small plausible ways, one at a time, and asks the shader tests about each.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/base/temporary_folder.h"
#include "tests/shader/harness/source_text.h"
#include "tests/support/run_program.h"

namespace {

using namespace duolux;

/// A line of the list: FILE | OLD => NEW | WHY, and for one that no test can catch: | equivalent: REASON.
struct Mutation {
    std::size_t line = 0;
    std::string file, before, after, why, equivalent;
    std::string caughtBy;  ///< the first test that failed; empty: it survived
    bool compiles = true;
    std::string crash;  ///< how the tests ended instead of failing
};

std::string trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return "";
    return std::string(text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin));
}

/// The fields of a line; the change itself may have " | " in it. Nothing if it is not a mutation.
std::optional<Mutation> parse(const std::string& text) {
    static const std::regex kLine(R"((\S+) \| (.*?) => (.*?) \| ([^|]*?)( \| equivalent: ([^|]+))?)");
    std::smatch m;
    if (!std::regex_match(text, m, kLine)) return std::nullopt;
    return Mutation{0, m[1], trimmed(m[2].str()), trimmed(m[3].str()), m[4], m[6], "", true, ""};
}

/// The file with the mutation in it. Throws InputError unless what is to be replaced is there exactly once.
std::string mutate(const std::string& list, const Mutation& m, const std::filesystem::path& shaders) {
    std::string text = readFile(shaders / m.file);
    const std::size_t at = text.find(m.before);
    const std::string place = fmt::format("line {}", m.line);
    if (at == std::string::npos) {
        throw InputError(list, place, fmt::format("{} has no \"{}\"", m.file, m.before),
                         "expected text of that file");
    }
    if (text.find(m.before, at + 1) != std::string::npos) {
        throw InputError(list, place, fmt::format("{} has \"{}\" more than once", m.file, m.before),
                         "expected a longer text");
    }
    return text.replace(at, m.before.size(), m.after);
}

std::vector<Mutation> readList(const std::string& list, const std::filesystem::path& shaders) {
    std::istringstream lines(readFile(list));
    std::vector<Mutation> mutations;
    std::map<std::string, std::size_t> seen;
    std::size_t number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        if (trimmed(line).empty() || line[0] == '#') continue;
        std::optional<Mutation> mutation = parse(trimmed(line));
        if (!mutation) {
            throw InputError(list, fmt::format("line {}", number), "not a mutation",
                             "expected FILE | OLD => NEW | WHY [| equivalent: REASON]");
        }
        if (mutation->before == mutation->after) {
            throw InputError(list, fmt::format("line {}", number), "changes nothing",
                             "expected NEW to differ from OLD");
        }
        mutation->line = number;
        mutations.push_back(std::move(*mutation));
        const std::string text = mutate(list, mutations.back(), shaders);
        if (const auto [same, isNew] = seen.emplace(mutations.back().file + "\n" + text, number); !isNew) {
            throw InputError(list, fmt::format("line {}", number),
                             fmt::format("makes the same as line {}", same->second),
                             "expected each mutation once");
        }
    }
    return mutations;
}

/// Runs the tests with these sources, and notes in the mutation what comes of it.
void runTests(const std::string& tests, const std::filesystem::path& sources, const std::string& filter,
              Mutation& m) {
    const test::ProgramResult result = test::runProgram(
        tests, sources, {"--sources", sources.string(), "--gtest_brief=1", "--gtest_filter=" + filter},
        std::nullopt, std::chrono::seconds(300));
    if (result.status == 0) return;
    // A mutation that is no program is no test of the tests.
    m.compiles = result.out.find("ERROR: ") == std::string::npos;
    const std::string mark = "[  FAILED  ] ";
    const std::size_t at = result.out.find(mark);
    if (at == std::string::npos) {
        // Nothing has the name of this file: the whole suite will tell.
        if (result.err.find("no test's name matches") == std::string::npos) {
            m.crash = fmt::format("exit status {}", result.status);
        }
        return;
    }
    const std::size_t begin = at + mark.size();
    m.caughtBy = result.out.substr(begin, result.out.find_first_of(" ,\n", begin) - begin);
}

std::string verdict(const Mutation& m) {
    if (!m.compiles) return "DOES NOT COMPILE";
    if (!m.crash.empty()) return "ENDED THE TESTS, " + m.crash;
    if (!m.caughtBy.empty()) return "caught by " + m.caughtBy;
    return m.equivalent.empty() ? "SURVIVED" : "equivalent: " + m.equivalent;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Mutation score of the shader tests. Tests named *Oracles* are left out: they share the library's "
        "source.");
    std::string list = DUOLUX_MUTATIONS;
    std::string tests = DUOLUX_SHADER_TEST;
    std::string only;
    double goal = 95.0;
    app.add_option("--list", list, "the mutations")->capture_default_str();
    app.add_option("--only", only, "only those of files whose name contains this");
    app.add_option("--goal", goal, "per cent to be caught; fewer: exit status 1")->capture_default_str();
    bool check = false;
    app.add_flag("--check", check, "only check that the list fits the library");
    CLI11_PARSE(app, argc, argv);
    try {
        const std::filesystem::path shaders = std::filesystem::path(DUOLUX_SOURCE_ROOT) / "shaders";
        std::vector<Mutation> mutations = readList(list, shaders);
        if (check) return 0;
        std::erase_if(mutations, [&](const Mutation& m) { return m.file.find(only) == std::string::npos; });
        if (mutations.empty())
            throw UsageError(fmt::format("no mutation of a file whose name contains \"{}\"", only));
        const std::string listName = std::filesystem::proximate(list).string();
        setenv("GTEST_FAIL_FAST", "1", 1);
        const std::string oracles = "-*Oracles*:Harness*:Coverage*:TestDevice*";
        Mutation none;
        runTests(tests, shaders, "*" + oracles, none);
        if (!none.caughtBy.empty())
            throw MachineError(fmt::format("without any mutation {} fails already", none.caughtBy));
        std::atomic<std::size_t> next{0};
        std::mutex printing;
        std::exception_ptr failure;
        const auto work = [&] {
            try {
                for (std::size_t i = next++; i < mutations.size(); i = next++) {
                    Mutation& m = mutations[i];
                    const TemporaryFolder folder;
                    const std::filesystem::path file = folder.path() / "shaders" / m.file;
                    std::filesystem::create_directories(file.parent_path());
                    writeFile(file, mutate(list, m, shaders));
                    // Most are caught by tests of the file's own name.
                    const std::string suites =
                        test::pascalCase(std::filesystem::path(m.file).stem().string()) + "*";
                    runTests(tests, folder.path(), suites + oracles, m);
                    if (m.caughtBy.empty() && m.crash.empty())
                        runTests(tests, folder.path(), "*" + oracles, m);
                    const std::lock_guard lock(printing);
                    fmt::print("{}:{}: {}: {} => {} ({}): {}\n", listName, m.line, m.file, m.before, m.after,
                               m.why, verdict(m));
                    std::fflush(stdout);
                }
            } catch (...) {
                const std::lock_guard lock(printing);
                failure = std::current_exception();
                next = mutations.size();
            }
        };
        std::vector<std::thread> threads;
        for (unsigned t = 0; t < std::max(1u, std::thread::hardware_concurrency()); ++t)
            threads.emplace_back(work);
        for (std::thread& thread : threads)
            thread.join();
        if (failure) std::rethrow_exception(failure);
        std::size_t caught = 0, equivalent = 0, broken = 0;
        for (const Mutation& m : mutations) {
            broken += m.compiles ? 0 : 1;
            caught += m.compiles && !m.caughtBy.empty() ? 1 : 0;
            equivalent += m.caughtBy.empty() && m.crash.empty() && !m.equivalent.empty() ? 1 : 0;
            if (!m.compiles || !m.crash.empty() || (m.caughtBy.empty() && m.equivalent.empty())) {
                fmt::print("{}:{}: {} => {}: {}\n", listName, m.line, m.before, m.after, verdict(m));
            }
        }
        const std::size_t counted = mutations.size() - equivalent - broken;
        const double score =
            counted > 0 ? 100.0 * static_cast<double>(caught) / static_cast<double>(counted) : 0.0;
        fmt::print(
            "{} of {} mutations caught: {:.1f} % (goal {} %); {} more are equivalent, {} do not compile\n",
            caught, counted, score, goal, equivalent, broken);
        return score >= goal && broken == 0 ? 0 : 1;
    } catch (const Error& e) {
        fmt::print(stderr, "mutation_score: {}\n", e.what());
        return static_cast<int>(e.status());
    } catch (const std::exception& e) {
        fmt::print(stderr, "mutation_score: {}\n", e.what());
        return 1;
    }
}
