// Traversal of the 8-wide quantised tree of shaders/shared/bvh_layout.h as a state machine that can be left and
// resumed: lanes of a subgroup that have found their hit return and get new rays while the others continue (Aila and
// Laine, "Understanding the Efficiency of Ray Traversal on GPUs", HPG 2009).
//
// The kernel that includes this defines fetchNodeTexel and the functions that fetch_triangle.glsl needs.
#ifndef DUOLUX_LIB_TRAVERSE_GLSL
#define DUOLUX_LIB_TRAVERSE_GLSL

#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require

#include "shaders/lib/fetch_triangle.glsl"
#include "shaders/lib/plane.glsl"
#include "shaders/shared/bvh_layout.h"

// Statements of a kernel that counts what its lanes do.
#ifndef DUOLUX_COUNT_NODE
#define DUOLUX_COUNT_NODE
#define DUOLUX_COUNT_PAIR
#endif

uvec4 fetchNodeTexel(uint index);

// Subgroups of 8 vote by shuffles: lavapipe compiles a shuffle to one instruction, but a ballot to a loop over the
// lanes.
layout(constant_id = kSpecVoteByShuffle) const bool kVoteByShuffle = false;

struct Traversal {
    // The ray. Only hits after (tMin, afterOrder) in the order of (distance, orderOfSurface) count.
    vec3 origin;
    vec3 direction;
    vec3 inverse;
    vec3 axisU;
    vec3 axisV;
    float tMin;
    uint afterOrder;
    bool anyHit;
    uint octant;
    // The nearest hit so far. triangle == kNoTriangle: no hit yet, and only hits before (t, order) count.
    float t;
    uint triangle;
    uint order;
    vec2 barycentric;
    // Position in the tree: the current group of siblings (groupMask: bits 24..31 are the remaining nodes in visiting
    // order, bits 0..7 the slots that hold nodes), and the remaining pairs of triangles.
    uint groupBase;
    uint groupMask;
    uint pairBase;
    uint pairMask;
    int stackSize;
    bool nodesLeft;
};

// The stack of groups of the one traversal that a lane has in flight. It is global because arrays in function
// parameters are copied.
uint stackBase[kMaxTreeDepth];
uint stackMask[kMaxTreeDepth];

// Starts a traversal of the tree whose root is node `root`. If afterOrder is kNoTriangle, surfaces at distance tMin are
// excluded. Surfaces at tMax with orders from `order` on are excluded; the caller may set `order`.
Traversal traversalStart(uint root, vec3 origin, vec3 direction, float tMin, uint afterOrder, float tMax,
                         bool anyHit) {
    Traversal r;
    r.origin = origin;
    r.direction = direction;
    r.inverse = vec3(safeInverse(direction.x), safeInverse(direction.y), safeInverse(direction.z));
    orthonormalBasis(direction, r.axisU, r.axisV);
    r.tMin = tMin;
    r.afterOrder = afterOrder;
    r.anyHit = anyHit;
    r.octant = (r.inverse.x < 0.0 ? 0u : 4u) | (r.inverse.y < 0.0 ? 0u : 2u) | (r.inverse.z < 0.0 ? 0u : 1u);
    r.t = tMax;
    r.triangle = kNoTriangle;
    r.order = kNoTriangle;
    r.barycentric = vec2(0.0);
    r.groupBase = root;
    r.groupMask = 0x80000000u;
    r.pairBase = 0u;
    r.pairMask = 0u;
    r.stackSize = 0;
    r.nodesLeft = true;
    return r;
}

bool traversalAlive(Traversal r) { return r.nodesLeft || r.pairMask != 0u; }

vec4 unpackBytes(uint x) {
    return vec4(float(int(x & 255u)), float(int((x >> 8u) & 255u)), float(int((x >> 16u) & 255u)),
                float(int(x >> 24u)));
}

