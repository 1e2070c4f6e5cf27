#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "host/loaders/obj_part.h"
#include "host/loaders/obj_statements.h"
#include "host/loaders/source_text.h"
#include "host/loaders/tally.h"

namespace duolux {

/// The effect of rounding to floats on the vertices that faces use.
struct RoundingLoss {
    std::size_t vertices = 0;  ///< number of vertices moved by more than kUnnoticed of a typical edge
    double largest = 0.0;      ///< the largest distance
    double typicalEdge = 0.0;
};

struct ObjFile {
    std::vector<glm::vec3> positions;  ///< relative to `origin`
    glm::dvec3 origin{0.0};            ///< see originFor
    RoundingLoss loss;
    std::vector<glm::vec3> normals;  ///< unit, or zero if the file's normal is invalid
    std::vector<ObjPart> parts;      ///< in the order of the file
    Tally<ObjOddity> oddities;       ///< of all parts
};

/// Reads the statements of an OBJ file on all cores. Throws InputError for the first invalid one.
ObjFile parseObj(const SourceText& text, Reading reading);

}  // namespace duolux
