// Layout of the bounding volume hierarchy in device memory, shared by C++ and GLSL.
//
// Nodes: 8-wide, quantised, 80 bytes = 5 texels of 4 x uint32 (Ylitie, Karras, Laine, "Efficient Incoherent
// Ray Traversal on GPUs Through Compressed Wide BVHs", HPG 2017). Child boxes are 8-bit offsets from the
// node's origin in units of 2^e per axis. Children are in slots; the slot's bits say on which side of the
// node's centre the child lies (bit 2: x, bit 1: y, bit 0: z), so that (slot XOR octant of the ray) orders
// them front to back.
//
// Triangles: in pairs that share an edge, 64 bytes = 4 texels: corner k in xyz of texel k. Triangle 0 of a
// pair has the corners 0 1 2, triangle 1 has 3 2 1 (the edge from 1 to 2 is both's). Of each the w of the
// first texel is the primitive, that of the third the material with flags. Where there is no triangle 1, its
// corner 3 is the same as corner 1. Triangle k of pair p is triangle 2p + k.
#ifndef DUOLUX_SHADERS_SHARED_BVH_LAYOUT_H
#define DUOLUX_SHADERS_SHARED_BVH_LAYOUT_H

#include "shaders/shared/types.h"

DUOLUX_BEGIN

DUOLUX_CONST uint kNodeTexels = 5u;
DUOLUX_CONST uint kPairTexels = 4u;

// A wide tree is at most this deep (levels of nodes); the traversal's stack has as many entries.
DUOLUX_CONST uint kMaxTreeDepth = 24u;

// A leaf child holds 1 to 3 pairs.
DUOLUX_CONST uint kMaxLeafPairs = 3u;

// Per-child meta byte: 0: empty. Inner node: 001 in the high bits, 24 + slot in the low five. Leaf: as many
// ones in the high three bits (unary) as it has pairs, and in the low five the offset of the first from
// Node.pairBase.
DUOLUX_CONST uint kMetaInner = 0x20u;

// Specialisation constant of all kernels that walk through the tree: lanes of a subgroup of 8 vote by
// shuffles.
DUOLUX_CONST uint kSpecVoteByShuffle = 18u;

// Masks of instances where an acceleration structure of the driver's takes the place of nodes: all triangles,
// and copies of the emitting ones, which follow behind them.
DUOLUX_CONST uint kMaskAll = 1u;
DUOLUX_CONST uint kMaskEmitters = 2u;

#ifdef __cplusplus
struct WideNode {
    float origin[3];
    std::uint8_t exponent[3];  // biased like a float's: the unit of an axis is 2^(exponent - 127)
    std::uint8_t innerMask;    // bit s: slot s holds an inner node
    uint childBase;            // index of the first inner child; they are consecutive, in order of slots
    uint pairBase;             // index of the first pair of the leaf children; consecutive
    std::uint8_t meta[8];
    std::uint8_t lower[3][8];  // [axis][slot]
    std::uint8_t upper[3][8];
};
static_assert(sizeof(WideNode) == kNodeTexels * 16);
static_assert(offsetof(WideNode, exponent) == 12 && offsetof(WideNode, childBase) == 16);
static_assert(offsetof(WideNode, meta) == 24 && offsetof(WideNode, lower) == 32 &&
              offsetof(WideNode, upper) == 56);

struct DevicePair {
    vec3 v0;
    uint primitive0;  // its rank, below 2^31, the same for every copy: orders coincident hits
    vec3 v1;
    uint materialFlags1;  // material index | flags
    vec3 v2;
    uint materialFlags0;
    vec3 v3;
    uint primitive1;
};
static_assert(sizeof(DevicePair) == kPairTexels * 16);
#endif

// Texels: the plane of each triangle, where kSpecPlanes is true: its front's unit normal, and dot(normal, x) on it.
DUOLUX_CONST uint kBindingPlanes = 10u;
DUOLUX_CONST uint kSpecPlanes = 19u;

DUOLUX_CONST uint kMaterialMask = 0x7fffffffu;
DUOLUX_CONST uint kTriangleSmooth = 0x80000000u;  // has shading normals

DUOLUX_END
#endif