// Four children of a node: a byte of every word each (WideNode).
struct FourChildren {
    uint meta;
    uvec3 lower;
    uvec3 upper;
};

// Slab tests of four children. Returns bits: inner nodes from bit 24 in visiting order, pairs from bit 0.
uint intersectFourChildren(Traversal r, vec3 scale, vec3 offset, FourChildren c) {
    vec4 nearX = unpackBytes(r.inverse.x < 0.0 ? c.upper.x : c.lower.x) * scale.x + offset.x;
    vec4 farX = unpackBytes(r.inverse.x < 0.0 ? c.lower.x : c.upper.x) * scale.x + offset.x;
    vec4 nearY = unpackBytes(r.inverse.y < 0.0 ? c.upper.y : c.lower.y) * scale.y + offset.y;
    vec4 farY = unpackBytes(r.inverse.y < 0.0 ? c.lower.y : c.upper.y) * scale.y + offset.y;
    vec4 nearZ = unpackBytes(r.inverse.z < 0.0 ? c.upper.z : c.lower.z) * scale.z + offset.z;
    vec4 farZ = unpackBytes(r.inverse.z < 0.0 ? c.lower.z : c.upper.z) * scale.z + offset.z;

    // The meta byte of an inner child is 0x20 | (24 + slot); bits 3 and 4 are both set only in inner children.
    uint isInner = (c.meta & (c.meta << 1u)) & 0x10101010u;
    uint innerBytes = (isInner >> 4u) * 255u;
    uint bitIndices = (c.meta ^ ((r.octant * 0x01010101u) & innerBytes)) & 0x1f1f1f1fu;
    uint childBits = (c.meta >> 5u) & 0x07070707u;

    uint hits = 0u;
    for (int i = 0; i < 4; i++) {
        float near = bitsMax(bitsMax(nearX[i], nearY[i]), bitsMax(nearZ[i], r.tMin));
        float far = bitsMin(bitsMin(farX[i], farY[i]), bitsMin(farZ[i], r.t));
        uint bits = ((childBits >> (8 * i)) & 255u) << ((bitIndices >> (8 * i)) & 31u);
        hits |= near <= far * 1.0000006 ? bits : 0u;  // the relative error of the slab distances
    }
    return hits;
}

// Visits the next node. Requires r.nodesLeft and r.pairMask == 0.
void visitNode(inout Traversal r) {
    uint bit = uint(findMSB(r.groupMask));
    uint slot = (bit - 24u) ^ r.octant;
    r.groupMask &= ~(1u << bit);
    uint node = r.groupBase + uint(bitCount(r.groupMask & ((1u << slot) - 1u) & 255u));
    // The remaining nodes of the group go onto the stack.
    stackBase[r.stackSize] = r.groupBase;
    stackMask[r.stackSize] = r.groupMask;
    r.stackSize += r.groupMask > 0x00ffffffu ? 1 : 0;
    // The next group in case no child is hit. It is read early, so that its latency overlaps with the node's.
    int top = max(r.stackSize - 1, 0);
    uint topBase = stackBase[top];
    uint topMask = stackMask[top];

    uint texel = node * kNodeTexels;
    uvec4 w0 = fetchNodeTexel(texel);
    uvec4 w1 = fetchNodeTexel(texel + 1u);
    uvec4 w2 = fetchNodeTexel(texel + 2u);
    uvec4 w3 = fetchNodeTexel(texel + 3u);
    uvec4 w4 = fetchNodeTexel(texel + 4u);
    vec3 unit = vec3(uintBitsToFloat((w0.w & 255u) << 23u), uintBitsToFloat(((w0.w >> 8u) & 255u) << 23u),
                     uintBitsToFloat(((w0.w >> 16u) & 255u) << 23u));
    vec3 scale = unit * r.inverse;
    vec3 offset = (uintBitsToFloat(w0.xyz) - r.origin) * r.inverse;
    FourChildren low = FourChildren(w1.z, uvec3(w2.x, w2.z, w3.x), uvec3(w3.z, w4.x, w4.z));
    FourChildren high = FourChildren(w1.w, uvec3(w2.y, w2.w, w3.y), uvec3(w3.w, w4.y, w4.w));
    uint hits = intersectFourChildren(r, scale, offset, low) | intersectFourChildren(r, scale, offset, high);
    r.groupBase = w1.x;
    r.groupMask = (hits & 0xff000000u) | (w0.w >> 24u);
    r.pairBase = w1.y;
    r.pairMask = hits & 0x00ffffffu;

    bool none = r.groupMask <= 0x00ffffffu;
    r.nodesLeft = !none || r.stackSize > 0;
    r.stackSize = none ? top : r.stackSize;
    r.groupBase = none ? topBase : r.groupBase;
    r.groupMask = none ? topMask : r.groupMask;
}

