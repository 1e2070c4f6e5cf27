#include "host/scene/obj_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "host/base/printable.h"
#include "host/scene/scene.h"

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

/// At the next argument, or null at the end of the line or at a comment.
const char* nextArgument(const char* at) {
    while (isBlank(*at))
        ++at;
    return isLineEnd(*at) || *at == '#' ? nullptr : at;
}

std::string_view restOfLine(const char* at) {
    const char* end = at;
    while (*end != '\n')
        ++end;
    return trimmed({at, static_cast<std::size_t>(end - at)});
}

/// Goes through the lines of one part. Text ends with '\n', which stops every scan.
class PartReader {
  public:
    PartReader(std::string_view text, const ObjPartTarget& target, Reading reading, ObjPart& part)
        : begin_(text.data()),
          end_(text.data() + text.size()),
          target_(target),
          seen_(target.before),
          reading_(reading),
          part_(part) {}

    std::optional<TextProblem> run() {
        for (const char* line = begin_; line != end_ && !problem_;) {
            readLine(line);
            line =
                static_cast<const char*>(std::memchr(line, '\n', static_cast<std::size_t>(end_ - line))) + 1;
        }
        return problem_;
    }

  private:
    void readLine(const char* at) {
        while (isBlank(*at))
            ++at;
        const std::string_view word = tokenAt(at);
        const char* const arguments = at + word.size();
        switch (objKeywordOf(word)) {
            case ObjKeyword::kVertex:
                readVertex(at, arguments);
                break;
            case ObjKeyword::kTexture:
                readTexture(at, arguments);
                break;
            case ObjKeyword::kNormal:
                readNormal(at, arguments);
                break;
            case ObjKeyword::kFace:
                readFace(at, arguments);
                break;
            case ObjKeyword::kSmoothing:
                readSmoothing(at, arguments);
                break;
            case ObjKeyword::kMaterial:
                readMaterial(at, arguments);
                break;
            case ObjKeyword::kLibrary:
                readLibrary(at, arguments);
                break;
            case ObjKeyword::kUnknown:
                part_.notes.oddities.add(ObjOddity::kUnknownStatement, offsetOf(at));
                break;
            case ObjKeyword::kNone:
            case ObjKeyword::kNeutral:
                break;
        }
    }

    /// The numbers of a statement: the first three, how many there are, and the first that is no number or
    /// not a finite one.
    struct Numbers {
        glm::dvec3 values{0.0};
        int count = 0;
        const char* notNumber = nullptr;
        const char* notFinite = nullptr;
    };

    Numbers readNumbers(const char* at) const {
        Numbers numbers;
        while ((at = nextArgument(at)) != nullptr) {
            const auto [past, value] = readNumber(at, end_);
            if (past == nullptr || !(isBlank(*past) || isLineEnd(*past))) {
                numbers.notNumber = at;
                return numbers;
            }
            if (!std::isfinite(value) && numbers.notFinite == nullptr) numbers.notFinite = at;
            if (numbers.count < 3) numbers.values[numbers.count] = value;
            ++numbers.count;
            at = past;
        }
        return numbers;
    }

    void readVertex(const char* line, const char* arguments) {
        constexpr int kMost = 7;  // x y z w r g b
        constexpr int kWithColour = 6;
        const char* const remedy = "expected \"v x y z\"";
        const Numbers numbers = readNumbers(arguments);
        if (numbers.notNumber != nullptr) return reportNumber(numbers.notNumber, remedy);
        if (numbers.count < 3) return reportCount(line, numbers.count, remedy);
        if (numbers.count > kMost) {
            tolerate(ObjOddity::kExtraNumbers, line, [&] { reportCount(line, numbers.count, remedy); });
        } else if (numbers.count >= kWithColour) {
            part_.notes.oddities.add(ObjOddity::kVertexColour, offsetOf(line));
        }
        target_.positions[seen_.vertices] = numbers.values;
        if (numbers.notFinite != nullptr) {
            part_.badVertices.push_back({seen_.vertices, offsetOf(numbers.notFinite)});
            if (reading_ == Reading::kStrict) reportNumber(numbers.notFinite, remedy);
        }
        ++seen_.vertices;
    }

    void readTexture(const char* line, const char* arguments) {
        const char* const remedy = "expected \"vt u v\"";
        const Numbers numbers = readNumbers(arguments);
        ++seen_.textureCoordinates;
        const char* const wrong = numbers.notNumber != nullptr ? numbers.notNumber : numbers.notFinite;
        if (wrong != nullptr) {
            tolerate(ObjOddity::kTexture, line, [&] { reportNumber(wrong, remedy); });
        } else if (numbers.count < 1 || numbers.count > 3) {
            tolerate(ObjOddity::kTexture, line, [&] { reportCount(line, numbers.count, remedy); });
        }
    }

