#include "host/loaders/source_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/loaders/file_kind.h"

namespace duolux {

namespace {

bool isSpace(char c) {
    return isBlank(c) || isLineEnd(c);
}

/// On old systems, a carriage return alone ends a line.
void endLinesByNewline(std::string& bytes) {
    char* const end = bytes.data() + bytes.size();
    for (char* at = bytes.data(); at != end; ++at) {
        at = static_cast<char*>(std::memchr(at, '\r', static_cast<std::size_t>(end - at)));
        if (at == nullptr) return;
        if (at + 1 == end || at[1] != '\n') *at = '\n';
    }
}

/// Inspects the start of a line (after joining continued lines). Offsets must be ascending.
class LineStarts {
  public:
    explicit LineStarts(const std::string& bytes) : bytes_(bytes) {}

    /// Finds the line that contains an offset. Line ends that have been replaced by blanks are ignored.
    void moveTo(std::size_t offset) {
        const std::size_t end = std::string_view(bytes_).substr(seen_, offset - seen_).rfind('\n');
        const bool isNew = end != std::string_view::npos;
        if (isNew) begin_ = seen_ + end + 1;
        if (isNew || seen_ == 0) read();
        seen_ = offset;
    }

    bool inComment() const { return comment_; }
    /// Whether the line holds names, in which backslashes and unusual blanks are ordinary characters.
    bool holdsNames() const { return names_; }

  private:
    void read() {
        static constexpr std::array<std::string_view, 12> kNames{"g",      "o",      "usemtl", "newmtl",
                                                                 "mtllib", "usemap", "maplib", "bump",
                                                                 "disp",   "decal",  "refl",   "norm"};
        const std::string_view rest = std::string_view(bytes_).substr(begin_);
        const std::size_t first = std::min(rest.find_first_not_of(" \t"), rest.size());
        std::size_t end = first;
        while (end < rest.size() && (std::isalnum(static_cast<unsigned char>(rest[end])) || rest[end] == '_'))
            ++end;
        const std::string_view word = rest.substr(first, end - first);
        comment_ = first < rest.size() && rest[first] == '#';
        names_ = word.starts_with("map_") || std::find(kNames.begin(), kNames.end(), word) != kNames.end();
    }

    const std::string& bytes_;
    std::size_t begin_ = 0, seen_ = 0;
    bool comment_ = false, names_ = false;
};

/// Form feeds, vertical tabs and (except in names) no-break spaces are blanks.
void blankUnusualSpaces(std::string& bytes) {
    std::replace_if(
        bytes.begin(), bytes.end(), [](char c) { return c == '\f' || c == '\v'; }, ' ');
    constexpr char kLead = '\xC2', kNoBreakSpace = '\xA0';  // both bytes in UTF-8, only the second in Latin-1
    LineStarts lines(bytes);
    for (std::size_t at = bytes.find(kNoBreakSpace); at != std::string::npos;
         at = bytes.find(kNoBreakSpace, at + 1)) {
        lines.moveTo(at);
        if (lines.inComment() || lines.holdsNames()) continue;
        bytes[at] = ' ';
        if (at > 0 && bytes[at - 1] == kLead) bytes[at - 1] = ' ';
    }
}

/// Zero bytes may pad the last block of a file, and Control-Z ended files on CP/M and DOS.
void endAtPadding(std::string& bytes) {
    using namespace std::string_view_literals;
    constexpr std::string_view kPadding = "\0\x1A"sv, kPaddingAndBlanks = "\0\x1A \t\r\n"sv;
    const std::size_t end = bytes.find_last_not_of(kPaddingAndBlanks) + 1;  // 0 if there is nothing else
    if (const std::size_t padding = bytes.find_first_of(kPadding, end); padding != std::string::npos)
        bytes.resize(padding);
}

/// A backslash continues a line if only blanks follow it on the line. At the end of a name, as in "g back\",
/// it is part of the name.
std::vector<std::size_t> joinContinuedLines(std::string& bytes) {
    std::vector<std::size_t> joins;
    LineStarts lines(bytes);
    for (std::size_t at = bytes.find('\\'); at != std::string::npos; at = bytes.find('\\', at + 1)) {
        const std::size_t lineEnd = std::min(bytes.find_first_not_of(" \t\r", at + 1), bytes.size());
        if (lineEnd < bytes.size() && bytes[lineEnd] != '\n') continue;
        lines.moveTo(at);
        const bool endsWord = at > 0 && !isSpace(bytes[at - 1]);
        if (lines.inComment() || (lines.holdsNames() && endsWord)) continue;
        const std::size_t end = std::min(lineEnd + 1, bytes.size());
        std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                  bytes.begin() + static_cast<std::ptrdiff_t>(end), ' ');
        if (lineEnd < bytes.size()) joins.push_back(lineEnd);
    }
    return joins;
}

}  // namespace

