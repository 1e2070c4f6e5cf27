#include "host/scene/source_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/scene/file_kind.h"

namespace duolux {

namespace {

bool isBlank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/// Lone carriage returns end a line on old systems.
void endLinesByNewline(std::string& bytes) {
    char* const end = bytes.data() + bytes.size();
    for (char* at = bytes.data(); at != end; ++at) {
        at = static_cast<char*>(std::memchr(at, '\r', static_cast<std::size_t>(end - at)));
        if (at == nullptr) return;
        if (at + 1 == end || at[1] != '\n') *at = '\n';
    }
}

bool isInComment(std::string_view bytes, std::size_t at) {
    const std::size_t before = bytes.substr(0, at).rfind('\n');
    const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
    return trimmed(bytes.substr(begin, at - begin)).starts_with('#');
}

std::vector<std::size_t> joinContinuedLines(std::string& bytes) {
    std::vector<std::size_t> joins;
    for (std::size_t at = bytes.find('\\'); at != std::string::npos; at = bytes.find('\\', at + 1)) {
        std::size_t lineEnd = at + 1;
        if (lineEnd < bytes.size() && bytes[lineEnd] == '\r') ++lineEnd;
        if (lineEnd >= bytes.size() || bytes[lineEnd] != '\n' || isInComment(bytes, at)) continue;
        std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                  bytes.begin() + static_cast<std::ptrdiff_t>(lineEnd) + 1, ' ');
        joins.push_back(lineEnd);
    }
    return joins;
}

}  // namespace

SourceText::SourceText(const std::filesystem::path& path, std::string_view expected)
    : path_(path), bytes_(readFile(path)) {
    expectNoForeignFormat(path, bytes_, expected);
    while (!bytes_.empty() && bytes_.back() == '\0')
        bytes_.pop_back();
    if (bytes_.starts_with("\xEF\xBB\xBF")) bytes_.replace(0, 3, 3, ' ');
    if (!bytes_.empty()) {
        if (const void* zero = std::memchr(bytes_.data(), 0, bytes_.size())) {
            const auto offset = static_cast<std::size_t>(static_cast<const char*>(zero) - bytes_.data());
            fail({offset, "holds a zero byte", "expected a text file"});
        }
    }
    endLinesByNewline(bytes_);
    joins_ = joinContinuedLines(bytes_);
    if (bytes_.empty() || bytes_.back() != '\n') bytes_.push_back('\n');
}

std::size_t SourceText::lineOf(std::size_t offset) const {
    const auto ends = std::count(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(offset), '\n');
    const auto joined = std::lower_bound(joins_.begin(), joins_.end(), offset) - joins_.begin();
    return 1 + static_cast<std::size_t>(ends + joined);
}

void SourceText::fail(const TextProblem& problem) const {
    throw InputError(file(), fmt::format("line {}", lineOf(problem.offset)), problem.problem, problem.remedy);
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && isBlank(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && isBlank(text.back()))
        text.remove_suffix(1);
    return text;
}

std::string_view firstWord(std::string_view text) {
    const auto end = std::find_if(text.begin(), text.end(), isBlank);
    return text.substr(0, static_cast<std::size_t>(end - text.begin()));
}

ReadNumber readNumber(const char* at, const char* end) {
    const char* first = at;
    if (first != end && *first == '+') {
        ++first;
        if (first != end && *first == '-') return {nullptr, 0.0};
    }
    double value = 0.0;
    const auto [past, error] = std::from_chars(first, end, value);
    if (error == std::errc::invalid_argument) return {nullptr, 0.0};
    // Too large or too small: infinite or nearly zero.
    if (error == std::errc::result_out_of_range)
        value = std::strtod(std::string(first, past).c_str(), nullptr);
    if (past == end || *past != '#') return {past, value};
    const char* word = past;  // as in 1.#IND, which Microsoft's library wrote
    while (word != end && !isBlank(*word))
        ++word;
    return {word, std::numeric_limits<double>::quiet_NaN()};
}

}  // namespace duolux