    void readNormal(const char* line, const char* arguments) {
        const char* const remedy = "expected \"vn x y z\"";
        const Numbers numbers = readNumbers(arguments);
        glm::vec3 normal(0.0f);
        const char* const wrong = numbers.notNumber != nullptr ? numbers.notNumber : numbers.notFinite;
        if (wrong != nullptr) {
            tolerate(ObjOddity::kNormal, line, [&] { reportNumber(wrong, remedy); });
        } else if (numbers.count < 3) {
            tolerate(ObjOddity::kNormal, line, [&] { reportCount(line, numbers.count, remedy); });
        } else {
            if (numbers.count > 3) {
                tolerate(ObjOddity::kExtraNumbers, line, [&] { reportCount(line, numbers.count, remedy); });
            }
            const glm::dvec3 size = glm::abs(numbers.values);
            const double largest = std::max({size.x, size.y, size.z});
            if (largest > 0.0) normal = glm::vec3(glm::normalize(numbers.values / largest));
        }
        target_.normals[seen_.normals++] = normal;
    }

    void readFace(const char* line, const char* at) {
        const std::size_t first = part_.cornerVertices.size();
        while ((at = nextArgument(at)) != nullptr) {
            at = readCorner(at);
            if (at == nullptr) return;
        }
        const std::size_t corners = part_.cornerVertices.size() - first;
        if (corners >= 3) {
            if (badIndex_) problem_ = badIndex_;
            part_.faceEnds.push_back(static_cast<std::uint32_t>(part_.cornerVertices.size()));
            return;
        }
        part_.cornerVertices.resize(first);
        part_.cornerNormals.resize(std::min(part_.cornerNormals.size(), first));
        badIndex_.reset();
        tolerate(ObjOddity::kShortFace, line, [&] {
            report(line, fmt::format("a face of {} corners", corners),
                   "expected at least 3, as in \"f 1 2 3\"");
        });
    }

    struct Index {
        std::string_view text;  ///< empty: there is none
        std::int64_t value = 0;
    };
    Index readIndex(const char* at) const {
        std::int64_t value = 0;
        const auto [past, error] = std::from_chars(at, end_, value);
        if (error == std::errc::invalid_argument) return {};
        if (error != std::errc()) value = std::numeric_limits<std::int64_t>::max();
        return {std::string_view(at, static_cast<std::size_t>(past - at)), value};
    }

    /// v, v/vt, v//vn or v/vt/vn. Returns past it, or null after a report.
    const char* readCorner(const char* corner) {
        const Index vertex = readIndex(corner);
        if (vertex.text.empty()) return reportCorner(corner);
        const char* at = corner + vertex.text.size();
        Index texture, normal;
        if (*at == '/') {
            texture = readIndex(++at);
            at += texture.text.size();
            if (*at == '/') {
                normal = readIndex(++at);
                at += normal.text.size();
            }
        }
        if (!isBlank(*at) && !isLineEnd(*at)) return reportCorner(corner);
        if (at[-1] == '/') tolerate(ObjOddity::kTrailingSlash, corner, [&] { reportCorner(corner); });
        if (!texture.text.empty()) {
            const auto index =
                resolve(texture.value, seen_.textureCoordinates, target_.total.textureCoordinates);
            if (!index) {
                tolerate(ObjOddity::kTextureIndex, corner, [&] {
                    report(corner, indexProblem("texture coordinate", texture.text),
                           indexRemedy("texture coordinates", texture.value, seen_.textureCoordinates,
                                       target_.total.textureCoordinates));
                });
            }
        }
        addNormal(corner, normal);
        const auto index = resolve(vertex.value, seen_.vertices, target_.total.vertices);
        if (!index && !badIndex_) {
            badIndex_ =
                TextProblem{offsetOf(corner), indexProblem("vertex", vertex.text),
                            indexRemedy("vertices", vertex.value, seen_.vertices, target_.total.vertices)};
        }
        part_.cornerVertices.push_back(index.value_or(0));
        return at;
    }

