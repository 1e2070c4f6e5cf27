#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "host/loaders/obj_part.h"
#include "host/loaders/obj_statements.h"
#include "host/loaders/rounding.h"
#include "host/loaders/source_text.h"
#include "host/loaders/tally.h"

namespace duolux {

struct ObjFile {
    RoundedPositions rounded;
    std::vector<glm::vec3> normals;  ///< unit, or zero if the file's normal is invalid
    std::vector<glm::vec2> uvs;      ///< v down the image, or kBadUv
    std::vector<ObjPart> parts;      ///< in the order of the file
    Tally<ObjOddity> oddities;       ///< of all parts
};

/// Reads the statements of an OBJ file on all cores. Throws InputError for the first invalid one.
ObjFile parseObj(const SourceText& text, Reading reading);

}  // namespace duolux
