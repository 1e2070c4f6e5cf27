// Pinhole camera with a box filter of one pixel.
#ifndef DUOLUX_LIB_CAMERA_GLSL
#define DUOLUX_LIB_CAMERA_GLSL

#include "shaders/shared/path_layout.h"

struct CameraRay {
    vec3 origin;
    vec3 direction;  // unit
};

// Through a point of the image plane; position in pixels from the top left corner. The ray begins where the scene may:
// from far away single precision would not tell its triangles apart.
CameraRay cameraRay(PathParams params, vec2 position) {
    vec2 size = vec2(params.width, params.height);
    vec2 ndc = position / size * 2.0 - 1.0;
    vec3 across = params.cameraRight * ndc.x - params.cameraUp * ndc.y;
    return CameraRay(params.cameraStart + across * params.cameraStartDepth, normalize(params.cameraForward + across));
}

// How a point is seen. Every camera answers this: another than a pinhole would take two random numbers for the point on
// its lens, and divide by their density.
struct CameraConnection {
    bool visible;      // within the image
    uint pixel;
    vec3 direction;    // unit, from the point to the camera
    float distance;
    // Radiance that arrives at the camera per unit of solid angle, as a part of the image's mean: the importance W_e of
    // the pixel (box filter, per unit of image area) divided by the number of pixels. Steradian^-1.
    float importance;
};

CameraConnection connectToCamera(PathParams params, vec3 point) {
    vec3 offset = params.cameraPosition - point;
    CameraConnection c;
    c.distance = length(offset);
    c.direction = offset / c.distance;
    vec3 fromStart = point - params.cameraStart;
    float depth = params.cameraStartDepth + dot(fromStart, params.cameraForward);
    float cosine = depth / c.distance;
    vec2 ndc = vec2(dot(fromStart, params.cameraRight) / dot(params.cameraRight, params.cameraRight),
                    dot(fromStart, params.cameraUp) / dot(params.cameraUp, params.cameraUp)) / depth;
    vec2 position = vec2(0.5 + 0.5 * ndc.x, 0.5 - 0.5 * ndc.y) * vec2(params.width, params.height);
    // Not by clamping: a point beyond the edge belongs to no pixel.
    c.visible = depth > 0.0 && position.x >= 0.0 && position.y >= 0.0 && position.x < float(int(params.width)) &&
                position.y < float(int(params.height));
    uvec2 cell = c.visible ? uvec2(ivec2(position)) : uvec2(0u);
    c.pixel = cell.y * params.width + cell.x;
    // A patch of the image plane at distance 1 that is seen under the angle of this cosine has cos^3 times its area in
    // solid angle.
    c.importance = 1.0 / (params.imageArea * cosine * cosine * cosine);
    return c;
}

#endif
