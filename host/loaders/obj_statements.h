#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/loaders/source_text.h"
#include "host/loaders/tally.h"

namespace duolux {

/// The numbers of statements in an OBJ text.
struct ObjCounts {
    std::size_t vertices = 0, textureCoordinates = 0, normals = 0, faces = 0;

    ObjCounts& operator+=(const ObjCounts& other);
};

/// Counts statements quickly, by the first letters of each line. `text` consists of whole lines.
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
    kNeutral,  ///< no effect on an image of triangles: names, points and lines, display hints
    kUnknown
};
ObjKeyword objKeywordOf(std::string_view word);

/// Errors and unused values that do not prevent a file from being loaded.
enum class ObjOddity {
    kUnknownStatement,
    kShortFace,
    kBadFace,
    kUnusedVertex,
    kBadVertex,  ///< counts the faces that are left out, at the first such vertex
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

/// Information other than the geometry that a loader of whole scenes needs.
struct ObjNotes {
    struct Smoothing {
        std::size_t face;     ///< first face to which it applies, counted within the part of the text
        std::uint32_t group;  ///< 0: off
    };
    std::vector<Smoothing> smoothing;
    std::vector<std::string> libraries;  ///< the arguments of each mtllib line
    Tally<ObjOddity> oddities;           ///< offsets are relative to the part
};

/// One warning for each kind of oddity: the first line, the number, and the consequence.
void warnOfOddities(const SourceText& text, const Tally<ObjOddity>& oddities,
                    std::vector<std::string>& warnings);

}  // namespace duolux
