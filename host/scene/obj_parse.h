#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "host/scene/obj_statements.h"
#include "host/scene/source_text.h"

namespace duolux {

/// The faces of a stretch of an OBJ file: polygons whose indices are resolved and in range.
struct ObjPart {
    struct MaterialChange {
        std::size_t face;  ///< first face of the part that it holds for
        std::string name;
    };

    std::size_t offset = 0;                     ///< of its first byte in the file
    std::vector<std::uint32_t> faceEnds;        ///< per face: past its last corner
    std::vector<std::uint32_t> cornerVertices;  ///< per corner, into ObjFile::positions
    std::vector<std::uint32_t> cornerNormals;   ///< per corner, into ObjFile::normals or Geometry::kNoNormal;
                                                ///< empty if no corner has one
    std::vector<MaterialChange> materials;
    ObjNotes notes;
};

struct ObjFile {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  ///< unit length, or zero where the file has a zero normal
    std::vector<ObjPart> parts;      ///< in the order of the file
};

/// Reads the statements of an OBJ file, on all cores. Throws InputError for the first that is malformed.
ObjFile parseObj(SourceText& text);

}  // namespace duolux
