// Pinhole camera.
#ifndef DUOLUX_LIB_CAMERA_PERSPECTIVE_GLSL
#define DUOLUX_LIB_CAMERA_PERSPECTIVE_GLSL

#include "shaders/lib/camera/camera_types.glsl"

// The ray begins where the scene may: from far away single precision would not tell its triangles apart.
CameraRay perspectiveRay(DeviceCamera camera, vec2 pixel) {
    vec2 onPlane = onImagePlane(camera, pixel);
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
    // A patch of the image plane at distance 1 that is seen under the angle of this cosine has cos^3 times its area in
    // solid angle.
    c.importance = 1.0 / (camera.area * cosine * cosine * cosine * c.distance * c.distance);
    return c;
}

#endif
