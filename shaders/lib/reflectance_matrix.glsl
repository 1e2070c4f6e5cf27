// The 2x2 algebra of vector-valued radiance, per colour channel (paper, eqs. 7-23). Component 0 is invisible, 1
// visible.
#ifndef DUOLUX_LIB_REFLECTANCE_MATRIX_GLSL
#define DUOLUX_LIB_REFLECTANCE_MATRIX_GLSL

// Entry ij maps component j to component i, per channel.
struct ReflectanceMatrix {
    vec3 m00;
    vec3 m01;
    vec3 m10;
    vec3 m11;
};

// A column vector: radiance L, emission E.
struct Radiance2 {
    vec3 invisible;
    vec3 visible;
};

ReflectanceMatrix matrixIdentity() { return ReflectanceMatrix(vec3(1.0), vec3(0.0), vec3(0.0), vec3(1.0)); }

ReflectanceMatrix matrixMultiply(ReflectanceMatrix a, ReflectanceMatrix b) {
    return ReflectanceMatrix(a.m00 * b.m00 + a.m01 * b.m10, a.m00 * b.m01 + a.m01 * b.m11,
                             a.m10 * b.m00 + a.m11 * b.m10, a.m10 * b.m01 + a.m11 * b.m11);
}

// a * b where the second column of b is known to be zero; the second column of the product is then also zero.
ReflectanceMatrix matrixMultiplyFirstColumn(ReflectanceMatrix a, ReflectanceMatrix b) {
    return ReflectanceMatrix(a.m00 * b.m00 + a.m01 * b.m10, vec3(0.0), a.m10 * b.m00 + a.m11 * b.m10, vec3(0.0));
}

Radiance2 matrixApply(ReflectanceMatrix a, Radiance2 l) {
    return Radiance2(a.m00 * l.invisible + a.m01 * l.visible, a.m10 * l.invisible + a.m11 * l.visible);
}

ReflectanceMatrix scaled(ReflectanceMatrix a, vec3 s) {
    return ReflectanceMatrix(a.m00 * s, a.m01 * s, a.m10 * s, a.m11 * s);
}

Radiance2 scaled(Radiance2 l, vec3 s) { return Radiance2(l.invisible * s, l.visible * s); }

float maxComponent(vec3 v) { return max(v.x, max(v.y, v.z)); }

// The importance that a matrix carries, its rows weighted by rowWeight: the maximum over the channels.
float matrixWeight(ReflectanceMatrix a, vec2 rowWeight) {
    return maxComponent((a.m00 + a.m01) * rowWeight.x + (a.m10 + a.m11) * rowWeight.y);
}

#endif
