// Planes of triangles. A scene stores them (kPlanes) if surfaces coincide, which then share a bitwise identical plane,
// or if triangles are so large that single-precision corners locate points near the origin too coarsely. The kernel
// that includes this defines fetchPlaneTexel.
#ifndef DUOLUX_LIB_PLANE_GLSL
#define DUOLUX_LIB_PLANE_GLSL

#include "shaders/shared/bvh_layout.h"

layout(constant_id = kSpecPlanes) const bool kPlanes = false;

uvec4 fetchPlaneTexel(uint index);

// dot(normal, x) = offset
struct Plane {
    vec3 normal;  // unit, on the triangle's front side
    float offset;
};

Plane fetchPlane(uint triangle) {
    uvec4 texel = fetchPlaneTexel(triangle);
    return Plane(uintBitsToFloat(texel.xyz), uintBitsToFloat(texel.w));
}

// The distance to a plane along a ray. Bitwise identical for the two orientations of a plane.
float planeDistance(Plane plane, vec3 origin, vec3 direction) {
    precise float height = plane.offset - dot(plane.normal, origin);
    precise float t = height / dot(plane.normal, direction);
    return t;
}

// Projects a point onto the plane, to within planeError.
vec3 ontoPlane(Plane plane, vec3 point) {
    return point + plane.normal * (plane.offset - dot(plane.normal, point));
}

// Bound on the distance from the plane of a point returned by ontoPlane, and on the error of its height in
// planeDistance. It depends on the size of the point, not of the triangle. A multiple of the unit roundoff 2^-24 of a
// float.
float planeError(Plane plane, vec3 point) {
    vec3 size = abs(point);
    return (size.x + size.y + size.z + abs(plane.offset)) * (8.0 / 16777216.0);
}

// A ray crosses surfaces at equal distance in ascending order of these numbers: first the surfaces that it enters from
// the front, by ascending primitive, then the surfaces that it enters from the back, by descending primitive. A ray in
// the opposite direction crosses them in reverse order.
uint orderOfSurface(uint primitive, bool front) { return front ? primitive : ~primitive; }

#endif
