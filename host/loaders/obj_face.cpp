#include "host/loaders/obj_face.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <string>

#include "host/base/printable.h"
#include "host/loaders/obj_tokens.h"
#include "host/scene/scene.h"

namespace duolux {

namespace {

bool endsCorner(char c) {
    return isBlank(c) || isLineEnd(c) || c == '#' || c == ',';
}

std::optional<std::uint32_t> resolve(std::int64_t index, std::size_t seen, std::size_t total) {
    const std::int64_t resolved = index > 0 ? index - 1 : static_cast<std::int64_t>(seen) + index;
    const std::size_t limit = index > 0 ? total : seen;
    if (resolved < 0 || resolved >= static_cast<std::int64_t>(limit)) return std::nullopt;
    return static_cast<std::uint32_t>(resolved);
}

std::string indexProblem(const char* one, std::string_view index) {
    return fmt::format("{} index {} is out of range", one, shortened(index));
}

std::string indexRemedy(const char* many, std::int64_t index, std::size_t seen, std::size_t total) {
    return fmt::format("there are {} {} {}", index < 0 ? seen : total, many,
                       index < 0 ? "before this line" : "in the file");
}

}  // namespace

void ObjFaceReader::read(const char* line, const char* arguments, const ObjCounts& seen) {
    const std::size_t first = part_.cornerVertices.size();
    bad_.reset();
    for (const char* at = arguments; (at = nextArgument(at)) != nullptr;) {
        if (*at == ',') {
            complaints_.tolerate(ObjOddity::kCornerRest, at, [&] { complaints_.report(notACorner(at)); });
            ++at;
        } else {
            at = readCorner(at, seen);
        }
        if (complaints_.problem()) return;
    }
    const std::size_t corners = part_.cornerVertices.size() - first;
    if (corners >= 3 && !bad_) {
        part_.faceEnds.push_back(static_cast<std::uint32_t>(part_.cornerVertices.size()));
        return;
    }
    leaveOut(line, first);
    if (corners < 3) {
        complaints_.tolerate(ObjOddity::kShortFace, line, [&] {
            complaints_.report(line, fmt::format("a face of {} corners", corners),
                               "expected at least 3, as in \"f 1 2 3\"");
        });
    }
}

void ObjFaceReader::leaveOut(const char* line, std::size_t firstCorner) {
    const bool isShort = part_.cornerVertices.size() - firstCorner < 3;
    part_.cornerVertices.resize(firstCorner);
    part_.cornerNormals.resize(std::min(part_.cornerNormals.size(), firstCorner));
    part_.cornerUvs.resize(std::min(part_.cornerUvs.size(), firstCorner));
    if (isShort) return;
    complaints_.tolerate(ObjOddity::kBadFace, line, [&] { complaints_.report(*bad_); });
    if (!part_.badFace) part_.badFace = bad_;
}

ObjFaceReader::Index ObjFaceReader::readIndex(const char* at) const {
    const char* const first = *at == '+' && at[1] != '-' ? at + 1 : at;
    std::int64_t value = 0;
    const auto [past, error] = std::from_chars(first, end_, value);
    if (error == std::errc::invalid_argument) return {};
    if (error != std::errc()) value = std::numeric_limits<std::int64_t>::max();
    return {std::string_view(at, static_cast<std::size_t>(past - at)), value};
}

/// Reads v, v/vt, v//vn or v/vt/vn, and skips trailing text that other programs ignore. Returns the end.
const char* ObjFaceReader::readCorner(const char* corner, const ObjCounts& seen) {
    const Index vertex = readIndex(corner);
    const char* at = corner + vertex.text.size();
    bool isOdd = false;
    const auto passOver = [&] {
        for (; *at != '/' && !endsCorner(*at); ++at)
            isOdd = true;
    };
    Index texture, normal;
    passOver();
    if (*at == '/') {
        texture = readIndex(++at);
        at += texture.text.size();
        passOver();
        if (*at == '/') {
            normal = readIndex(++at);
            at += normal.text.size();
        }
    }
    const bool endsInSlash = at[-1] == '/' && endsCorner(*at) && at != corner;
    for (; !endsCorner(*at); ++at)
        isOdd = true;
    for (; *at == ','; ++at)
        isOdd = true;
    if (vertex.text.empty()) {
        if (!bad_) bad_ = notACorner(corner);
        isOdd = false;
    }
    if (isOdd || endsInSlash) {
        complaints_.tolerate(isOdd ? ObjOddity::kCornerRest : ObjOddity::kTrailingSlash, corner,
                             [&] { complaints_.report(notACorner(corner)); });
    }
    addUv(corner, texture, seen);
    addNormal(corner, normal, seen);
    const auto index = resolve(vertex.value, seen.vertices, target_.total.vertices);
    if (!index && !bad_) {
        bad_ = TextProblem{complaints_.offsetOf(corner), indexProblem("vertex", vertex.text),
                           indexRemedy("vertices", vertex.value, seen.vertices, target_.total.vertices)};
    }
    part_.cornerVertices.push_back(index.value_or(0));
    return at;
}

void ObjFaceReader::addNormal(const char* corner, const Index& normal, const ObjCounts& seen) {
    const auto index = resolve(normal.value, seen.normals, target_.total.normals);
    if (!normal.text.empty() && !index) {
        complaints_.tolerate(ObjOddity::kNormalIndex, corner, [&] {
            complaints_.report(corner, indexProblem("normal", normal.text),
                               indexRemedy("normals", normal.value, seen.normals, target_.total.normals));
        });
    }
    addOptional(normal.text.empty() ? std::nullopt : index, part_.cornerNormals, Geometry::kNoNormal);
}

void ObjFaceReader::addUv(const char* corner, const Index& uv, const ObjCounts& seen) {
    const auto index = resolve(uv.value, seen.textureCoordinates, target_.total.textureCoordinates);
    if (!uv.text.empty() && !index) {
        complaints_.tolerate(ObjOddity::kTextureIndex, corner, [&] {
            complaints_.report(corner, indexProblem("texture coordinate", uv.text),
                               indexRemedy("texture coordinates", uv.value, seen.textureCoordinates,
                                           target_.total.textureCoordinates));
        });
    }
    addOptional(uv.text.empty() ? std::nullopt : index, part_.cornerUvs, Geometry::kNoUv);
}

/// Adds the index of the corner that comes next. Nothing is stored before the first corner that has one.
void ObjFaceReader::addOptional(std::optional<std::uint32_t> index, std::vector<std::uint32_t>& indices,
                                std::uint32_t none) const {
    if (!index && indices.empty()) return;
    indices.resize(part_.cornerVertices.size(), none);
    indices.push_back(index.value_or(none));
}

TextProblem ObjFaceReader::notACorner(const char* corner) const {
    return {complaints_.offsetOf(corner),
            fmt::format("{} is not a corner of a face", inQuotes(tokenAt(corner))),
            "expected indices as in 1, 1/1, 1//1 or 1/1/1"};
}

}  // namespace duolux
