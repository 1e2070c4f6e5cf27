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
    vec3 across = cross(a, b);
    float sine = length(across);
    float angle = angleOf(sine, dot(a, b));
    return sine > 0.0 ? angle * dot(across, normal) / sine : 0.0;
}

// Where the edge from a to b meets the horizon; da and db are the heights of its ends, of different signs. Two terms
// that do not cancel: from a corner far away to one nearby a + (b - a) da / (da - db) would lose the latter's digits.
vec3 horizonPoint(vec3 a, vec3 b, float da, float db) { return (b * da - a * db) / (da - db); }

// Projected solid angle, in steradians, of the triangle with corners a, b, c (from the receiving point, of any length), as
// far as it is above the horizon of `normal`: a diffuse surface of albedo rho turns radiance L into rho/pi L times it.
// What an edge cuts off at the horizon is closed by an edge along the horizon.
float projectedSolidAngle(vec3 a, vec3 b, vec3 c, vec3 normal) {
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
    return 0.5 * abs(sum);
}

#endif
