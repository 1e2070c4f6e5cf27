// The interface of shaders/lib/traverse.glsl by ray queries: the driver walks through a tree of its own, and each ray is
// traced to its end at once.
#extension GL_EXT_ray_query : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require

#include "shaders/lib/fetch_triangle.glsl"

layout(binding = kBindingNodes) uniform accelerationStructureEXT structure;

struct Traversal {
    // The ray. Hits are looked for after (tMin, afterPrimitive) in the order of (distance, primitive).
    vec3 origin;
    vec3 direction;
    float tMin;
    uint afterPrimitive;
    bool anyHit;
    uint firstTriangle;  // of the instance that is asked
    // The nearest hit so far; triangle == kNoTriangle: none, and t is the largest distance.
    float t;
    uint triangle;
    uint primitive;
    vec2 barycentric;
    bool nodesLeft;  // the ray has not been traced yet
};

// Through all triangles if `root` is 0, else through the emitting ones, of which that is the first.
Traversal traversalStart(uint root, vec3 origin, vec3 direction, float tMin, uint afterPrimitive, float tMax,
                         bool anyHit) {
    return Traversal(origin, direction, tMin, afterPrimitive, anyHit, root, tMax, kNoTriangle, kNoTriangle, vec2(0.0),
                     true);
}

bool traversalAlive(Traversal r) { return r.nodesLeft; }

uint instanceMask(Traversal r) { return r.firstTriangle == 0u ? kMaskAll : kMaskEmitters; }

// The nearest triangle strictly between tMin and t, or some triangle there.
void traverseNearest(inout Traversal r) {
    uint flags = gl_RayFlagsOpaqueEXT | (r.anyHit ? gl_RayFlagsTerminateOnFirstHitEXT : 0u);
    rayQueryEXT query;
    rayQueryInitializeEXT(query, structure, flags, instanceMask(r), r.origin, r.tMin, r.direction, r.t);
    while (rayQueryProceedEXT(query)) {
    }
    if (rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT) return;
    r.t = rayQueryGetIntersectionTEXT(query, true);
    r.triangle = r.firstTriangle + uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, true));
    r.barycentric = rayQueryGetIntersectionBarycentricsEXT(query, true);
}

// The first triangle after (tMin, afterPrimitive) in the order of (distance, primitive). The distance of a triangle must
// be the same in all queries of one ray.
void traverseOrdered(inout Traversal r) {
    // Triangles at tMin itself may come after, too, and queries leave out both ends of their range.
    float tBefore = r.tMin > 0.0 ? uintBitsToFloat(floatBitsToUint(r.tMin) - 1u) : r.tMin;
    rayQueryEXT query;
    rayQueryInitializeEXT(query, structure, gl_RayFlagsNoOpaqueEXT, instanceMask(r), r.origin, tBefore, r.direction, r.t);
    while (rayQueryProceedEXT(query)) {
        float t = rayQueryGetIntersectionTEXT(query, false);
        uint triangle = r.firstTriangle + uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
        uint primitive = fetchTriangle(triangle).primitive;
        bool after = t > r.tMin || (t == r.tMin && primitive > r.afterPrimitive);
        if (after && (t < r.t || (t == r.t && primitive < r.primitive))) {
            r.t = t;
            r.triangle = triangle;
            r.primitive = primitive;
            r.barycentric = rayQueryGetIntersectionBarycentricsEXT(query, false);
        } else if (t > r.t) {
            // Whatever is behind a confirmed triangle is left out. The nearest one is not confirmed, because those that
            // coincide with it would be left out, too.
            rayQueryConfirmIntersectionEXT(query);
        }
    }
}

// `leaveTraversal` and `leaveNodes` say when lanes leave a walk through our tree; this one they cannot leave.
void traverse(inout Traversal r, bool ordered, uint leaveTraversal, uint leaveNodes) {
    if (!r.nodesLeft) return;
    r.nodesLeft = false;
    if (ordered && !r.anyHit) {
        traverseOrdered(r);
    } else {
        traverseNearest(r);
    }
}
