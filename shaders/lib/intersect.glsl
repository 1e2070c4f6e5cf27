// Rays, triangles, and points on triangles.
#ifndef DUOLUX_LIB_INTERSECT_GLSL
#define DUOLUX_LIB_INTERSECT_GLSL

#include "shaders/lib/warp.glsl"
#include "shaders/shared/rounding.h"

struct Triangle {
    vec3 v0;
    vec3 v1;
    vec3 v2;
    uint primitive;
    uint materialFlags;
};

struct TriangleHit {
    bool hit;
    bool front;        // the ray comes from the side from which the corners are counter-clockwise
    float t;           // distance in units of the direction's length
    vec2 barycentric;  // of v1 and v2
};

// Minimum and maximum by comparing the bits as integers, which avoids the handling of NaN. Equal to the minimum and
// maximum of the floats where the result is not negative. For all signs, bitsMin and bitsMax together return both
// numbers.
float bitsMin(float a, float b) { return intBitsToFloat(min(floatBitsToInt(a), floatBitsToInt(b))); }
float bitsMax(float a, float b) { return intBitsToFloat(max(floatBitsToInt(a), floatBitsToInt(b))); }

// The rounded sum does not depend on the order of the arguments: the number with the largest bits is added last.
float sumOfThree(float a, float b, float c) {
    float larger = bitsMax(a, b);
    precise float rest = bitsMin(a, b) + bitsMin(larger, c);
    precise float sum = rest + bitsMax(larger, c);
    return sum;
}

// Twice the signed area of the triangle (ray, p, q) in the plane perpendicular to the ray. Exchanging p and q gives the
// exact negative.
float edgeFunction(vec2 p, vec2 q) {
    precise float area = q.x * p.y - q.y * p.x;
    return area;
}

// The sign of the result is the side of the edge from p to q on which the ray passes. Where the area is 0, the ray is
// treated as moved a little along U and much less along V (simulation of simplicity: Edelsbrunner and Muecke, 1990), so
// that it passes through exactly one of the triangles at a shared edge or vertex.
float sideOfEdge(vec2 p, vec2 q, float area) {
    float moved = q.y != p.y ? q.y - p.y : p.x - q.x;
    return area != 0.0 ? area : moved;
}

// Watertight: the projection of a vertex along the ray depends only on the vertex and the ray, and the edge functions
// of the two triangles at an edge are exact negatives, so that a ray cannot pass between them (the principle of Woop,
// Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013, with an orthonormal basis in place of the
// shear). Both sides of a triangle can be hit; a degenerate triangle cannot. Distance and weights are bitwise identical
// whichever corner comes first, so that copies of a triangle have identical distances. `axisU`, `axisV` and `direction`
// are orthonormal. `once`: of the triangles that share an edge or a vertex, the ray hits exactly one each time it
// passes through the surface; otherwise it may hit all of them.
TriangleHit intersectTriangle(Triangle tri, vec3 origin, vec3 direction, vec3 axisU, vec3 axisV, bool once) {
    vec3 a = tri.v0 - origin;
    vec3 b = tri.v1 - origin;
    vec3 c = tri.v2 - origin;
    precise float ax = dot(a, axisU);
    precise float ay = dot(a, axisV);
    precise float bx = dot(b, axisU);
    precise float by = dot(b, axisV);
    precise float cx = dot(c, axisU);
    precise float cy = dot(c, axisV);
    float u = edgeFunction(vec2(bx, by), vec2(cx, cy));
    float v = edgeFunction(vec2(cx, cy), vec2(ax, ay));
    float w = edgeFunction(vec2(ax, ay), vec2(bx, by));
    precise float det = sumOfThree(u, v, w);
    // Barycentric weights of the corners. They are normalised before they are multiplied by distances, because a
    // product of an area and a length overflows sooner than an area.
    precise vec3 weights = vec3(u, v, w) * (1.0 / det);
    // A ray that continues behind a surface recognises it by its distance, so every compilation of this code must
    // compute an identical distance.
    precise float ta = weights.x * dot(a, direction);
    precise float tb = weights.y * dot(b, direction);
    precise float tc = weights.z * dot(c, direction);
    precise float t = sumOfThree(ta, tb, tc);
    bool inside = min(u, min(v, w)) >= 0.0 || max(u, max(v, w)) <= 0.0;
    if (once) {
        float sideU = sideOfEdge(vec2(bx, by), vec2(cx, cy), u);
        float sideV = sideOfEdge(vec2(cx, cy), vec2(ax, ay), v);
        float sideW = sideOfEdge(vec2(ax, ay), vec2(bx, by), w);
        inside = min(sideU, min(sideV, sideW)) > 0.0 || max(sideU, max(sideV, sideW)) < 0.0;
    }
    return TriangleHit(inside && det != 0.0, det > 0.0, t, vec2(weights.y, weights.z));
}

// The reciprocal of a direction component; large but finite where the component is 0.
float safeInverse(float d) { return 1.0 / (abs(d) > 1e-20 ? d : (d < 0.0 ? -1e-20 : 1e-20)); }

// Whether a ray intersects a box beyond tMin.
bool intersectBox(vec3 origin, vec3 direction, float tMin, vec3 lower, vec3 upper) {
    vec3 inverse = vec3(safeInverse(direction.x), safeInverse(direction.y), safeInverse(direction.z));
    vec3 a = (lower - origin) * inverse;
    vec3 b = (upper - origin) * inverse;
    vec3 entry = min(a, b);
    vec3 leave = max(a, b);
    return max(max(entry.x, entry.y), max(entry.z, tMin)) <= min(leave.x, min(leave.y, leave.z));
}

vec3 pointOnTriangle(Triangle tri, vec2 barycentric) {
    return tri.v0 * (1.0 - barycentric.x - barycentric.y) + tri.v1 * barycentric.x + tri.v2 * barycentric.y;
}

// Bound on the rounding error of a point on a triangle with vertices of this size, and of the distance at which a ray
// from that point intersects a neighbouring coplanar triangle.
float pointError(Triangle tri) {
    vec3 largest = max(abs(tri.v0), max(abs(tri.v1), abs(tri.v2)));
    return max(largest.x, max(largest.y, largest.z)) * kPointError;
}

#endif
