#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/scene/source_text.h"
#include "host/scene/tally.h"

namespace duolux {

/// How many of each statement an OBJ text holds.
struct ObjCounts {
    std::size_t vertices = 0, textureCoordinates = 0, normals = 0, faces = 0;

    ObjCounts& operator+=(const ObjCounts& other);
};

/// A quick count: only the first letters of each line are looked at. `text` is made of whole lines.
ObjCounts countStatements(std::string_view text);

enum class ObjKeyword {
    kNone,
    kVertex,
    kTexture,
    kNormal,
    kFace,
    kSmoothing,
    kMaterial,
    kLibrary,
    kNeutral,  ///< without meaning for a picture of triangles: names, points and lines, display hints
    kUnknown
};
ObjKeyword objKeywordOf(std::string_view word);

/// What is not as it should be (or not used), and does not keep a file from being loaded.
enum class ObjOddity {
    kUnknownStatement,
    kShortFace,
    kBadFace,
    kUnusedVertex,
    kExtraNumbers,
    kExtraWords,
    kNormal,
    kNormalIndex,
    kTexture,
    kTextureIndex,
    kTrailingSlash,
    kCornerRest,
    kSmoothing,
    kMaterialName,
    kLibraryName,
    kVertexColour,
    kVertexWeight,
    kCount
};

/// What is noted beside the geometry, for the statements that matter to a loader of whole scenes.
struct ObjNotes {
    struct Smoothing {
        std::size_t face;     ///< first face it holds for, counted within the part of the text
        std::uint32_t group;  ///< 0: off
    };
    std::vector<Smoothing> smoothing;
    std::vector<std::string> libraries;  ///< the rest of each mtllib line
    Tally<ObjOddity> oddities;           ///< offsets are relative to the part
};

/// One warning for each kind of oddity: the first line, how many, and what becomes of them.
void warnOfOddities(const SourceText& text, const Tally<ObjOddity>& oddities,
                    std::vector<std::string>& warnings);

}  // namespace duolux
