// Light of a uniformly emitting triangle in closed form: Lambert's polygon formula ("Photometria", 1760; in vector form
// Arvo, "The Irradiance Jacobian for Partially Occluded Polyhedral Sources", SIGGRAPH 1994, eq. 5).
#ifndef DUOLUX_LIB_POLYGON_LIGHT_GLSL
#define DUOLUX_LIB_POLYGON_LIGHT_GLSL

#include "shaders/lib/warp.glsl"

// The angle in [0, pi] whose sine and cosine are in this ratio, to 3e-7 (drivers' atan may be far worse): Abramowitz and
// Stegun, "Handbook of Mathematical Functions", 1964, eq. 4.4.49.
float angleOf(float sine, float cosine) {
    float smaller = min(sine, abs(cosine));
    float larger = max(sine, abs(cosine));
    float x = larger > 0.0 ? smaller / larger : 0.0;
    float y = x * x;
    float series = y * (0.0429096138 + y * (-0.0161657367 + y * 0.0028662257));
    series = y * (-0.1420889944 + y * (0.1065626393 + y * (-0.0752896400 + series)));
    float angle = x + x * (y * (-0.3333314528 + y * (0.1999355085 + series)));
    angle = sine > abs(cosine) ? 0.5 * kPi - angle : angle;
    return cosine < 0.0 ? kPi - angle : angle;
}

// The angle between a and b times the component along the normal of the unit vector across both.
float edgeIntegral(vec3 a, vec3 b, vec3 normal) {
    // The shorter of the two: between corners close together a x b would lose what a x (b - a) keeps.
    vec3 edge = b - a;
    vec3 across = cross(a, dot(edge, edge) < dot(b, b) ? edge : b);
    float sine = length(across);
    float angle = angleOf(sine, dot(a, b));
    return sine > 0.0 ? angle * dot(across, normal) / sine : 0.0;
}

// Where the edge from a to b meets the horizon; da and db are the heights of its ends, of different signs. Two terms
// that do not cancel: from a corner far away to one nearby a + (b - a) da / (da - db) would lose the latter's digits.
vec3 horizonPoint(vec3 a, vec3 b, float da, float db) { return (b * da - a * db) / (da - db); }

// The corner whose side of the horizon is not that of the other two: 0, 1 or 2; if all are on one side, 3.
int oddCorner(bvec3 above) {
    return above.x != above.y && above.x != above.z ? 0
                                                    : (above.y != above.z ? (above.y != above.x ? 1 : 2) : 3);
}

// Sum over the edges of the part above the horizon. What an edge cuts off there is closed by an edge along the horizon.
// For triangles that are not small: the edges of a small one cancel.
float edgesAboveHorizon(vec3 a, vec3 b, vec3 c, vec3 normal) {
    float da = dot(a, normal);
    float db = dot(b, normal);
    float dc = dot(c, normal);
    bool aboveA = da > 0.0;
    bool aboveB = db > 0.0;
    bool aboveC = dc > 0.0;
    // Each edge with the part below cut off; one that is below altogether shrinks to a point.
    vec3 ab = horizonPoint(a, b, da, db);
    vec3 bc = horizonPoint(b, c, db, dc);
    vec3 ca = horizonPoint(c, a, dc, da);
    float sum = 0.0;
    sum += aboveA || aboveB ? edgeIntegral(aboveA ? a : ab, aboveB ? b : ab, normal) : 0.0;
    sum += aboveB || aboveC ? edgeIntegral(aboveB ? b : bc, aboveC ? c : bc, normal) : 0.0;
    sum += aboveC || aboveA ? edgeIntegral(aboveC ? c : ca, aboveA ? a : ca, normal) : 0.0;
    // Going round, one edge goes down through the horizon, another comes up.
    bool cut = (aboveA || aboveB || aboveC) && !(aboveA && aboveB && aboveC);
    vec3 down = aboveA && !aboveB ? ab : (aboveB && !aboveC ? bc : ca);
    vec3 up = !aboveA && aboveB ? ab : (!aboveB && aboveC ? bc : ca);
    sum += cut ? edgeIntegral(down, up, normal) : 0.0;
    return 0.5 * sum;
}

