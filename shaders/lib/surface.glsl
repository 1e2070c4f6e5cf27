// A point on a surface at which a path scatters or starts. The kernel that includes this defines fetchNormalTexel and
// the functions that plane.glsl and fetch_triangle.glsl need.
#ifndef DUOLUX_LIB_SURFACE_GLSL
#define DUOLUX_LIB_SURFACE_GLSL

#include "shaders/lib/fetch_triangle.glsl"
#include "shaders/lib/intersect.glsl"
#include "shaders/lib/normals.glsl"
#include "shaders/lib/plane.glsl"
#include "shaders/shared/bvh_layout.h"

struct SurfacePoint {
    vec3 position;         // offset from the surface to the side that the ray came from, unless behindOthers is 1
    vec3 geometricNormal;  // unit, on that side
    vec3 shadingNormal;    // unit, on that side
    uint triangle;         // index in device memory
    uint behindOthers;     // 1: coincident surfaces lie before this one on that side
    float offset;          // distance of the position from the surface
};

// `normal`: unit, on the triangle's front side; `triangle`: its index in device memory.
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
    point.offset = pointError(tri);
    point.position = pointOnTriangle(tri, barycentric) + point.geometricNormal * point.offset;
    point.triangle = triangle;
    point.behindOthers = 0u;
    return point;
}

// Moves the point to the triangle's stored plane, if the scene stores planes. `at`: the ray's intersection with the
// plane.
SurfacePoint placedByPlane(SurfacePoint point, vec3 at, bool behindOthers) {
    if (!kPlanes) return point;
    Plane plane = fetchPlane(point.triangle);
    vec3 onSurface = ontoPlane(plane, at);
    point.offset = behindOthers ? 0.0 : planeError(plane, onSurface);
    point.position = behindOthers ? onSurface : onSurface + point.geometricNormal * point.offset;
    point.behindOthers = behindOthers ? 1u : 0u;
    return point;
}

// A straight part of a path, from one scattering event to the next: a ray that meets surfaces after (t, order), which
// is where it starts, or the last surface that it has crossed.
struct Segment {
    vec3 origin;
    vec3 direction;
    float t;
    uint order;
    vec3 attenuation;  // per scene unit, of glass inside which it starts
};

// A ray that leaves a surface on the side of the point's normals or, `through` the surface, on the other side.
// Coincident surfaces that lie on its side are still to be crossed.
Segment leaveSurface(SurfacePoint point, vec3 direction, bool through) {
    vec3 origin = through ? point.position - 2.0 * point.offset * point.geometricNormal : point.position;
    Segment segment = Segment(origin, direction, 0.0, kNoTriangle, vec3(0.0));
    if (kPlanes && (through || point.behindOthers != 0u)) {
        Plane plane = fetchPlane(point.triangle);
        segment.origin = point.position;
        segment.t = planeDistance(plane, point.position, direction);
        segment.order = orderOfSurface(fetchTriangle(point.triangle).primitive, dot(plane.normal, direction) < 0.0);
    }
    return segment;
}

// With a shading normal Ns, the path tracer uses |wi . Ns| in place of |wi . Ng| (wi points to the light). The adjoint
// is not obtained by exchanging the directions: the light tracer scatters a light path that arrives from wi by
// f |wi . Ns| / |wi . Ng| and the cosine between wo and the geometric normal (Veach, "Robust Monte Carlo Methods for
// Light Transport Simulation", 1997, section 5.3). Zero where wi is on different sides of the two normals.
float shadingAdjoint(SurfacePoint point, vec3 wi) {
    float cosShading = dot(point.shadingNormal, wi);
    float cosGeometric = dot(point.geometricNormal, wi);
    return cosShading > 0.0 && cosGeometric > 0.0 ? cosShading / cosGeometric : 0.0;
}

#endif
