#include "tests/mutation/mutation.h"

#include <fmt/format.h>

#include <cstdio>
#include <optional>
#include <regex>
#include <sstream>

#include "host/base/error.h"
#include "host/base/file.h"
#include "tests/shader/harness/source_text.h"

namespace duolux::test {

namespace {

std::string trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return "";
    return std::string(text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin));
}

/// The fields of a line; the change itself may contain " | ". Empty if the line is not a mutation.
std::optional<Mutation> parse(const std::string& text) {
    static const std::regex kLine(R"((\S+) \| (.*?) =>(.*?) \| ([^|]*?)( \| equivalent: ([^|]+))?)");
    std::smatch m;
    if (!std::regex_match(text, m, kLine)) return std::nullopt;
    return Mutation{0, m[1], trimmed(m[2].str()), trimmed(m[3].str()), m[4], m[6], "", true, ""};
}

std::string place(const Mutation& m) {
    return fmt::format("line {}", m.line);
}

std::string verdictOf(const Mutation& m) {
    if (!m.compiles) return "DOES NOT COMPILE";
    if (!m.crash.empty()) return "ENDED THE TESTS, " + m.crash;
    if (!m.caughtBy.empty()) return "caught by " + m.caughtBy;
    return m.equivalent.empty() ? "SURVIVED" : "equivalent: " + m.equivalent;
}

}  // namespace

std::string MutationList::firstTests(const Mutation& m) const {
    const auto found = first.find(m.file);
    if (found != first.end()) return found->second;
    return pascalCase(std::filesystem::path(m.file).stem().string()) + "*";
}

void MutationList::keepOnly(const std::string& part) {
    std::erase_if(mutations, [&](const Mutation& m) { return m.file.find(part) == std::string::npos; });
}

std::string mutated(const MutationList& list, const Mutation& m) {
    std::string text = readFile(list.root / m.file);
    const std::size_t at = text.find(m.before);
    if (at == std::string::npos) {
        throw InputError(list.name, place(m), fmt::format("{} has no \"{}\"", m.file, m.before),
                         "expected text of that file");
    }
    if (text.find(m.before, at + 1) != std::string::npos) {
        throw InputError(list.name, place(m), fmt::format("{} has \"{}\" more than once", m.file, m.before),
                         "expected a longer text");
    }
    return text.replace(at, m.before.size(), m.after);
}

MutationList readMutations(const std::filesystem::path& list, const std::filesystem::path& root) {
    static const std::regex kFirst(R"((\S+): (\S+))");
    MutationList out{std::filesystem::proximate(list).string(), root, {}, {}};
    std::istringstream lines(readFile(list));
    std::map<std::string, std::size_t> seen;
    std::size_t number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        line = trimmed(line);
        if (line.empty() || line[0] == '#') continue;
        const auto fail = [&](const std::string& problem, const char* expected) {
            throw InputError(out.name, fmt::format("line {}", number), problem, expected);
        };
        std::smatch words;
        if (std::regex_match(line, words, kFirst)) {
            if (!std::filesystem::is_regular_file(root / words[1].str()))
                fail(fmt::format("there is no {}", words[1].str()), "expected FILE: TESTS");
            out.first[words[1]] = words[2];
            continue;
        }
        std::optional<Mutation> mutation = parse(line);
        if (!mutation) fail("not a mutation", "expected FILE | OLD => NEW | WHY [| equivalent: REASON]");
        if (mutation->before == mutation->after) fail("changes nothing", "expected NEW to differ from OLD");
        mutation->line = number;
        const std::string text = mutated(out, *mutation);
        if (const auto [same, isNew] = seen.emplace(mutation->file + "\n" + text, number); !isNew)
            fail(fmt::format("makes the same as line {}", same->second), "expected each mutation once");
        out.mutations.push_back(std::move(*mutation));
    }
    return out;
}

void noteResult(const ProgramResult& result, Mutation& m) {
    if (result.status == 0) return;
    const std::string mark = "[  FAILED  ] ";
    const std::size_t at = result.out.find(mark);
    if (at == std::string::npos) {
        m.crash = fmt::format("exit status {}", result.status);
        return;
    }
    const std::size_t begin = at + mark.size();
    m.caughtBy = result.out.substr(begin, result.out.find_first_of(" ,\n", begin) - begin);
}

void printVerdict(const MutationList& list, const Mutation& m) {
    fmt::print("{}:{}: {}: {} => {} ({}): {}\n", list.name, m.line, m.file, m.before, m.after, m.why,
               verdictOf(m));
    std::fflush(stdout);
}

bool printScore(const MutationList& list, double goal) {
    std::size_t caught = 0, equivalent = 0, broken = 0;
    for (const Mutation& m : list.mutations) {
        broken += m.compiles ? 0 : 1;
        caught += m.compiles && !m.caughtBy.empty() ? 1 : 0;
        equivalent += !m.decided() && !m.equivalent.empty() ? 1 : 0;
        if (!m.compiles || !m.crash.empty() || (m.caughtBy.empty() && m.equivalent.empty())) {
            fmt::print("{}:{}: {} => {}: {}\n", list.name, m.line, m.before, m.after, verdictOf(m));
        }
    }
    const std::size_t counted = list.mutations.size() - equivalent - broken;
    const double score =
        counted > 0 ? 100.0 * static_cast<double>(caught) / static_cast<double>(counted) : 100.0;
    fmt::print(
        "{}: {} of {} mutations caught: {:.1f} % (goal {} %); {} more are equivalent, {} do not compile\n",
        list.name, caught, counted, score, goal, equivalent, broken);
    std::fflush(stdout);
    return score >= goal && broken == 0;
}

}  // namespace duolux::test
