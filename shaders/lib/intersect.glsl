// Rays, triangles, and points on triangles.
#ifndef DUOLUX_LIB_INTERSECT_GLSL
#define DUOLUX_LIB_INTERSECT_GLSL

#include "shaders/lib/warp.glsl"

struct Triangle {
    vec3 v0;
    vec3 v1;
    vec3 v2;
    uint primitive;
    uint materialFlags;
};

struct TriangleHit {
    bool hit;
    bool front;      // the ray comes from the side where the corners run counter-clockwise
    float t;         // distance in units of the direction's length
    vec2 barycentric;  // of v1 and v2
};

// Minimum and maximum on the bits as integers: the same as on floats as long as the result is not negative, without
// the handling of NaN. Whatever the signs, they are the two numbers.
float bitsMin(float a, float b) { return intBitsToFloat(min(floatBitsToInt(a), floatBitsToInt(b))); }
float bitsMax(float a, float b) { return intBitsToFloat(max(floatBitsToInt(a), floatBitsToInt(b))); }

// Rounded alike in whatever order they come: the number with the largest bits is added last.
float sumOfThree(float a, float b, float c) {
    float larger = bitsMax(a, b);
    precise float rest = bitsMin(a, b) + bitsMin(larger, c);
    precise float sum = rest + bitsMax(larger, c);
    return sum;
}

// Twice the signed area of the triangle that the edge from p to q makes with the ray, in the plane across it; that of the
// edge from q to p is the exact negative.
float edgeFunction(vec2 p, vec2 q) {
    precise float area = q.x * p.y - q.y * p.x;
    return area;
}

// The side of the edge from p to q on which the ray passes, as the sign of the result. Where the area is 0 it is as if the
// ray were moved a little along U and much less along V (simulation of simplicity: Edelsbrunner and Muecke, 1990), so that
// a ray passes one of the triangles at a shared edge or vertex.
float sideOfEdge(vec2 p, vec2 q, float area) {
    float moved = q.y != p.y ? q.y - p.y : p.x - q.x;
    return area != 0.0 ? area : moved;
}

// Watertight: a vertex is projected along the ray by arithmetic that depends on the vertex and the ray alone, and the
// edge functions of the two triangles at an edge are exact negatives, so that a ray cannot pass between them (the
// principle of Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013, with an orthonormal
// basis in place of the shear). Both sides are hit. A degenerate triangle is not. Distance and weights are the same to
// the bit whichever corner comes first, so that copies of a triangle are met at one distance.
// `axisU`, `axisV` and `direction` are orthonormal. `once`: of the triangles that share an edge or a vertex the ray hits
// one for each time that it passes through the surface; else it may hit all of them.
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
    // Of the corners. Products of lengths would leave the range of a float sooner than those of areas do.
    precise vec3 weights = vec3(u, v, w) * (1.0 / det);
    // A ray that goes on behind a surface knows it by its distance: wherever this is compiled it must be the same.
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

// The inverse of a direction component, large and finite where it is 0.
float safeInverse(float d) { return 1.0 / (abs(d) > 1e-20 ? d : (d < 0.0 ? -1e-20 : 1e-20)); }

// Whether a ray meets a box beyond tMin.
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
// starting there meets a neighbouring coplanar triangle: a multiple of the float's unit roundoff 2^-24.
float pointError(Triangle tri) {
    vec3 largest = max(abs(tri.v0), max(abs(tri.v1), abs(tri.v2)));
    return max(largest.x, max(largest.y, largest.z)) * (32.0 / 16777216.0);
}

#endif
