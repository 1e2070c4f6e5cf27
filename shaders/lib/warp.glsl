// Mappings from the unit square, and orthonormal frames.
#ifndef DUOLUX_LIB_WARP_GLSL
#define DUOLUX_LIB_WARP_GLSL

const float kPi = 3.14159265358979;

// A uniform angle around an axis, in radians.
float azimuth(float u) { return 2.0 * kPi * u; }

// Direction on the hemisphere around +z with pdf cos / pi (per steradian): Malley's method.
vec3 cosineHemisphere(vec2 u) {
    float r = sqrt(u.x);
    float phi = azimuth(u.y);
    return vec3(r * cos(phi), r * sin(phi), sqrt(1.0 - u.x));
}

// Uniform direction on the hemisphere around +z.
vec3 uniformHemisphere(vec2 u) {
    float r = sqrt(max(1.0 - u.x * u.x, 0.0));
    float phi = azimuth(u.y);
    return vec3(r * cos(phi), r * sin(phi), u.x);
}

// Uniform direction on the sphere.
vec3 uniformSphere(vec2 u) {
    float z = 1.0 - 2.0 * u.x;
    float r = sqrt(max(1.0 - z * z, 0.0));
    float phi = azimuth(u.y);
    return vec3(r * cos(phi), r * sin(phi), z);
}

// Barycentric coordinates (of the second and third vertex), uniform in area: Heitz, "A Low-Distortion Map Between
// Triangle and Square", 2019.
vec2 uniformTriangle(vec2 u) {
    return u.y > u.x ? vec2(u.x * 0.5, u.y - u.x * 0.5) : vec2(u.x - u.y * 0.5, u.y * 0.5);
}

// Orthonormal vectors around a unit vector: Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
void orthonormalBasis(vec3 n, out vec3 tangent, out vec3 bitangent) {
    float s = n.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    tangent = vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x);
    bitangent = vec3(b, s + n.y * n.y * a, -n.y);
}

#endif
