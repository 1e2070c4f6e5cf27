#include "host/loaders/obj_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cstring>

#include "host/base/printable.h"
#include "host/base/srgb.h"
#include "host/loaders/obj_complaints.h"
#include "host/loaders/obj_face.h"
#include "host/loaders/obj_tokens.h"
#include "host/scene/scene.h"

namespace duolux {

namespace {

/// Reads the lines of one part.
class PartReader {
  public:
    PartReader(std::string_view text, const ObjPartTarget& target, Reading reading, ObjPart& part)
        : begin_(text.data()),
          end_(text.data() + text.size()),
          target_(target),
          seen_(target.before),
          part_(part),
          complaints_(begin_, reading, part.notes.oddities),
          faces_(end_, target_, complaints_, part) {}

    std::optional<TextProblem> run() {
        for (const char* line = begin_; line != end_ && !complaints_.problem();) {
            readLine(line);
            line =
                static_cast<const char*>(std::memchr(line, '\n', static_cast<std::size_t>(end_ - line))) + 1;
        }
        return complaints_.problem();
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
                faces_.read(at, arguments, seen_);
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
                complaints_.count(ObjOddity::kUnknownStatement, at);
                break;
            case ObjKeyword::kNone:
            case ObjKeyword::kNeutral:
                break;
        }
    }

    void readVertex(const char* line, const char* arguments) {
        constexpr int kMost = 7;  // x y z w r g b
        constexpr int kWithWeight = 4, kWithColour = 6;
        const char* const remedy = "expected \"v x y z\"";
        const ObjNumbers numbers = readObjNumbers(arguments, end_);
        const char* const wrong = numbers.wrong();
        if (wrong != nullptr) {
            part_.badVertices.push_back({seen_.vertices, complaints_.offsetOf(wrong)});
            if (complaints_.strict()) complaints_.reportNumber(wrong, remedy);
        } else if (numbers.count < 3) {
            part_.badVertices.push_back({seen_.vertices, complaints_.offsetOf(line), numbers.count});
            if (complaints_.strict()) complaints_.reportCount(line, numbers.count, remedy);
        } else if (numbers.oddExtra != nullptr) {
            complaints_.tolerate(ObjOddity::kExtraWords, line,
                                 [&] { complaints_.reportNumber(numbers.oddExtra, remedy); });
        } else if (numbers.count > kMost) {
            tolerateExtra(line, numbers.count, remedy);
        } else {
            const bool hasWeight = numbers.count == kWithWeight || numbers.count == kMost;
            if (numbers.count >= kWithColour) {
                const auto& [fifth, sixth, seventh] = numbers.more;
                addColour(line, hasWeight ? glm::dvec3(fifth, sixth, seventh)
                                          : glm::dvec3(numbers.values.w, fifth, sixth));
            }
            if (hasWeight && numbers.values.w != 1.0) complaints_.count(ObjOddity::kVertexWeight, line);
        }
        target_.positions[seen_.vertices++] = glm::dvec3(numbers.values);
    }

    /// `colour`: of the current vertex, encoded by the transfer function of sRGB.
    void addColour(const char* line, const glm::dvec3& colour) {
        const glm::dvec3 clamped = glm::clamp(colour, 0.0, 1.0);
        if (clamped != colour) {
            complaints_.tolerate(ObjOddity::kVertexColour, line, [&] {
                complaints_.report(line, "a colour is not between 0 and 1", "expected \"v x y z r g b\"");
            });
        }
        part_.colours.resize(seen_.vertices - part_.firstVertex, glm::vec3(1.0f));
        part_.colours.emplace_back(srgbDecode(clamped.x), srgbDecode(clamped.y), srgbDecode(clamped.z));
    }

    void readTexture(const char* line, const char* arguments) {
        const char* const remedy = "expected \"vt u v\"";
        const ObjNumbers numbers = readObjNumbers(arguments, end_);
        glm::vec2& uv = target_.uvs[seen_.textureCoordinates++];
        uv = kBadUv;
        const char* const wrong = numbers.wrong() != nullptr ? numbers.wrong() : numbers.oddExtra;
        if (wrong != nullptr) {
            complaints_.tolerate(ObjOddity::kTexture, line, [&] { complaints_.reportNumber(wrong, remedy); });
        } else if (numbers.count < 1 || numbers.count > 3) {
            complaints_.tolerate(ObjOddity::kTexture, line,
                                 [&] { complaints_.reportCount(line, numbers.count, remedy); });
        } else if (uv = uvFromBelow(numbers.values.x, numbers.values.y); uv == kBadUv) {
            complaints_.tolerate(ObjOddity::kTexture, line, [&] {
                complaints_.report(line, "a texture coordinate is too large",
                                   fmt::format("expected at most {:g} in magnitude", kLargestUv));
            });
        }
    }

