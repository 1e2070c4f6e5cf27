#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/base/error.h"

namespace duolux {

/// What is wrong with a text, and where.
struct TextProblem {
    std::size_t offset;  ///< bytes from the start of the text
    std::string problem;
    std::string remedy;
};

/// A line-based text file (OBJ, MTL) made regular for parsers: every line ends in '\n' (or "\r\n"), also the
/// last; a byte order mark and unusual blanks are blanks; a line continued by '\' is joined, unless it is a
/// comment; zero bytes and Control-Z at the end are left out. Offsets stay those of the file, so that any of
/// them gives the line number as an editor shows it.
class SourceText {
  public:
    /// Throws InputError if the file cannot be read or is not text, ForeignFile if it is evidently not
    /// `expected` ("a Wavefront OBJ file").
    SourceText(const std::filesystem::path& path, std::string_view expected);

    std::string file() const { return path_.string(); }
    std::string_view view() const { return bytes_; }
    std::size_t size() const { return bytes_.size(); }

    /// 1 for the first line.
    std::size_t lineOf(std::size_t offset) const;

    /// "FILE: line N: PROBLEM; REMEDY".
    InputError error(const TextProblem& problem) const;
    [[noreturn]] void fail(const TextProblem& problem) const { throw error(problem); }

  private:
    std::filesystem::path path_;
    std::string bytes_;
    std::vector<std::size_t> joins_;  ///< offsets of the line ends that continuation replaced, ascending
};

/// Without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// The text up to the first blank or line end.
std::string_view firstWord(std::string_view text);

/// Without the comment that "#" begins behind a blank, and without blanks at both ends.
std::string_view withoutComment(std::string_view text);

/// A name without a comment and the quotes around it.
std::string_view plainName(std::string_view name);

/// A number as %g writes it, also "nan", "inf" and "1.#IND" in their variants, which are not finite. `past`
/// is null if none starts there.
struct ReadNumber {
    const char* past;
    double value;
};
ReadNumber readNumber(const char* at, const char* end);

}  // namespace duolux
