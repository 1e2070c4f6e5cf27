#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/base/error.h"

namespace duolux {

inline bool isBlank(char c) {
    return c == ' ' || c == '\t';
}
inline bool isLineEnd(char c) {
    return c == '\n' || c == '\r';
}

/// A problem in a text, and its position.
struct TextProblem {
    std::size_t offset;  ///< bytes from the start of the text
    std::string problem;
    std::string remedy;
};

/// A line-based text file (OBJ, MTL), normalised for parsers: every line, including the last, ends in '\n'
/// (or "\r\n"); a byte order mark and unusual blanks are replaced by blanks; lines continued by '\' are
/// joined, except comments; zero bytes and Control-Z at the end are removed. Offsets are those of the file,
/// so that each gives the line number that an editor shows.
class SourceText {
  public:
    /// Throws InputError if the file cannot be read or is not text, ForeignFile if it is evidently not
    /// `expected` ("a Wavefront OBJ file").
    SourceText(const std::filesystem::path& path, std::string_view expected);

    std::string file() const { return path_.string(); }
    std::string_view view() const { return bytes_; }
    std::size_t size() const { return bytes_.size(); }

    /// The line number of an offset; 1 for the first line.
    std::size_t lineOf(std::size_t offset) const;

    /// "FILE: line N: PROBLEM; REMEDY".
    InputError error(const TextProblem& problem) const;
    [[noreturn]] void fail(const TextProblem& problem) const { throw error(problem); }

  private:
    std::filesystem::path path_;
    std::string bytes_;
    std::vector<std::size_t> joins_;  ///< offsets of the line ends that continuation replaced, ascending
};

/// The text without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// The text up to the first blank or line end.
std::string_view firstWord(std::string_view text);

/// The text without a comment ("#" after a blank) and without blanks at both ends.
std::string_view withoutComment(std::string_view text);

/// A name without a comment and without quotes around it.
std::string_view plainName(std::string_view name);

/// Reads a number as %g writes it, including the variants of "nan", "inf" and "1.#IND", which are not finite.
/// `past` is null if there is no number at this position.
struct ReadNumber {
    const char* past;
    double value;
};
ReadNumber readNumber(const char* at, const char* end);

}  // namespace duolux
