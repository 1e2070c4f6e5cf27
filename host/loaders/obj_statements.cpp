#include "host/loaders/obj_statements.h"

#include <fmt/format.h>

#include <cstring>

#include "host/base/printable.h"
#include "host/loaders/tally.h"

namespace duolux {

namespace {

constexpr OddityText<ObjOddity> kObjOddities[] = {
    {ObjOddity::kShortFace, "a face of fewer than 3 corners", "left out"},
    {ObjOddity::kBadFace, "a face with a vertex index that is 0, out of range or not a number", "left out"},
    {ObjOddity::kUnusedVertex, "a vertex that is not three finite numbers, or too large", "no face uses it"},
    {ObjOddity::kExtraNumbers, "more numbers than the statement has", "the last ones are ignored"},
    {ObjOddity::kExtraWords, "extra values that are not finite numbers", "ignored"},
    {ObjOddity::kNormal, "a normal that is not three finite numbers", "triangles that name it are flat"},
    {ObjOddity::kNormalIndex, "a normal index that is 0 or out of range", "such triangles are flat"},
    {ObjOddity::kTexture, "a texture coordinate that is not one to three finite numbers, or too large",
     "triangles that name it have none"},
    {ObjOddity::kTextureIndex, "a texture coordinate index that is 0 or out of range",
     "such triangles have none"},
    {ObjOddity::kTrailingSlash, "a corner that ends in \"/\"", "read without it"},
    {ObjOddity::kCornerRest, "a corner with more than v/vt/vn, as in 1.0 or 1/1/1/1", "the rest is ignored"},
    {ObjOddity::kSmoothing, "a smoothing group that is neither a number nor \"off\"",
     "\"on\" is read as group 1, anything else as off"},
    {ObjOddity::kMaterialName, "usemtl without a name", "its faces are grey 0.8"},
    {ObjOddity::kLibraryName, "mtllib without a name", "ignored"},
    {ObjOddity::kVertexColour, "a vertex whose colour is not between 0 and 1", "clamped"},
    {ObjOddity::kVertexWeight, "a vertex with a weight w other than 1", "w is not used"},
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
    const auto isBlank = [](char c) { return c == ' ' || c == '\t'; };
    const auto endsWord = [&](char c) { return isBlank(c) || c == '\n' || c == '\r'; };
    ObjCounts counts;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (at != end) {
        while (isBlank(*at))
            ++at;
        if (*at == 'f') {
            if (endsWord(at[1])) ++counts.faces;
        } else if (*at == 'v') {
            if (endsWord(at[1])) {
                ++counts.vertices;
            } else if (endsWord(at[2])) {
                if (at[1] == 't') ++counts.textureCoordinates;
                if (at[1] == 'n') ++counts.normals;
            }
        }
        at = static_cast<const char*>(std::memchr(at, '\n', static_cast<std::size_t>(end - at))) + 1;
    }
    return counts;
}

ObjKeyword objKeywordOf(std::string_view word) {
    if (word.empty() || word.front() == '#') return ObjKeyword::kNone;
    if (word == "v") return ObjKeyword::kVertex;
    if (word == "f") return ObjKeyword::kFace;
    if (word == "vn") return ObjKeyword::kNormal;
    if (word == "vt") return ObjKeyword::kTexture;
    if (word == "s") return ObjKeyword::kSmoothing;
    if (word == "usemtl") return ObjKeyword::kMaterial;
    if (word == "mtllib") return ObjKeyword::kLibrary;
    static constexpr std::array<std::string_view, 12> kNeutral{
        "g", "o", "l", "p", "vp", "lod", "bevel", "c_interp", "d_interp", "usemap", "maplib", "mg"};
    for (const std::string_view neutral : kNeutral) {
        if (word == neutral) return ObjKeyword::kNeutral;
    }
    return ObjKeyword::kUnknown;
}

void warnOfOddities(const SourceText& text, const Tally<ObjOddity>& oddities,
                    std::vector<std::string>& warnings) {
    if (const auto& unknown = oddities[ObjOddity::kUnknownStatement]; unknown.count > 0) {
        warnings.push_back(fmt::format("{}: line {}: {} is not supported; {} such line{} ignored",
                                       text.file(), text.lineOf(unknown.first),
                                       inQuotes(firstWord(text.view().substr(unknown.first))), unknown.count,
                                       unknown.count == 1 ? " is" : "s are"));
    }
    if (const auto& [faces, first] = oddities[ObjOddity::kBadVertex]; faces > 0) {
        warnings.push_back(fmt::format(
            "{}: line {}: a vertex that is not three finite numbers: {} face{} with such vertices "
            "{} left out",
            text.file(), text.lineOf(first), faces, faces == 1 ? "" : "s", faces == 1 ? "is" : "are"));
    }
    for (const auto& [kind, what, consequence] : kObjOddities) {
        const auto& [count, first] = oddities[kind];
        if (count == 0) continue;
        const std::string more = andMore(count);
        warnings.push_back(
            fmt::format("{}: line {}: {}{}: {}", text.file(), text.lineOf(first), what, more, consequence));
    }
}

}  // namespace duolux
