// A point on a surface where light may scatter or begin. The kernel that includes this defines fetchNormalTexel, and what
// plane.glsl and fetch_triangle.glsl need.
#ifndef DUOLUX_LIB_SURFACE_GLSL
#define DUOLUX_LIB_SURFACE_GLSL

#include "shaders/lib/fetch_triangle.glsl"
#include "shaders/lib/intersect.glsl"
#include "shaders/lib/normals.glsl"
#include "shaders/lib/plane.glsl"
#include "shaders/shared/bvh_layout.h"

struct SurfacePoint {
    vec3 position;         // moved off the surface to the side that the ray came from, unless it is behind others
    vec3 geometricNormal;  // unit, to that side
    vec3 shadingNormal;    // unit, the same side of the surface
    uint triangle;         // its index among the device's
    uint behindOthers;     // 1: other surfaces lie in the same place, on that side
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
    point.triangle = triangle;
    point.behindOthers = 0u;
    return point;
}

// The same point by the triangle's plane, if there are planes. `at`: where the ray met it.
SurfacePoint placedByPlane(SurfacePoint point, vec3 at, bool behindOthers) {
    if (!kPlanes) return point;
    Plane plane = fetchPlane(point.triangle);
    vec3 onSurface = ontoPlane(plane, at);
    point.position = behindOthers ? onSurface : onSurface + point.geometricNormal * planeError(plane, onSurface);
    point.behindOthers = behindOthers ? 1u : 0u;
    return point;
}

// Where a ray begins: at a point, after the surfaces at this distance up to that order.
struct RayBegin {
    vec3 origin;
    float t;
    uint order;
};

// A ray that leaves a point of a surface on the side that the point's normals are on. From behind others it meets those.
RayBegin leaveSurface(SurfacePoint point, vec3 direction) {
    if (!kPlanes || point.behindOthers == 0u) return RayBegin(point.position, 0.0, kNoTriangle);
    Plane plane = fetchPlane(point.triangle);
    return RayBegin(point.position, planeDistance(plane, point.position, direction),
                    orderOfSurface(fetchTriangle(point.triangle).primitive, dot(plane.normal, direction) < 0.0));
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
