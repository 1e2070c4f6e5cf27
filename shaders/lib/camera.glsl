// Dispatches to the scene's kind of camera: the ray through a point of the image, and the connection from a point of
// the scene to the camera.
#ifndef DUOLUX_LIB_CAMERA_GLSL
#define DUOLUX_LIB_CAMERA_GLSL

#include "shaders/lib/camera/orthographic.glsl"
#include "shaders/lib/camera/perspective.glsl"

layout(constant_id = kSpecCamera) const uint kCamera = kCameraPerspective;

// The top left corner of the pixel with this number, in pixels from the top left corner of the image.
vec2 pixelCorner(DeviceCamera camera, uint pixel) {
    return vec2(float(int(pixel % camera.width)), float(int(pixel / camera.width)));
}

// `filmPosition`: in pixels from the top left corner of the image.
CameraRay cameraRay(DeviceCamera camera, vec2 filmPosition) {
    if (kCamera == kCameraOrthographic) return orthographicRay(camera, filmPosition);
    return perspectiveRay(camera, filmPosition);
}

CameraConnection connectToCamera(DeviceCamera camera, vec3 point) {
    if (kCamera == kCameraOrthographic) return connectToOrthographic(camera, point);
    return connectToPerspective(camera, point);
}

#endif
