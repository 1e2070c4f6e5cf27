// The record of a camera, shared by C++ and GLSL (scalar block layout).
#ifndef DUOLUX_SHADERS_SHARED_CAMERA_LAYOUT_H
#define DUOLUX_SHADERS_SHARED_CAMERA_LAYOUT_H

#include "shaders/shared/kernel_interface.h"

DUOLUX_BEGIN

// Kinds of cameras, and their number.
DUOLUX_CONST uint kCameraPerspective = 0u;
DUOLUX_CONST uint kCameraOrthographic = 1u;
DUOLUX_CONST uint kCameraKinds = 2u;

struct DeviceCamera {
    vec3 position;
    uint width;    // of the image, in pixels
    vec3 forward;  // unit
    uint height;   // in pixels
    // Half the width of the image plane: perspective: at distance 1; orthographic: in scene units.
    vec3 right;
    float area;        // of the image plane
    vec3 up;           // half its height
    float startDepth;  // distance ahead of the camera at which rays begin; above 0 for a distant scene
    vec3 start;        // the point on the camera's axis at that depth
};

#ifdef __cplusplus
static_assert(sizeof(DeviceCamera) == 76);
#endif

DUOLUX_END
#endif
