#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/scene/obj_statements.h"
#include "host/scene/source_text.h"
#include "host/scene/tally.h"

namespace duolux {

/// The faces of a stretch of an OBJ file: polygons whose indices are resolved and in range.
struct ObjPart {
    struct MaterialChange {
        std::size_t face;  ///< first face of the part that it holds for
        std::string name;  ///< empty: the default
    };
    /// A vertex that cannot be used.
    struct BadVertex {
        std::size_t index;  ///< into the vertices of the file
        std::size_t
            offset;  ///< of the word that is no finite number, or of the statement if there are too few
        std::optional<int> tooFew = std::nullopt;  ///< how many, then
    };

    std::size_t offset = 0;                     ///< of its first byte in the file
    std::vector<std::uint32_t> faceEnds;        ///< per face: past its last corner
    std::vector<std::uint32_t> cornerVertices;  ///< per corner, into the vertices of the file
    std::vector<std::uint32_t> cornerNormals;   ///< per corner, into the normals of the file or kNoNormal;
                                                ///< empty if no corner has one
    std::vector<MaterialChange> materials;
    std::vector<BadVertex> badVertices;
    std::optional<TextProblem> badFace;  ///< the first that is left out because of its vertices
    ObjNotes notes;
};

/// Where the vertices and normals of one part go.
struct ObjPartTarget {
    std::span<glm::dvec3> positions;  ///< of all the file
    std::span<glm::vec3> normals;     ///< of all the file: unit length, or zero where there is none
    ObjCounts before;                 ///< statements of the file ahead of the part
    ObjCounts total;                  ///< of the whole file
};

/// Reads whole lines of an OBJ file. Vertices that cannot be used are noted: they matter only if a face uses
/// them. Returns the first problem; its offset, as all in `part`, is relative to the text.
std::optional<TextProblem> readObjPart(std::string_view text, const ObjPartTarget& target, Reading reading,
                                       ObjPart& part);

}  // namespace duolux