    void readNormal(const char* line, const char* arguments) {
        const char* const remedy = "expected \"vn x y z\"";
        const ObjNumbers numbers = readObjNumbers(arguments, end_);
        glm::vec3 normal(0.0f);
        if (numbers.wrong() != nullptr) {
            complaints_.tolerate(ObjOddity::kNormal, line,
                                 [&] { complaints_.reportNumber(numbers.wrong(), remedy); });
        } else if (numbers.count < 3) {
            complaints_.tolerate(ObjOddity::kNormal, line,
                                 [&] { complaints_.reportCount(line, numbers.count, remedy); });
        } else {
            if (numbers.oddExtra != nullptr) {
                complaints_.tolerate(ObjOddity::kExtraWords, line,
                                     [&] { complaints_.reportNumber(numbers.oddExtra, remedy); });
            } else if (numbers.count > 3) {
                tolerateExtra(line, numbers.count, remedy);
            }
            const glm::dvec3 values(numbers.values);
            const glm::dvec3 size = glm::abs(values);
            const double largest = std::max({size.x, size.y, size.z});
            if (largest > 0.0) normal = glm::vec3(glm::normalize(values / largest));
        }
        target_.normals[seen_.normals++] = normal;
    }

    void tolerateExtra(const char* line, int count, const char* remedy) {
        complaints_.tolerate(ObjOddity::kExtraNumbers, line,
                             [&] { complaints_.reportCount(line, count, remedy); });
    }

    void readSmoothing(const char* line, const char* arguments) {
        const char* const at = nextArgument(arguments);
        const std::string_view word = at == nullptr ? std::string_view() : tokenAt(at);
        std::uint32_t group = 0;
        const auto [past, error] = std::from_chars(word.data(), word.data() + word.size(), group);
        const bool isNumber = error == std::errc() && past == word.data() + word.size();
        if (!isNumber) group = word == "on" ? 1 : 0;
        if (!isNumber && word != "off") {
            complaints_.tolerate(ObjOddity::kSmoothing, line, [&] {
                complaints_.report(line, fmt::format("smoothing group {}", inQuotes(word)),
                                   "expected a number or \"off\"");
            });
        }
        part_.notes.smoothing.push_back({part_.faceEnds.size(), group});
    }

    void readMaterial(const char* line, const char* arguments) {
        const std::string_view name = restOfLine(arguments);
        if (name.empty()) {
            complaints_.tolerate(ObjOddity::kMaterialName, line, [&] {
                complaints_.report(line, "names no material", "expected \"usemtl NAME\"");
            });
        }
        part_.materials.push_back({part_.faceEnds.size(), std::string(name)});
    }

    void readLibrary(const char* line, const char* arguments) {
        const std::string_view files = restOfLine(arguments);
        if (files.empty()) {
            complaints_.tolerate(ObjOddity::kLibraryName, line, [&] {
                complaints_.report(line, "names no file", "expected \"mtllib FILE.mtl\"");
            });
        } else {
            part_.notes.libraries.emplace_back(files);
        }
    }

    const char* begin_;
    const char* end_;
    const ObjPartTarget& target_;
    ObjCounts seen_;  ///< statements of the file before the current line, except faces
    ObjPart& part_;
    ObjComplaints complaints_;
    ObjFaceReader faces_;
};

}  // namespace

std::optional<TextProblem> readObjPart(std::string_view text, const ObjPartTarget& target, Reading reading,
                                       ObjPart& part) {
    assert(text.empty() || text.back() == '\n');
    return PartReader(text, target, reading, part).run();
}

std::size_t leaveOutFaces(ObjPart& part, const std::vector<bool>& bad) {
    constexpr std::uint32_t kNone = Geometry::kNoNormal;
    static_assert(kNone == Geometry::kNoUv);
    std::vector<std::size_t> before(part.faceEnds.size() + 1);  // faces that are kept before each face
    std::size_t kept = 0, corners = 0, begin = 0;
    const auto keep = [&](std::vector<std::uint32_t>& indices, std::size_t end) {
        for (std::size_t from = begin, to = corners; from < end && to < indices.size(); ++from, ++to)
            indices[to] = from < indices.size() ? indices[from] : kNone;
    };
    for (std::size_t face = 0; face < part.faceEnds.size(); ++face) {
        before[face] = kept;
        const std::size_t end = part.faceEnds[face];
        const auto isBad = [&](std::uint32_t vertex) { return bad[vertex]; };
        if (!std::any_of(&part.cornerVertices[begin], &part.cornerVertices[end - 1] + 1, isBad)) {
            keep(part.cornerVertices, end);
            keep(part.cornerNormals, end);
            keep(part.cornerUvs, end);
            corners += end - begin;
            part.faceEnds[kept++] = static_cast<std::uint32_t>(corners);
        }
        begin = end;
    }
    before.back() = kept;
    const std::size_t leftOut = part.faceEnds.size() - kept;
    if (leftOut == 0) return 0;
    for (auto* indices : {&part.cornerNormals, &part.cornerUvs})
        indices->resize(std::min(indices->size(), corners));
    part.cornerVertices.resize(corners);
    part.faceEnds.resize(kept);
    for (ObjPart::MaterialChange& change : part.materials)
        change.face = before[change.face];
    for (ObjNotes::Smoothing& change : part.notes.smoothing)
        change.face = before[change.face];
    return leftOut;
}

}  // namespace duolux
