// Planes of triangles, where the scene stores them (kPlanes): where surfaces coincide, which then lie in one plane to the
// bit, or triangles are so large that their corners do not tell where a point near the origin is. The kernel that includes
// this defines fetchPlaneTexel.
#ifndef DUOLUX_LIB_PLANE_GLSL
#define DUOLUX_LIB_PLANE_GLSL

#include "shaders/shared/bvh_layout.h"

layout(constant_id = kSpecPlanes) const bool kPlanes = false;

uvec4 fetchPlaneTexel(uint index);

// dot(normal, x) = offset
struct Plane {
    vec3 normal;   // unit, of the triangle's front
    float offset;
};

Plane fetchPlane(uint triangle) {
    uvec4 texel = fetchPlaneTexel(triangle);
    return Plane(uintBitsToFloat(texel.xyz), uintBitsToFloat(texel.w));
}

// Along a ray; the same to the bit for the two orientations of a plane.
float planeDistance(Plane plane, vec3 origin, vec3 direction) {
    precise float height = plane.offset - dot(plane.normal, origin);
    precise float t = height / dot(plane.normal, direction);
    return t;
}

// The nearest point of the plane, but for planeError.
vec3 ontoPlane(Plane plane, vec3 point) {
    return point + plane.normal * (plane.offset - dot(plane.normal, point));
}

// Bound on the distance from the plane of a point that ontoPlane has made, and of its height as planeDistance finds it: it
// follows from the size of the point, not of the triangle. A multiple of the float's unit roundoff 2^-24.
float planeError(Plane plane, vec3 point) {
    vec3 size = abs(point);
    return (size.x + size.y + size.z + abs(plane.offset)) * (8.0 / 16777216.0);
}

// Surfaces at one distance are met in the order of these numbers: those whose front a ray comes to first, by their
// primitives, then those that it leaves by their front, the other way round. So a ray back meets them in reverse.
uint orderOfSurface(uint primitive, bool front) { return front ? primitive : ~primitive; }

#endif
