// The results that every camera in this folder returns.
#ifndef DUOLUX_LIB_CAMERA_CAMERA_TYPES_GLSL
#define DUOLUX_LIB_CAMERA_CAMERA_TYPES_GLSL

#include "shaders/shared/camera_layout.h"

// A ray from the camera. Its importance is 1 (box filter of one pixel): the radiance along it is the pixel's radiance.
struct CameraRay {
    vec3 origin;
    vec3 direction;  // unit
};

// How the camera sees a point of the scene.
struct CameraConnection {
    bool visible;    // within the image
    uint pixel;      // row by row from the top left
    vec3 direction;  // unit, from the point to the camera
    float distance;  // from the point to the origin of the camera's ray
    // Contribution of flux through unit area at the point, facing the camera, to the mean radiance of the image (m^-2):
    // the importance W_e of the pixel (box filter, per unit of image area), divided by the number of pixels, times the
    // solid angle (or the area) of the image plane as seen from the point.
    float importance;
};

// Position on the image plane, both coordinates from -1 to 1 with y upwards. `filmPosition`: in pixels from the top
// left corner of the image.
vec2 onImagePlane(DeviceCamera camera, vec2 filmPosition) {
    vec2 ndc = filmPosition / vec2(camera.width, camera.height) * 2.0 - 1.0;
    return vec2(ndc.x, -ndc.y);
}

// The pixel at a position on the image plane. A position beyond an edge is not visible.
void findPixel(DeviceCamera camera, vec2 onPlane, inout CameraConnection connection) {
    vec2 position = vec2(0.5 + 0.5 * onPlane.x, 0.5 - 0.5 * onPlane.y) * vec2(camera.width, camera.height);
    bool inside = position.x >= 0.0 && position.y >= 0.0 && position.x < float(int(camera.width)) &&
                  position.y < float(int(camera.height));
    connection.visible = connection.visible && inside;
    uvec2 cell = connection.visible ? uvec2(ivec2(position)) : uvec2(0u);
    connection.pixel = cell.y * camera.width + cell.x;
}

#endif
