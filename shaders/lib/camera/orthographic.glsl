// Camera with parallel rays.
#ifndef DUOLUX_LIB_CAMERA_ORTHOGRAPHIC_GLSL
#define DUOLUX_LIB_CAMERA_ORTHOGRAPHIC_GLSL

#include "shaders/lib/camera/camera_types.glsl"

CameraRay orthographicRay(DeviceCamera camera, vec2 filmPosition) {
    vec2 onPlane = onImagePlane(camera, filmPosition);
    return CameraRay(camera.start + camera.right * onPlane.x + camera.up * onPlane.y, camera.forward);
}

CameraConnection connectToOrthographic(DeviceCamera camera, vec3 point) {
    vec3 fromStart = point - camera.start;
    CameraConnection c;
    c.distance = camera.startDepth + dot(fromStart, camera.forward);
    c.direction = -camera.forward;
    c.visible = c.distance > 0.0;
    findPixel(camera, vec2(dot(fromStart, camera.right) / dot(camera.right, camera.right),
                           dot(fromStart, camera.up) / dot(camera.up, camera.up)), c);
    c.importance = 1.0 / camera.area;
    return c;
}

#endif
