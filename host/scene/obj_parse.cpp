#include "host/scene/obj_parse.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <istream>
#include <limits>
#include <optional>
#include <span>
#include <streambuf>
#include <vector>

#include "host/base/error.h"
#include "host/base/parallel.h"
#include "host/scene/mesh.h"

namespace duolux {

namespace {

/// Lets a stream read bytes where they lie.
class MemoryBuffer : public std::streambuf {
  public:
    explicit MemoryBuffer(std::span<char> bytes) {
        setg(bytes.data(), bytes.data(), bytes.data() + bytes.size());
    }
};

/// Receives the statements of one part from the parser.
class PartReader {
  public:
    PartReader(ObjFile& file, ObjPart& part, const ObjCounts& before, const ObjCounts& counts)
        : file_(file), part_(part), before_(before), counts_(counts) {
        part_.faceEnds.reserve(counts.faces);
        part_.cornerVertices.reserve(3 * counts.faces);
    }

    void read(std::span<char> text) {
        tinyobj::callback_t callbacks;
        callbacks.vertex_cb = [](void* self, tinyobj::real_t x, tinyobj::real_t y, tinyobj::real_t z,
                                 tinyobj::real_t) {
            static_cast<PartReader*>(self)->vertex(glm::vec3(x, y, z));
        };
        callbacks.normal_cb = [](void* self, tinyobj::real_t x, tinyobj::real_t y, tinyobj::real_t z) {
            static_cast<PartReader*>(self)->normal(glm::vec3(x, y, z));
        };
        callbacks.index_cb = [](void* self, tinyobj::index_t* corners, int count) {
            static_cast<PartReader*>(self)->face({corners, static_cast<std::size_t>(count)});
        };
        callbacks.usemtl_cb = [](void* self, const char* name, int) {
            auto* reader = static_cast<PartReader*>(self);
            reader->part_.materials.push_back({reader->part_.faceEnds.size(), std::string(trimmed(name))});
        };
        MemoryBuffer buffer(text);
        std::istream stream(&buffer);
        tinyobj::LoadObjWithCallback(stream, callbacks, this);
    }

    /// The parser read what the check counted.
    bool complete() const {
        return vertices_ == counts_.vertices && normals_ == counts_.normals &&
               part_.faceEnds.size() == counts_.faces;
    }
    std::optional<std::size_t> badVertex() const { return badVertex_; }
    std::optional<std::size_t> badNormal() const { return badNormal_; }

  private:
    void vertex(const glm::vec3& position) {
        // Written so that it fails for what is not a number, too.
        const bool usable = glm::all(glm::lessThanEqual(glm::abs(position), glm::vec3(kLargestCoordinate)));
        if (!usable && !badVertex_) badVertex_ = vertices_;
        if (vertices_ < counts_.vertices) file_.positions[before_.vertices + vertices_] = position;
        ++vertices_;
    }

    void normal(const glm::vec3& direction) {
        const float largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
        const bool usable = largest <= std::numeric_limits<float>::max();
        if (!usable && !badNormal_) badNormal_ = normals_;
        if (normals_ < counts_.normals) {
            file_.normals[before_.normals + normals_] =
                largest > 0.0f ? glm::normalize(direction / largest) : glm::vec3(0.0f);
        }
        ++normals_;
    }

    void face(std::span<const tinyobj::index_t> corners) {
        for (const tinyobj::index_t& corner : corners) {
            addNormal(corner.normal_index);
            part_.cornerVertices.push_back(resolve(corner.vertex_index, before_.vertices + vertices_));
        }
        part_.faceEnds.push_back(static_cast<std::uint32_t>(part_.cornerVertices.size()));
    }

    void addNormal(int index) {
        if (index == 0 && part_.cornerNormals.empty()) return;
        part_.cornerNormals.resize(part_.cornerVertices.size(), Geometry::kNoNormal);
        part_.cornerNormals.push_back(index == 0 ? Geometry::kNoNormal
                                                 : resolve(index, before_.normals + normals_));
    }

    static std::uint32_t resolve(int index, std::size_t seen) {
        return static_cast<std::uint32_t>(index > 0 ? index - 1 : static_cast<std::ptrdiff_t>(seen) + index);
    }

    ObjFile& file_;
    ObjPart& part_;
    const ObjCounts before_, counts_;
    std::size_t vertices_ = 0, normals_ = 0;
    std::optional<std::size_t> badVertex_, badNormal_;
};

/// Where the statement `keyword` stands for the (ordinal + 1)th time. Only for error messages.
std::size_t offsetOfStatement(std::string_view text, std::string_view keyword, std::size_t ordinal) {
    for (std::size_t begin = 0; begin < text.size(); begin = text.find('\n', begin) + 1) {
        const std::string_view line = trimmed(text.substr(begin, text.find('\n', begin) - begin));
        if (firstWord(line) == keyword && ordinal-- == 0) return begin;
    }
    return 0;
}

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

std::optional<TextProblem> readStretch(std::span<char> text, const Stretch& stretch, const ObjCounts& total,
                                       ObjFile& file, ObjPart& part) {
    part.offset = stretch.begin;
    if (auto problem = checkStatements(text, stretch.before, total, part.notes)) return problem;
    PartReader reader(file, part, stretch.before, stretch.counts);
    reader.read(text);
    const std::string_view view(text.data(), text.size());
    if (reader.badVertex()) {
        return TextProblem{offsetOfStatement(view, "v", *reader.badVertex()),
                           "a coordinate is not finite or too large",
                           fmt::format("expected at most {:g} in magnitude", kLargestCoordinate)};
    }
    if (reader.badNormal()) {
        return TextProblem{offsetOfStatement(view, "vn", *reader.badNormal()), "a normal is not finite",
                           "expected \"vn x y z\""};
    }
    if (!reader.complete())
        return TextProblem{0, "a statement was not understood", "expected a Wavefront OBJ file"};
    return std::nullopt;
}

}  // namespace

ObjFile parseObj(SourceText& text) {
    std::vector<Stretch> stretches = splitAtLines(text.view());
    const ObjCounts total = countAll(text.view(), stretches);
    constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
    if (total.vertices > kMost || total.normals > kMost || total.faces > kMost) {
        throw InputError(text.file(), "", "is too large", "expected fewer than 2^31 vertices and faces");
    }

    ObjFile file;
    file.positions.resize(total.vertices);
    file.normals.resize(total.normals);
    file.parts.resize(stretches.size());
    std::vector<std::optional<TextProblem>> problems(stretches.size());
    parallelFor(stretches.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::span<char> bytes(text.data() + stretches[i].begin,
                                        stretches[i].end - stretches[i].begin);
            problems[i] = readStretch(bytes, stretches[i], total, file, file.parts[i]);
        }
    });
    for (std::size_t i = 0; i < problems.size(); ++i) {
        if (!problems[i]) continue;
        problems[i]->offset += stretches[i].begin;
        text.fail(*problems[i]);
    }
    return file;
}

}  // namespace duolux