SourceText::SourceText(const std::filesystem::path& path, std::string_view expected)
    : path_(path), bytes_(readFile(path)) {
    expectNoForeignFormat(path, bytes_, expected);
    endAtPadding(bytes_);
    if (bytes_.starts_with("\xEF\xBB\xBF")) bytes_.replace(0, 3, 3, ' ');
    if (!bytes_.empty()) {
        if (const void* zero = std::memchr(bytes_.data(), 0, bytes_.size())) {
            const auto offset = static_cast<std::size_t>(static_cast<const char*>(zero) - bytes_.data());
            fail({offset, "holds a zero byte", "expected a text file"});
        }
    }
    endLinesByNewline(bytes_);
    blankUnusualSpaces(bytes_);
    joins_ = joinContinuedLines(bytes_);
    if (bytes_.empty() || bytes_.back() != '\n') bytes_.push_back('\n');
}

std::size_t SourceText::lineOf(std::size_t offset) const {
    const auto ends = std::count(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(offset), '\n');
    const auto joined = std::lower_bound(joins_.begin(), joins_.end(), offset) - joins_.begin();
    return 1 + static_cast<std::size_t>(ends + joined);
}

InputError SourceText::error(const TextProblem& problem) const {
    return {file(), fmt::format("line {}", lineOf(problem.offset)), problem.problem, problem.remedy};
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && isSpace(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && isSpace(text.back()))
        text.remove_suffix(1);
    return text;
}

std::string_view firstWord(std::string_view text) {
    const auto end = std::find_if(text.begin(), text.end(), isSpace);
    return text.substr(0, static_cast<std::size_t>(end - text.begin()));
}

std::string_view withoutComment(std::string_view text) {
    for (std::size_t at = text.find('#'); at != std::string_view::npos; at = text.find('#', at + 1)) {
        if (at == 0 || isSpace(text[at - 1])) return trimmed(text.substr(0, at));
    }
    return trimmed(text);
}

std::string_view plainName(std::string_view name) {
    name = withoutComment(name);
    const bool isQuoted = name.size() > 2 && name.front() == '"' && name.back() == '"';
    return isQuoted ? trimmed(name.substr(1, name.size() - 2)) : name;
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
    // Out of range: the result is infinite or nearly zero.
    if (error == std::errc::result_out_of_range)
        value = std::strtod(std::string(first, past).c_str(), nullptr);
    if (past == end || *past != '#') return {past, value};
    // As in 1.#IND, which Microsoft's library used to write; any other "#" begins a comment.
    static constexpr std::array<std::string_view, 4> kNotFinite{"#IND", "#INF", "#QNAN", "#SNAN"};
    const std::string_view rest(past, static_cast<std::size_t>(end - past));
    if (std::none_of(kNotFinite.begin(), kNotFinite.end(), [&](auto name) { return rest.starts_with(name); }))
        return {past, value};
    const char* word = past;
    while (word != end && !isSpace(*word))
        ++word;
    return {word, std::numeric_limits<double>::quiet_NaN()};
}

}  // namespace duolux
