// Unit vectors in 32 bits.
#ifndef DUOLUX_LIB_OCTAHEDRAL_GLSL
#define DUOLUX_LIB_OCTAHEDRAL_GLSL

// Unit vector from two snorm16: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
// JCGT 3(2), 2014.
vec3 octahedralDecode(uint bits) {
    vec2 e = vec2(float(int(bits << 16u) >> 16), float(int(bits) >> 16)) * (1.0 / 32767.0);
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    float fold = max(-n.z, 0.0);
    n.x += n.x >= 0.0 ? -fold : fold;
    n.y += n.y >= 0.0 ? -fold : fold;
    return normalize(n);
}

#endif