    void addNormal(const char* corner, const Index& normal) {
        if (normal.text.empty() && part_.cornerNormals.empty()) return;
        part_.cornerNormals.resize(part_.cornerVertices.size(), Geometry::kNoNormal);
        if (normal.text.empty()) {
            part_.cornerNormals.push_back(Geometry::kNoNormal);
            return;
        }
        const auto index = resolve(normal.value, seen_.normals, target_.total.normals);
        if (!index) {
            tolerate(ObjOddity::kNormalIndex, corner, [&] {
                report(corner, indexProblem("normal", normal.text),
                       indexRemedy("normals", normal.value, seen_.normals, target_.total.normals));
            });
        }
        part_.cornerNormals.push_back(index.value_or(Geometry::kNoNormal));
    }

    static std::optional<std::uint32_t> resolve(std::int64_t index, std::size_t seen, std::size_t total) {
        const std::int64_t resolved = index > 0 ? index - 1 : static_cast<std::int64_t>(seen) + index;
        const std::size_t limit = index > 0 ? total : seen;
        if (resolved < 0 || resolved >= static_cast<std::int64_t>(limit)) return std::nullopt;
        return static_cast<std::uint32_t>(resolved);
    }

    static std::string indexProblem(const char* one, std::string_view index) {
        return fmt::format("{} index {} is out of range", one, shortened(index));
    }

    static std::string indexRemedy(const char* many, std::int64_t index, std::size_t seen,
                                   std::size_t total) {
        return fmt::format("there are {} {} {}", index < 0 ? seen : total, many,
                           index < 0 ? "before this line" : "in the file");
    }

    void readSmoothing(const char* line, const char* arguments) {
        const char* const at = nextArgument(arguments);
        const std::string_view word = at == nullptr ? std::string_view() : tokenAt(at);
        std::uint32_t group = 0;
        const auto [past, error] = std::from_chars(word.data(), word.data() + word.size(), group);
        const bool isNumber = error == std::errc() && past == word.data() + word.size();
        if (!isNumber) group = word == "on" ? 1 : 0;
        if (!isNumber && word != "off") {
            tolerate(ObjOddity::kSmoothing, line, [&] {
                report(line, fmt::format("smoothing group {}", inQuotes(word)),
                       "expected a number or \"off\"");
            });
        }
        part_.notes.smoothing.push_back({part_.faceEnds.size(), group});
    }

    void readMaterial(const char* line, const char* arguments) {
        const std::string_view name = restOfLine(arguments);
        if (name.empty()) {
            tolerate(ObjOddity::kMaterialName, line,
                     [&] { report(line, "names no material", "expected \"usemtl NAME\""); });
        }
        part_.materials.push_back({part_.faceEnds.size(), std::string(name)});
    }

    void readLibrary(const char* line, const char* arguments) {
        const std::string_view files = restOfLine(arguments);
        if (files.empty()) {
            tolerate(ObjOddity::kLibraryName, line,
                     [&] { report(line, "names no file", "expected \"mtllib FILE.mtl\""); });
        } else {
            part_.notes.libraries.emplace_back(files);
        }
    }

    /// Counts it, or calls `refuse`, which reports it.
    template <typename Refuse>
    void tolerate(ObjOddity oddity, const char* at, const Refuse& refuse) {
        if (reading_ == Reading::kStrict) {
            refuse();
        } else {
            part_.notes.oddities.add(oddity, offsetOf(at));
        }
    }

    std::size_t offsetOf(const char* at) const { return static_cast<std::size_t>(at - begin_); }

    void report(const char* at, std::string problem, std::string remedy) {
        if (!problem_) problem_ = TextProblem{offsetOf(at), std::move(problem), std::move(remedy)};
    }
    void reportNumber(const char* at, const char* remedy) {
        report(at, fmt::format("{} is not a finite number", inQuotes(tokenAt(at))), remedy);
    }
    void reportCount(const char* line, int count, const char* remedy) {
        report(line, fmt::format("{} numbers", count), remedy);
    }
    const char* reportCorner(const char* corner) {
        report(corner, fmt::format("{} is not a corner of a face", inQuotes(tokenAt(corner))),
               "expected indices as in 1, 1/1, 1//1 or 1/1/1");
        return nullptr;
    }

    const char* begin_;
    const char* end_;
    const ObjPartTarget& target_;
    ObjCounts seen_;  ///< statements of the file up to the current line, but for faces
    Reading reading_;
    ObjPart& part_;
    std::optional<TextProblem> problem_;
    std::optional<TextProblem> badIndex_;  ///< of the current face
};

}  // namespace

std::optional<TextProblem> readObjPart(std::string_view text, const ObjPartTarget& target, Reading reading,
                                       ObjPart& part) {
    assert(text.empty() || text.back() == '\n');
    return PartReader(text, target, reading, part).run();
}

}  // namespace duolux
