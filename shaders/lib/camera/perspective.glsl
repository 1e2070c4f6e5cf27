// Pinhole camera.
#ifndef DUOLUX_LIB_CAMERA_PERSPECTIVE_GLSL
#define DUOLUX_LIB_CAMERA_PERSPECTIVE_GLSL

#include "shaders/lib/camera/camera_types.glsl"

// The ray begins at startDepth, just before the scene: from a distant origin, single precision could not separate the
// scene's triangles.
CameraRay perspectiveRay(DeviceCamera camera, vec2 filmPosition) {
    vec2 onPlane = onImagePlane(camera, filmPosition);
    vec3 across = camera.right * onPlane.x + camera.up * onPlane.y;
    return CameraRay(camera.start + across * camera.startDepth, normalize(camera.forward + across));
}

CameraConnection connectToPerspective(DeviceCamera camera, vec3 point) {
    vec3 offset = camera.position - point;
    CameraConnection c;
    c.distance = length(offset);
    c.direction = offset / c.distance;
    vec3 fromStart = point - camera.start;
    float depth = camera.startDepth + dot(fromStart, camera.forward);
    float cosine = depth / c.distance;
    c.visible = depth > 0.0;
    findPixel(camera, vec2(dot(fromStart, camera.right) / dot(camera.right, camera.right),
                           dot(fromStart, camera.up) / dot(camera.up, camera.up)) / depth, c);
    // The solid angle of a small patch of the image plane at distance 1 is cos^3 times its area.
    c.importance = 1.0 / (camera.area * cosine * cosine * cosine * c.distance * c.distance);
    return c;
}

#endif
