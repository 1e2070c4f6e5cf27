// Looks up images in the atlas (texture_layout.h). The kernel that includes this defines fetchTextureTexel and
// fetchAtlasTexel.
#ifndef DUOLUX_LIB_TEXTURE_GLSL
#define DUOLUX_LIB_TEXTURE_GLSL

#include "shaders/shared/texture_layout.h"

uvec4 fetchTextureTexel(uint index);
uvec4 fetchAtlasTexel(uint index);

struct Texture {
    uint firstTexel;
    uint width;
    uint height;
    uint flags;
    vec3 rowU;
    vec3 rowV;
};

Texture fetchTexture(uint index) {
    uvec4 t0 = fetchTextureTexel(index * kTextureTexels);
    uvec4 t1 = fetchTextureTexel(index * kTextureTexels + 1u);
    uvec4 t2 = fetchTextureTexel(index * kTextureTexels + 2u);
    return Texture(t0.x, t0.y, t0.z, t0.w, uintBitsToFloat(t1.xyz), uintBitsToFloat(t2.xyz));
}

// The linear value of an sRGB-encoded one from 0 to 1 (IEC 61966-2-1:1999, clause 5.2). Above the linear part, the
// polynomial of degree 5 with the smallest relative error, scaled so that 1 stays 1: off by less than 0.08 %.
float srgbToLinear(float x) {
    float high = 0.71012500 + x * (-0.36883585 + x * 0.11655509);
    float curve = 0.00088295870 + x * (0.033910484 + x * (0.50736231 + x * high));
    return x <= 0.04045 ? x * (1.0 / 12.92) : curve;
}

// The place of a coordinate within a period of an image that covers 0 to 1: from 0 to 1, with kWrapMirror 0 to 2.
float wrapCoordinate(uint wrap, float x) {
    float period = wrap == kWrapMirror ? 0.5 : 1.0;
    float scaledTo = x * period;
    float within = (scaledTo - floor(scaledTo)) / period;
    return wrap == kWrapClamp ? clamp(x, 0.0, 1.0) : within;
}

// The pixel at an index from -1 to one more than those of a period.
uint wrapPixel(uint wrap, int i, uint count) {
    int n = int(count);
    int period = wrap == kWrapMirror ? 2 * n : n;
    int inPeriod = i < 0 ? i + period : (i >= period ? i - period : i);
    int mirrored = inPeriod >= n ? period - 1 - inPeriod : inPeriod;
    int chosen = wrap == kWrapClamp ? i : (wrap == kWrapMirror ? mirrored : inPeriod);
    return uint(clamp(chosen, 0, n - 1));
}

// A pixel as linear values.
vec4 fetchPixel(Texture image, uint x, uint y) {
    bool floats = (image.flags & kTextureFloat) != 0u;
    uint shift = floats ? 0u : 1u;
    uint rowTexels = (image.width + shift) >> shift;
    uvec4 texel = fetchAtlasTexel(image.firstTexel + (y >> shift) * rowTexels + (x >> shift));
    uint word = texel[(x & 1u) + 2u * (y & 1u)];
    uvec4 bytes = uvec4(word, word >> 8u, word >> 16u, word >> 24u) & 255u;
    vec4 value = floats ? uintBitsToFloat(texel) : vec4(bytes) * (1.0 / 255.0);
    bool encoded = (image.flags & kTextureSrgb) != 0u;
    return vec4(encoded ? srgbToLinear(value.x) : value.x, encoded ? srgbToLinear(value.y) : value.y,
                encoded ? srgbToLinear(value.z) : value.z, value.w);
}

// The value at texture coordinates. The pixel i of n has its centre at (i + 0.5) / n.
vec4 sampleTexture(Texture image, vec2 uv) {
    uint wrapU = (image.flags >> kTextureWrapUShift) & 3u;
    uint wrapV = (image.flags >> kTextureWrapVShift) & 3u;
    bool nearest = (image.flags & kTextureNearest) != 0u;
    float toCentre = nearest ? 0.0 : 0.5;
    vec3 place = vec3(uv, 1.0);
    float x = wrapCoordinate(wrapU, dot(image.rowU, place)) * float(image.width) - toCentre;
    float y = wrapCoordinate(wrapV, dot(image.rowV, place)) * float(image.height) - toCentre;
    float x0 = floor(x);
    float y0 = floor(y);
    float right = nearest ? 0.0 : x - x0;
    float below = nearest ? 0.0 : y - y0;
    vec4 sum = vec4(0.0);
    for (uint i = 0u; i < (nearest ? 1u : 4u); i++) {
        int dx = int(i & 1u);
        int dy = int(i >> 1u);
        vec4 pixel = fetchPixel(image, wrapPixel(wrapU, int(x0) + dx, image.width),
                                wrapPixel(wrapV, int(y0) + dy, image.height));
        sum += pixel * ((dx == 0 ? 1.0 - right : right) * (dy == 0 ? 1.0 - below : below));
    }
    return sum;
}

#endif
