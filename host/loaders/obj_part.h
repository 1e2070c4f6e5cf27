#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/loaders/obj_statements.h"
#include "host/loaders/source_text.h"
#include "host/loaders/tally.h"
#include "host/loaders/uv_range.h"

namespace duolux {

/// The faces of one part of an OBJ file: polygons with resolved indices that are in range.
struct ObjPart {
    struct MaterialChange {
        std::size_t face;  ///< first face of the part to which it applies
        std::string name;  ///< empty: the default
    };
    /// An invalid vertex.
    struct BadVertex {
        std::size_t index;  ///< into the vertices of the file
        std::size_t
            offset;  ///< of the word that is not a finite number, or of a statement with too few numbers
        std::optional<int> tooFew = std::nullopt;  ///< the number of numbers, if too few
    };

    std::size_t offset = 0;                     ///< of the part's first byte in the file
    std::size_t firstVertex = 0;                ///< of the part, in the file
    std::vector<std::uint32_t> faceEnds;        ///< per face: index past its last corner
    std::vector<std::uint32_t> cornerVertices;  ///< per corner, into the vertices of the file
    std::vector<std::uint32_t> cornerNormals;   ///< per corner, into the normals of the file or kNoNormal;
                                                ///< may end early, at the last corner with one
    std::vector<std::uint32_t> cornerUvs;       ///< the same of texture coordinates; kNoUv
    std::vector<glm::vec3> colours;  ///< per vertex of the part, linear; may end early: the rest is white
    std::vector<MaterialChange> materials;
    std::vector<BadVertex> badVertices;
    std::optional<TextProblem> badFace;  ///< the first face that is left out because of its vertices
    ObjNotes notes;
};

/// The destination of the vertices, normals and texture coordinates of one part.
struct ObjPartTarget {
    std::span<glm::dvec3> positions;  ///< of the whole file
    std::span<glm::vec3> normals;     ///< of the whole file: unit, or zero if invalid
    std::span<glm::vec2> uvs;         ///< of the whole file, v down the image; kBadUv if invalid
    ObjCounts before;                 ///< statements of the file before the part
    ObjCounts total;                  ///< of the whole file
};

/// Reads whole lines of an OBJ file. Invalid vertices are recorded, because it is not known yet whether faces
/// use them. Returns the first problem; its offset, like all offsets in `part`, is relative to the text.
std::optional<TextProblem> readObjPart(std::string_view text, const ObjPartTarget& target, Reading reading,
                                       ObjPart& part);

/// Removes the faces that have one of the `bad` vertices of the file. Returns the number of these faces.
std::size_t leaveOutFaces(ObjPart& part, const std::vector<bool>& bad);

}  // namespace duolux
