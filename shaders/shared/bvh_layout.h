// Layout of the bounding volume hierarchy in device memory, shared by C++ and GLSL.
//
// Nodes: 8-wide, quantised, 80 bytes = 5 texels of 4 x uint32 (Ylitie, Karras, Laine, "Efficient Incoherent
// Ray Traversal on GPUs Through Compressed Wide BVHs", HPG 2017). Child boxes are 8-bit offsets from the
// node's origin in units of 2^e per axis. The bits of a child's slot give the side of the node's centre on
// which the child lies (bit 2: x, bit 1: y, bit 0: z), so that (slot XOR octant of the ray) orders the
// children front to back.
//
// Triangles: pairs that share an edge, 64 bytes = 4 texels: corner k is in xyz of texel k. Triangle 0 of a
// pair has the corners 0 1 2, triangle 1 has 3 2 1 (they share the edge from 1 to 2). For each triangle, w of
// its first corner's texel holds the primitive, and w of its third corner's texel the material with flags.
// In a pair without triangle 1, corner 3 equals corner 1. Triangle k of pair p has the index 2p + k.
#ifndef DUOLUX_SHADERS_SHARED_BVH_LAYOUT_H
#define DUOLUX_SHADERS_SHARED_BVH_LAYOUT_H

#include "shaders/shared/kernel_interface.h"

DUOLUX_BEGIN

DUOLUX_CONST uint kNodeTexels = 5u;
DUOLUX_CONST uint kPairTexels = 4u;

// Maximum depth of a wide tree in levels of nodes; also the size of the traversal's stack.
DUOLUX_CONST uint kMaxTreeDepth = 24u;

// Length of a ray without an end point.
DUOLUX_CONST float kInfinity = 1e30f;

// A leaf child holds 1 to 3 pairs.
DUOLUX_CONST uint kMaxLeafPairs = 3u;

// Per-child meta byte. 0: empty. Inner node: 001 in the three high bits, 24 + slot in the low five. Leaf: the
// number of pairs in unary in the three high bits, and in the low five the offset of the first pair from
// WideNode.pairBase.
DUOLUX_CONST uint kMetaInner = 0x20u;

// Instance masks of the driver's acceleration structure, which replaces the nodes with Layout::kRayQuery: all
// triangles, and the copies of the emitting ones that follow them.
DUOLUX_CONST uint kMaskAll = 1u;
DUOLUX_CONST uint kMaskEmitters = 2u;

#ifdef __cplusplus
struct WideNode {
    float origin[3];
    std::uint8_t exponent[3];  // biased as in a float: the unit of an axis is 2^(exponent - 127)
    std::uint8_t innerMask;    // bit s: slot s holds an inner node
    uint childBase;            // index of the first inner child; inner children are consecutive, by slot
    uint pairBase;             // index of the first pair of the leaf children; pairs are consecutive
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
    uint primitive0;  // rank, below 2^31, identical in every copy: orders coincident hits
    vec3 v1;
    uint materialFlags1;  // material index | flags
    vec3 v2;
    uint materialFlags0;
    vec3 v3;
    uint primitive1;
};
static_assert(sizeof(DevicePair) == kPairTexels * 16);
#endif

// The plane of a triangle (kBindingPlanes) is a texel: unit normal on the front side, dot(normal, x).

DUOLUX_CONST uint kMaterialMask = 0x7fffffffu;
DUOLUX_CONST uint kTriangleSmooth = 0x80000000u;  // has shading normals

DUOLUX_END
#endif
