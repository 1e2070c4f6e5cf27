// Irradiance from a uniformly emitting triangle in closed form: Lambert's polygon formula ("Photometria", 1760; vector
// form: Arvo, "The Irradiance Jacobian for Partially Occluded Polyhedral Sources", SIGGRAPH 1994, eq. 5).
#ifndef DUOLUX_LIB_POLYGON_LIGHT_GLSL
#define DUOLUX_LIB_POLYGON_LIGHT_GLSL

#include "shaders/lib/warp.glsl"

// The angle in [0, pi] whose sine and cosine have this ratio, with an error of at most 3e-7 (a driver's atan may be far
// less accurate): Abramowitz and Stegun, "Handbook of Mathematical Functions", 1964, eq. 4.4.49.
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

// The angle between a and b times the component along `normal` of the unit vector perpendicular to both.
float edgeIntegral(vec3 a, vec3 b, vec3 normal) {
    vec3 across = cross(a, b);
    float sine = length(across);
    float angle = angleOf(sine, dot(a, b));
    return sine > 0.0 ? angle * dot(across, normal) / sine : 0.0;
}

// The intersection of the edge from a to b with the horizon; da and db are the heights of its ends, with opposite
// signs. The two terms do not cancel, unlike a + (b - a) da / (da - db), which loses the digits of b if a is far away.
vec3 horizonPoint(vec3 a, vec3 b, float da, float db) { return (b * da - a * db) / (da - db); }

// The corner (0, 1 or 2) that is on the other side of the horizon than the remaining two; 3 if all are on one side.
int oddCorner(bvec3 above) {
    return above.x != above.y && above.x != above.z ? 0
                                                    : (above.y != above.z ? (above.y != above.x ? 1 : 2) : 3);
}

// Sum over the edges of the part above the horizon, including the edge along the horizon that closes a clipped
// triangle. For triangles that are not small: the edge integrals of a small one cancel.
float edgesAboveHorizon(vec3 a, vec3 b, vec3 c, vec3 normal) {
    float da = dot(a, normal);
    float db = dot(b, normal);
    float dc = dot(c, normal);
    bool aboveA = da > 0.0;
    bool aboveB = db > 0.0;
    bool aboveC = dc > 0.0;
    // Each edge is clipped at the horizon; an edge that is entirely below is left out.
    vec3 ab = horizonPoint(a, b, da, db);
    vec3 bc = horizonPoint(b, c, db, dc);
    vec3 ca = horizonPoint(c, a, dc, da);
    float sum = 0.0;
    sum += aboveA || aboveB ? edgeIntegral(aboveA ? a : ab, aboveB ? b : ab, normal) : 0.0;
    sum += aboveB || aboveC ? edgeIntegral(aboveB ? b : bc, aboveC ? c : bc, normal) : 0.0;
    sum += aboveC || aboveA ? edgeIntegral(aboveC ? c : ca, aboveA ? a : ca, normal) : 0.0;
    // If the triangle is clipped, one of its edges crosses the horizon downwards and another upwards.
    bool cut = (aboveA || aboveB || aboveC) && !(aboveA && aboveB && aboveC);
    vec3 down = aboveA && !aboveB ? ab : (aboveB && !aboveC ? bc : ca);
    vec3 up = !aboveA && aboveB ? ab : (!aboveB && aboveC ? bc : ca);
    sum += cut ? edgeIntegral(down, up, normal) : 0.0;
    return 0.5 * sum;
}

// The integral of cos cos' / r^2 over the whole triangle a, a + edge1, a + edge2 (negative below the horizon), from the
// moments of the triangle up to the second. The error is 5e-5 for edges of a twelfth of the distance and falls with the
// cube of this ratio. The sign of the result changes with the triangle's orientation.
float smallTriangle(vec3 a, vec3 edge1, vec3 edge2, vec3 normal) {
    vec3 middle = a + (edge1 + edge2) * (1.0 / 3.0);
    vec3 toB = edge1 - (edge1 + edge2) * (1.0 / 3.0);
    vec3 toC = edge2 - (edge1 + edge2) * (1.0 / 3.0);
    vec3 toA = -(toB + toC);
    float inverse = 1.0 / dot(middle, middle);
    vec3 heights = vec3(dot(normal, toA), dot(normal, toB), dot(normal, toC));
    vec3 along = vec3(dot(middle, toA), dot(middle, toB), dot(middle, toC)) * inverse;
    float spread = (dot(toA, toA) + dot(toB, toB) + dot(toC, toC)) * inverse;
    // |middle + d|^-4 to the second order in d. The mean of d d^T over a triangle is 1/12 of its sum over the corners.
    float height = dot(normal, middle);
    float mean = height * (1.0 + dot(along, along) - spread * (1.0 / 6.0)) - dot(heights, along) * (1.0 / 3.0);
    return 0.5 * dot(cross(edge1, edge2), middle) * inverse * inverse * mean;
}

// As edgesAboveHorizon, for small triangles.
float smallTriangleAboveHorizon(vec3 a, vec3 edge1, vec3 edge2, vec3 normal) {
    float da = dot(a, normal);
    vec3 heights = vec3(da, da + dot(edge1, normal), da + dot(edge2, normal));
    bvec3 above = bvec3(heights.x > 0.0, heights.y > 0.0, heights.z > 0.0);
    // The horizon cuts off the odd corner. The result is the corner's part if the corner is above, or the whole
    // triangle minus this part if the corner is below.
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

// A triangle is small if its edges are shorter than this fraction of its distance.
const float kSmallTriangle = 1.0 / 12.0;

// Projected solid angle (steradians) of the part above the horizon of `normal` of the triangle a, a + edge1, a + edge2
// (relative to the receiving point, in any unit of length). A diffuse surface of albedo rho reflects emitted radiance L
// as rho / pi * L times this angle. Edges are passed because the differences of distant corners would lose digits. The
// relative error is at most about 1e-4 where neither cosine is small.
float projectedSolidAngle(vec3 a, vec3 edge1, vec3 edge2, vec3 normal) {
    vec3 middle = a + (edge1 + edge2) * (1.0 / 3.0);
    vec3 edge3 = edge2 - edge1;
    float longest = max(dot(edge1, edge1), max(dot(edge2, edge2), dot(edge3, edge3)));
    bool isSmall = longest < kSmallTriangle * kSmallTriangle * dot(middle, middle);
    float angle = 0.0;
    // On lavapipe, only loops skip code that no lane needs; an `if` executes both branches.
    for (int i = isSmall ? 0 : 1; i < 1; i++) angle = smallTriangleAboveHorizon(a, edge1, edge2, normal);
    for (int i = isSmall ? 1 : 0; i < 1; i++) angle = edgesAboveHorizon(a, a + edge1, a + edge2, normal);
    return abs(angle);
}

#endif
