// Bounds on rounding errors, shared by C++ and GLSL.
#ifndef DUOLUX_SHADERS_SHARED_ROUNDING_H
#define DUOLUX_SHADERS_SHARED_ROUNDING_H

#include "shaders/shared/types.h"

DUOLUX_BEGIN

// Bound on the rounding error of a point on a triangle, relative to the largest coordinate of its corners: a
// multiple of the unit roundoff 2^-24 of a float.
DUOLUX_CONST float kPointError = 32.0f / 16777216.0f;

DUOLUX_END
#endif
