// A point on a surface where light may scatter. The kernel that includes this defines fetchNormalTexel.
#ifndef DUOLUX_LIB_SURFACE_GLSL
#define DUOLUX_LIB_SURFACE_GLSL

#include "shaders/lib/intersect.glsl"
#include "shaders/lib/normals.glsl"
#include "shaders/shared/bvh_layout.h"

struct SurfacePoint {
    vec3 position;         // moved off the surface to the side that the ray came from
    vec3 geometricNormal;  // unit, to that side
    vec3 shadingNormal;    // unit, the same side of the surface
};

// `normal`: unit, of the triangle's front; `triangle`: its index among the device's.
SurfacePoint surfacePoint(Triangle tri, uint triangle, vec2 barycentric, vec3 normal, vec3 rayDirection,
                          bool smoothNormals) {
    float cosine = dot(normal, rayDirection);
    SurfacePoint point;
    point.geometricNormal = cosine < 0.0 ? normal : -normal;
    point.shadingNormal = point.geometricNormal;
    if (smoothNormals && (tri.materialFlags & kTriangleSmooth) != 0u) {
        vec3 smoothed = shadingNormal(triangle, barycentric);
        point.shadingNormal = dot(smoothed, point.geometricNormal) < 0.0 ? -smoothed : smoothed;
    }
    point.position = pointOnTriangle(tri, barycentric) + point.geometricNormal * pointError(tri);
    return point;
}

// What gathering does at a point with a shading normal is |wi . Ns| in place of |wi . Ng|, wi towards the light. The
// adjoint of that is not the same with the roles of the directions exchanged: a particle that comes in from wi is
// scattered by f |wi . Ns| / |wi . Ng|, then by the cosine to the geometric normal (Veach, "Robust Monte Carlo Methods
// for Light Transport Simulation", 1997, section 5.3). Zero where the two normals see wi on different sides.
float shadingAdjoint(SurfacePoint point, vec3 wi) {
    float cosShading = dot(point.shadingNormal, wi);
    float cosGeometric = dot(point.geometricNormal, wi);
    return cosShading > 0.0 && cosGeometric > 0.0 ? cosShading / cosGeometric : 0.0;
}

// A direction in the frame whose z axis is `normal`, unit vectors both.
vec3 toFrame(vec3 normal, vec3 direction) {
    vec3 tangent, bitangent;
    orthonormalBasis(normal, tangent, bitangent);
    return vec3(dot(tangent, direction), dot(bitangent, direction), dot(normal, direction));
}

vec3 fromFrame(vec3 normal, vec3 local) {
    vec3 tangent, bitangent;
    orthonormalBasis(normal, tangent, bitangent);
    return normalize(tangent * local.x + bitangent * local.y + normal * local.z);
}

#endif