void testTriangle(inout Traversal r, Triangle tri, uint index, bool ordered) {
    TriangleHit h = intersectTriangle(tri, r.origin, r.direction, r.axisU, r.axisV, ordered);
    float t = h.t;
    bool front = h.front;
    if (kPlanes) {
        Plane plane = fetchPlane(index);
        t = planeDistance(plane, r.origin, r.direction);
        front = dot(plane.normal, r.direction) < 0.0;
    }
    uint order = orderOfSurface(tri.primitive, front);
    bool accepted = h.hit && t < r.t && t > r.tMin;
    if (ordered) {  // coincident surfaces are crossed one by one
        bool after = t > r.tMin || (t == r.tMin && order > r.afterOrder);
        bool nearer = t < r.t || (t == r.t && order < r.order);
        accepted = h.hit && after && nearer;
    }
    r.t = accepted ? t : r.t;
    r.triangle = accepted ? index : r.triangle;
    r.order = accepted ? order : r.order;
    r.barycentric = accepted ? h.barycentric : r.barycentric;
}

// Tests the next two triangles. Requires r.pairMask != 0.
void testPair(inout Traversal r, bool ordered) {
    uint index = r.pairBase + uint(findLSB(r.pairMask));
    r.pairMask &= r.pairMask - 1u;
    TrianglePair pair = fetchPair(index);
    testTriangle(r, pair.first, 2u * index, ordered);
    testTriangle(r, pair.second, 2u * index + 1u, ordered);
}

// Number of lanes in the subgroup for which `b` is true; decides when to leave a loop. The rays of lanes that have
// already left the loop must be done: the value that a shuffle reads from an inactive lane is undefined; lavapipe
// returns the last.
uint laneCount(bool b) {
    if (!kVoteByShuffle) return subgroupBallotBitCount(subgroupBallot(b));
    uint count = b ? 1u : 0u;
    count += subgroupShuffleXor(count, 1u);
    count += subgroupShuffleXor(count, 2u);
    return count + subgroupShuffleXor(count, 4u);
}

// Continues until the ray is done or fewer than `leaveTraversal` lanes of the subgroup have rays in flight. The node
// loop ends, and triangles are tested, when fewer than `leaveNodes` lanes need another node. `ordered`: see
// testTriangle.
void traverse(inout Traversal r, bool ordered, uint leaveTraversal, uint leaveNodes) {
    while (traversalAlive(r)) {
        while (r.pairMask == 0u && r.nodesLeft) {
            DUOLUX_COUNT_NODE
            visitNode(r);
            if (laneCount(r.pairMask == 0u && r.nodesLeft) < leaveNodes) break;
        }
        if (r.pairMask != 0u) {
            do {
                DUOLUX_COUNT_PAIR
                testPair(r, ordered);
            } while (r.pairMask != 0u);
        }
        if (r.anyHit && r.triangle != kNoTriangle) {
            r.nodesLeft = false;
            r.pairMask = 0u;
        }
        if (laneCount(traversalAlive(r)) < leaveTraversal) break;
    }
}

#endif
