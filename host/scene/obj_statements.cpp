#include "host/scene/obj_statements.h"

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <utility>

#include "host/base/printable.h"

namespace duolux {

namespace {

bool isBlank(char c) {
    return c == ' ' || c == '\t';
}
bool isLineEnd(char c) {
    return c == '\n' || c == '\r';
}

std::string_view tokenAt(const char* at) {
    const char* end = at;
    while (!isBlank(*end) && !isLineEnd(*end))
        ++end;
    return {at, static_cast<std::size_t>(end - at)};
}

enum class Keyword {
    kNone,
    kVertex,
    kTexture,
    kNormal,
    kFace,
    kSmoothing,
    kMaterial,
    kLibrary,
    kNeutral,
    kUnknown
};

Keyword keywordOf(std::string_view word) {
    if (word.empty() || word.front() == '#') return Keyword::kNone;
    if (word == "v") return Keyword::kVertex;
    if (word == "f") return Keyword::kFace;
    if (word == "vn") return Keyword::kNormal;
    if (word == "vt") return Keyword::kTexture;
    if (word == "s") return Keyword::kSmoothing;
    if (word == "usemtl") return Keyword::kMaterial;
    if (word == "mtllib") return Keyword::kLibrary;
    // Without meaning for a picture of triangles: names, points and lines, display hints.
    static constexpr std::array<std::string_view, 12> kNeutral{
        "g", "o", "l", "p", "vp", "lod", "bevel", "c_interp", "d_interp", "usemap", "maplib", "mg"};
    for (const std::string_view neutral : kNeutral) {
        if (word == neutral) return Keyword::kNeutral;
    }
    return Keyword::kUnknown;
}

/// Goes through the lines of one part. Text ends with '\n', which stops every scan.
class Checker {
  public:
    Checker(std::span<char> text, const ObjCounts& before, const ObjCounts& total, ObjNotes& notes)
        : begin_(text.data()), end_(text.data() + text.size()), seen_(before), total_(total), notes_(notes) {}

    std::optional<TextProblem> run() {
        for (char* line = begin_; line != end_ && !problem_;) {
            char* const newline =
                static_cast<char*>(std::memchr(line, '\n', static_cast<std::size_t>(end_ - line)));
            checkLine(line);
            line = newline + 1;
        }
        return problem_;
    }

  private:
    void checkLine(char* at) {
        while (isBlank(*at))
            ++at;
        const std::string_view word = tokenAt(at);
        char* const arguments = at + word.size();
        switch (keywordOf(word)) {
            case Keyword::kVertex:
                checkNumbers(at, arguments, 3, 7, "expected \"v x y z\"");
                ++seen_.vertices;
                break;
            case Keyword::kTexture:
                checkNumbers(at, arguments, 1, 3, "expected \"vt u v\"");
                ++seen_.textureCoordinates;
                break;
            case Keyword::kNormal:
                checkNumbers(at, arguments, 3, 3, "expected \"vn x y z\"");
                ++seen_.normals;
                break;
            case Keyword::kFace:
                checkFace(at, arguments);
                ++faces_;
                break;
            case Keyword::kSmoothing:
                checkSmoothing(at, arguments);
                break;
            case Keyword::kMaterial:
                if (restOfLine(arguments).empty()) {
                    report(at, "names no material", "expected \"usemtl NAME\"");
                }
                break;
            case Keyword::kLibrary:
                noteLibrary(at, arguments);
                break;
            case Keyword::kUnknown:
                if (notes_.ignored++ == 0) notes_.firstIgnored = offsetOf(at);
                break;
            case Keyword::kNone:
            case Keyword::kNeutral:
                break;
        }
    }

    /// At the next argument, or null at the end of the line. A comment is blanked out.
    char* nextArgument(char* at) {
        while (isBlank(*at))
            ++at;
        if (isLineEnd(*at)) return nullptr;
        if (*at != '#') return at;
        while (!isLineEnd(*at))
            *at++ = ' ';
        return nullptr;
    }

    void checkNumbers(char* line, char* at, int least, int most, const char* remedy) {
        int count = 0;
        while ((at = nextArgument(at)) != nullptr) {
            const char* const past = skipDecimalNumber(at, end_);
            if (past == nullptr || !(isBlank(*past) || isLineEnd(*past))) {
                report(at, fmt::format("{} is not a finite number", inQuotes(tokenAt(at))), remedy);
                return;
            }
            at = begin_ + (past - begin_);
            ++count;
        }
        if (count < least || count > most) report(line, fmt::format("{} numbers", count), remedy);
    }

    void checkFace(char* line, char* at) {
        int corners = 0;
        while ((at = nextArgument(at)) != nullptr) {
            const char* const past = checkCorner(at);
            if (past == nullptr) return;
            at = begin_ + (past - begin_);
            ++corners;
        }
        if (corners < 3) {
            report(line, fmt::format("a face of {} corners", corners),
                   "expected at least 3, as in \"f 1 2 3\"");
        }
    }

