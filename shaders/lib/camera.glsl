// Pinhole camera with a box filter of one pixel.
#ifndef DUOLUX_LIB_CAMERA_GLSL
#define DUOLUX_LIB_CAMERA_GLSL

#include "shaders/shared/path_layout.h"

// Unit direction through a point of the image plane; position in pixels from the top left corner.
vec3 cameraDirection(PathParams params, vec2 position) {
    vec2 size = vec2(params.width, params.height);
    vec2 ndc = position / size * 2.0 - 1.0;
    return normalize(params.cameraForward + params.cameraRight * ndc.x - params.cameraUp * ndc.y);
}

#endif
