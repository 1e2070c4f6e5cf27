// Textures and the vertices that carry texture coordinates, shared by C++ and GLSL.
//
// All images of a scene lie one after the other in a buffer of texels of 4 x uint32, the atlas. An image with
// 8 bits per channel has a texel for each block of 2 x 2 pixels, row by row: the word of a pixel is (x & 1) +
// 2 (y & 1), its bytes are red, green, blue, alpha from the lowest on. Any other image has a texel of four
// floats for each pixel.
#ifndef DUOLUX_SHADERS_SHARED_TEXTURE_LAYOUT_H
#define DUOLUX_SHADERS_SHARED_TEXTURE_LAYOUT_H

#include "shaders/shared/types.h"

DUOLUX_BEGIN

DUOLUX_CONST uint kTextureTexels = 3u;  // of 4 x uint32

// What the components x, y, z, w of a looked-up value are inputs of. A group is one lookup if its inputs come
// from one image.
DUOLUX_CONST uint kGroupBase = 0u;        // base colour, alpha
DUOLUX_CONST uint kGroupSurface = 1u;     // metallic, roughness, transmission, clearcoat
DUOLUX_CONST uint kGroupSpecular = 2u;    // specular colour, specular
DUOLUX_CONST uint kGroupSheen = 3u;       // sheen colour, sheen roughness
DUOLUX_CONST uint kGroupNormal = 4u;      // normal, clearcoat roughness
DUOLUX_CONST uint kGroupAnisotropy = 5u;  // direction, strength
DUOLUX_CONST uint kGroupEmission = 6u;    // emission
DUOLUX_CONST uint kGroupCoatNormal = 7u;  // normal of the clearcoat
DUOLUX_CONST uint kTextureGroupCount = 8u;
// Among the groups that a scene uses, but without textures: colours of vertices scale the emission of some material.
DUOLUX_CONST uint kGroupEmissionColour = 8u;

// DeviceTexture.flags: the group in bits 0 to 2, and then:
DUOLUX_CONST uint kTextureGroupMask = 7u;
DUOLUX_CONST uint kTextureWrapUShift = 3u;  // two bits each, one of kWrap...
DUOLUX_CONST uint kTextureWrapVShift = 5u;
DUOLUX_CONST uint kTextureNearest = 128u;      // not filtered
DUOLUX_CONST uint kTextureSrgb = 256u;         // red, green and blue are decoded
DUOLUX_CONST uint kTextureFloat = 512u;        // pixels are floats
DUOLUX_CONST uint kTextureSecondUv = 1024u;    // the second set of texture coordinates
DUOLUX_CONST uint kTextureSwizzleShift = 16u;  // three bits for each component: a channel, or kNoChannel
DUOLUX_CONST uint kTextureSwizzleBits = 3u;
DUOLUX_CONST uint kNoChannel = 4u;  // the image has no part in the component

DUOLUX_CONST uint kWrapRepeat = 0u;
DUOLUX_CONST uint kWrapClamp = 1u;
DUOLUX_CONST uint kWrapMirror = 2u;

// Triangles in a scene with vertex records (kSpecVertexRecords): a texel with the indices of three vertices.
DUOLUX_CONST uint kCornerTexels = 1u;
// A vertex: its normal (octahedral, 2 x snorm16), u, v as floats, and the tangent: the angle in the plane of
// the normal from the first axis of orthonormalBasis() in 2^15 parts of a turn, and two flags.
DUOLUX_CONST uint kVertexTexels = 1u;
DUOLUX_CONST uint kTangentAngleBits = 15u;
DUOLUX_CONST uint kTangentNegative = 0x8000u;  // the bitangent is -cross(normal, tangent)
DUOLUX_CONST uint kTangentKnown = 0x10000u;
// The second texture coordinates: a texel holds those of two vertices.

#ifdef __cplusplus
struct DeviceTexture {
    uint firstTexel;  // in the atlas
    uint width;       // pixels
    uint height;
    uint flags;
    vec3 rowU;  // dot(rowU, (u, v, 1)): the coordinate in the image, from 0 to 1
    uint unused0;
    vec3 rowV;
    uint unused1;
};
static_assert(sizeof(DeviceTexture) == kTextureTexels * 16 && offsetof(DeviceTexture, rowU) == 16);

struct DeviceCorners {
    uint vertices[3];
    uint unused;
};
static_assert(sizeof(DeviceCorners) == kCornerTexels * 16);

struct DeviceVertex {
    uint octahedral;
    vec2 uv;
    uint tangent;
};
static_assert(sizeof(DeviceVertex) == kVertexTexels * 16);
#endif

DUOLUX_END
#endif
