#include "host/loaders/obj_parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "host/base/error.h"
#include "host/base/parallel.h"
#include "host/base/printable.h"
#include "host/scene/mesh.h"

namespace duolux {

namespace {

struct Stretch {
    std::size_t begin, end;
    ObjCounts before, counts;
};

std::vector<Stretch> splitAtLines(std::string_view text) {
    constexpr std::size_t kBytes = std::size_t{4} << 20;
    std::vector<Stretch> stretches;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = text.find('\n', std::min(begin + kBytes, text.size()) - 1) + 1;
        stretches.push_back({begin, end, {}, {}});
        begin = end;
    }
    return stretches;
}

ObjCounts countAll(std::string_view text, std::vector<Stretch>& stretches) {
    parallelFor(stretches.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            stretches[i].counts =
                countStatements(text.substr(stretches[i].begin, stretches[i].end - stretches[i].begin));
        }
    });
    ObjCounts total;
    for (Stretch& stretch : stretches) {
        stretch.before = total;
        total += stretch.counts;
    }
    return total;
}

/// The offset of the (ordinal + 1)th statement `v`. Only for error messages.
std::size_t offsetOfVertex(std::string_view text, std::size_t ordinal) {
    for (std::size_t begin = 0; begin < text.size(); begin = text.find('\n', begin) + 1) {
        const std::string_view line = trimmed(text.substr(begin, text.find('\n', begin) - begin));
        if (firstWord(line) == "v" && ordinal-- == 0) return begin;
    }
    return 0;
}

/// Converts the positions of a file to floats.
class Positions {
  public:
    Positions(const SourceText& text, ObjFile& file, std::vector<glm::dvec3> values)
        : text_(text), file_(file), values_(std::move(values)) {
        viewPolygons();
    }

    /// Faces with invalid vertices are left out. It is an error if no faces remain.
    void settleBadVertices() {
        const ObjPart* firstPart = nullptr;
        const ObjPart::BadVertex* first = nullptr;  // that a face uses
        std::vector<bool> used, bad;
        for (const ObjPart& part : file_.parts) {
            for (const ObjPart::BadVertex& vertex : part.badVertices) {
                if (!anyFace()) fail(part, vertex);
                if (used.empty()) {
                    used = usedVertices(values_.size(), polygons_);
                    bad.resize(values_.size());
                }
                values_[vertex.index] = glm::dvec3(0.0);
                if (!used[vertex.index]) {
                    file_.oddities.add(ObjOddity::kUnusedVertex, part.offset + vertex.offset);
                    continue;
                }
                bad[vertex.index] = true;
                if (first != nullptr) continue;
                first = &vertex;
                firstPart = &part;
            }
        }
        if (first == nullptr) return;
        std::size_t leftOut = 0;
        for (ObjPart& part : file_.parts)
            leftOut += leaveOutFaces(part, bad);
        viewPolygons();
        if (!anyFace()) fail(*firstPart, *first);
        file_.oddities.add(ObjOddity::kBadVertex, firstPart->offset + first->offset, leftOut);
    }

    void round(Reading reading) {
        file_.rounded = roundPositions(values_, polygons_);
        if (!file_.rounded.inRange) settleFarVertices(reading);
    }

  private:
    void viewPolygons() {
        polygons_.clear();
        for (const ObjPart& part : file_.parts)
            polygons_.push_back({part.faceEnds, part.cornerVertices});
    }

    bool anyFace() const {
        return std::any_of(polygons_.begin(), polygons_.end(),
                           [](const PolygonView& part) { return !part.ends.empty(); });
    }

    [[noreturn]] void fail(const ObjPart& part, const ObjPart::BadVertex& vertex) const {
        const std::size_t offset = part.offset + vertex.offset;
        const std::string_view word = firstWord(text_.view().substr(offset));
        text_.fail({offset,
                    vertex.tooFew ? fmt::format("{} numbers", *vertex.tooFew)
                                  : fmt::format("{} is not a finite number", inQuotes(word)),
                    "expected \"v x y z\""});
    }

    void settleFarVertices(Reading reading) {
        const std::vector<bool> used = usedVertices(values_.size(), polygons_);
        for (std::size_t i = 0; i < values_.size(); ++i) {
            glm::vec3& position = file_.rounded.positions[i];
            if (glm::all(glm::lessThanEqual(glm::abs(position), glm::vec3(kLargestCoordinate)))) continue;
            const bool refused = used[i] || reading == Reading::kStrict;
            const bool isFirst = file_.oddities[ObjOddity::kUnusedVertex].count == 0;
            const std::size_t offset = refused || isFirst ? offsetOfVertex(text_.view(), i) : 0;
            if (refused) {
                text_.fail({offset, "a coordinate is not finite or too large",
                            fmt::format("expected at most {:g} in magnitude", kLargestCoordinate)});
            }
            file_.oddities.add(ObjOddity::kUnusedVertex, offset);
            position = glm::vec3(0.0f);
        }
    }

    const SourceText& text_;
    ObjFile& file_;
    std::vector<glm::dvec3> values_;
    std::vector<PolygonView> polygons_;  ///< per part
};

/// Throws if all faces are invalid; a file with some valid faces is loaded without the invalid ones.
void failWithoutFaces(const SourceText& text, const ObjFile& file) {
    const auto hasFaces = [](const ObjPart& part) { return !part.faceEnds.empty(); };
    if (std::any_of(file.parts.begin(), file.parts.end(), hasFaces)) return;
    for (const ObjPart& part : file.parts) {
        if (!part.badFace) continue;
        TextProblem problem = *part.badFace;
        problem.offset += part.offset;
        text.fail(problem);
    }
}

}  // namespace

ObjFile parseObj(const SourceText& text, Reading reading) {
    std::vector<Stretch> stretches = splitAtLines(text.view());
    const ObjCounts total = countAll(text.view(), stretches);
    constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
    if (total.vertices > kMost || total.normals > kMost || total.textureCoordinates > kMost ||
        total.faces > kMost) {
        throw InputError(text.file(), "", "is too large", "expected fewer than 2^31 vertices and faces");
    }

    ObjFile file;
    std::vector<glm::dvec3> positions(total.vertices);
    file.normals.resize(total.normals);
    file.uvs.resize(total.textureCoordinates);
    file.parts.resize(stretches.size());
    std::vector<std::optional<TextProblem>> problems(stretches.size());
    parallelFor(stretches.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Stretch& stretch = stretches[i];
            ObjPart& part = file.parts[i];
            part.offset = stretch.begin;
            part.firstVertex = stretch.before.vertices;
            part.faceEnds.reserve(stretch.counts.faces);
            part.cornerVertices.reserve(3 * stretch.counts.faces);
            const ObjPartTarget target{positions, file.normals, file.uvs, stretch.before, total};
            problems[i] = readObjPart(text.view().substr(stretch.begin, stretch.end - stretch.begin), target,
                                      reading, part);
        }
    });
    for (std::size_t i = 0; i < problems.size(); ++i) {
        if (problems[i]) {
            problems[i]->offset += stretches[i].begin;
            text.fail(*problems[i]);
        }
        file.oddities.append(file.parts[i].notes.oddities, file.parts[i].offset);
    }
    failWithoutFaces(text, file);
    Positions rounding(text, file, std::move(positions));
    rounding.settleBadVertices();
    rounding.round(reading);
    return file;
}

}  // namespace duolux