    /// v, v/vt, v//vn or v/vt/vn. Returns past it, or null after a report.
    const char* checkCorner(const char* corner) {
        const char* at = checkIndex(corner, corner, seen_.vertices, total_.vertices, "vertex", "vertices");
        if (at == nullptr || *at != '/') return endOfCorner(corner, at);
        ++at;
        if (*at != '/') {
            at = checkIndex(corner, at, seen_.textureCoordinates, total_.textureCoordinates,
                            "texture coordinate", "texture coordinates");
            if (at == nullptr || *at != '/') return endOfCorner(corner, at);
        }
        at = checkIndex(corner, at + 1, seen_.normals, total_.normals, "normal", "normals");
        return endOfCorner(corner, at);
    }

    const char* endOfCorner(const char* corner, const char* at) {
        if (at == nullptr || isBlank(*at) || isLineEnd(*at)) return at;
        reportCorner(corner);
        return nullptr;
    }

    void reportCorner(const char* corner) {
        report(corner, fmt::format("{} is not a corner of a face", inQuotes(tokenAt(corner))),
               "expected indices as in 1, 1/1, 1//1 or 1/1/1");
    }

    const char* checkIndex(const char* corner, const char* at, std::size_t seen, std::size_t total,
                           const char* one, const char* many) {
        const char* const digits = at + (*at == '-' ? 1 : 0);
        std::uint64_t value = 0;
        const auto [past, error] = std::from_chars(digits, end_, value);
        if (error == std::errc::invalid_argument) {
            reportCorner(corner);
            return nullptr;
        }
        const std::uint64_t limit = *at == '-' ? seen : total;
        if (value == 0 || value > limit || error != std::errc()) {
            report(corner, fmt::format("{} index {} is out of range", one, std::string_view(at, past)),
                   fmt::format("there are {} {} {}", limit, many,
                               *at == '-' ? "before this line" : "in the file"));
            return nullptr;
        }
        return past;
    }

    void checkSmoothing(const char* line, char* at) {
        at = nextArgument(at);
        const std::string_view word = at == nullptr ? std::string_view() : tokenAt(at);
        std::uint32_t group = 0;
        const auto [past, error] = std::from_chars(word.data(), word.data() + word.size(), group);
        const bool isNumber = error == std::errc() && past == word.data() + word.size();
        if (!isNumber && word != "off") {
            report(line, fmt::format("smoothing group {}", inQuotes(word)), "expected a number or \"off\"");
            return;
        }
        notes_.smoothing.push_back({faces_, isNumber ? group : 0});
    }

    static std::string_view restOfLine(const char* at) {
        const char* end = at;
        while (*end != '\n')
            ++end;
        return trimmed({at, static_cast<std::size_t>(end - at)});
    }

    void noteLibrary(const char* line, const char* at) {
        const std::string_view files = restOfLine(at);
        if (files.empty()) {
            report(line, "names no file", "expected \"mtllib FILE.mtl\"");
            return;
        }
        notes_.libraries.push_back({offsetOf(line), std::string(files)});
    }

    std::size_t offsetOf(const char* at) const { return static_cast<std::size_t>(at - begin_); }

    void report(const char* at, std::string problem, std::string remedy) {
        if (!problem_) problem_ = TextProblem{offsetOf(at), std::move(problem), std::move(remedy)};
    }

    char* begin_;
    char* end_;
    ObjCounts seen_;  ///< statements up to the current line; faces are counted from the start of the part
    const ObjCounts& total_;
    std::size_t faces_ = 0;
    ObjNotes& notes_;
    std::optional<TextProblem> problem_;
};

}  // namespace

ObjCounts& ObjCounts::operator+=(const ObjCounts& other) {
    vertices += other.vertices;
    textureCoordinates += other.textureCoordinates;
    normals += other.normals;
    faces += other.faces;
    return *this;
}

ObjCounts countStatements(std::string_view text) {
    ObjCounts counts;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (at != end) {
        while (isBlank(*at))
            ++at;
        if (*at == 'f' && (isBlank(at[1]) || isLineEnd(at[1]))) {
            ++counts.faces;
        } else if (*at == 'v') {
            const std::string_view word = tokenAt(at);
            if (word.size() == 1) ++counts.vertices;
            if (word == "vt") ++counts.textureCoordinates;
            if (word == "vn") ++counts.normals;
        }
        at = static_cast<const char*>(std::memchr(at, '\n', static_cast<std::size_t>(end - at))) + 1;
    }
    return counts;
}

std::optional<TextProblem> checkStatements(std::span<char> text, const ObjCounts& before,
                                           const ObjCounts& total, ObjNotes& notes) {
    assert(text.empty() || text.back() == '\n');
    return Checker(text, before, total, notes).run();
}

}  // namespace duolux