// The integral of cos cos' / r^2 over the triangle a, a + edge1, a + edge2, all of it counted (below the horizon
// negative), by the moments of a triangle up to the second: for edges of a twelfth of the distance it is off by 5e-5,
// with the cube of that ratio less. Its sign is that of the triangle's orientation, too.
float smallTriangle(vec3 a, vec3 edge1, vec3 edge2, vec3 normal) {
    vec3 middle = a + (edge1 + edge2) * (1.0 / 3.0);
    vec3 toB = edge1 - (edge1 + edge2) * (1.0 / 3.0);
    vec3 toC = edge2 - (edge1 + edge2) * (1.0 / 3.0);
    vec3 toA = -(toB + toC);
    float inverse = 1.0 / dot(middle, middle);
    vec3 heights = vec3(dot(normal, toA), dot(normal, toB), dot(normal, toC));
    vec3 along = vec3(dot(middle, toA), dot(middle, toB), dot(middle, toC)) * inverse;
    float spread = (dot(toA, toA) + dot(toB, toB) + dot(toC, toC)) * inverse;
    // |middle + d|^-4 to the second order in d; the mean of d d^T over a triangle is a twelfth of its sum over the
    // corners.
    float height = dot(normal, middle);
    float mean = height * (1.0 + dot(along, along) - spread * (1.0 / 6.0)) - dot(heights, along) * (1.0 / 3.0);
    return 0.5 * dot(cross(edge1, edge2), middle) * inverse * inverse * mean;
}

// As edgesAboveHorizon, for small triangles.
float smallTriangleAboveHorizon(vec3 a, vec3 edge1, vec3 edge2, vec3 normal) {
    float da = dot(a, normal);
    vec3 heights = vec3(da, da + dot(edge1, normal), da + dot(edge2, normal));
    bvec3 above = bvec3(heights.x > 0.0, heights.y > 0.0, heights.z > 0.0);
    // The horizon cuts off the odd corner. One that is below is taken away from the whole, one above is all that is left.
    int odd = oddCorner(above);
    vec3 corner = odd == 0 ? a : (odd == 1 ? a + edge1 : a + edge2);
    vec3 next = odd == 0 ? edge1 : (odd == 1 ? edge2 - edge1 : -edge2);
    vec3 previous = odd == 0 ? edge2 : (odd == 1 ? -edge1 : edge1 - edge2);
    vec3 turned = odd == 0 ? heights : (odd == 1 ? heights.yzx : heights.zxy);
    float whole = 0.0;
    float part = 0.0;
    for (int i = odd == 3 ? 1 : 0; i < 2; i++) {
        bool isPart = i == 0;
        float x = smallTriangle(isPart ? corner : a, isPart ? next * (turned.x / (turned.x - turned.y)) : edge1,
                                isPart ? previous * (turned.x / (turned.x - turned.z)) : edge2, normal);
        part = isPart ? x : part;
        whole = isPart ? whole : x;
    }
    bool oneAbove = odd != 3 && turned.x > 0.0;
    return oneAbove ? part : (odd == 3 && !above.x ? 0.0 : whole - part);
}

// Edges of a triangle shorter than this part of its distance make it a small one.
const float kSmallTriangle = 1.0 / 12.0;

// Projected solid angle, in steradians, of the triangle a, a + edge1, a + edge2 (from the receiving point, of any length),
// as far as it is above the horizon of `normal`: a diffuse surface of albedo rho turns radiance L into rho/pi L times it.
// The edges are given because differences of corners far away would lose them. Relative error about 1e-4 at most, where
// neither cosine is small.
float projectedSolidAngle(vec3 a, vec3 edge1, vec3 edge2, vec3 normal) {
    vec3 middle = a + (edge1 + edge2) * (1.0 / 3.0);
    vec3 edge3 = edge2 - edge1;
    float longest = max(dot(edge1, edge1), max(dot(edge2, edge2), dot(edge3, edge3)));
    bool isSmall = longest < kSmallTriangle * kSmallTriangle * dot(middle, middle);
    float angle = 0.0;
    // Loops, because only these skip what no lane needs.
    for (int i = isSmall ? 0 : 1; i < 1; i++) angle = smallTriangleAboveHorizon(a, edge1, edge2, normal);
    for (int i = isSmall ? 1 : 0; i < 1; i++) angle = edgesAboveHorizon(a, a + edge1, a + edge2, normal);
    return abs(angle);
}

#endif
