// The interface of shaders/lib/traverse.glsl by ray queries: the driver walks through a tree of its own, and each ray is
// traced to its end at once.
#extension GL_EXT_ray_query : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require

#include "shaders/lib/fetch_triangle.glsl"
#include "shaders/lib/plane.glsl"

layout(binding = kBindingNodes) uniform accelerationStructureEXT structure;

struct Traversal {
    // The ray. Hits are looked for after (tMin, afterOrder) in the order of (distance, orderOfSurface).
    vec3 origin;
    vec3 direction;
    float tMin;
    uint afterOrder;
    bool anyHit;
    uint firstTriangle;  // of the instance that is asked
    // The nearest hit so far; triangle == kNoTriangle: none, and hits are before (t, order).
    float t;
    uint triangle;
    uint order;
    vec2 barycentric;
    bool nodesLeft;  // the ray has not been traced yet
};

// Through all triangles if `root` is 0, else through the emitting ones, of which that is the first.
Traversal traversalStart(uint root, vec3 origin, vec3 direction, float tMin, uint afterOrder, float tMax,
                         bool anyHit) {
    return Traversal(origin, direction, tMin, afterOrder, anyHit, root, tMax, kNoTriangle, kNoTriangle, vec2(0.0), true);
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

// The first triangle after (tMin, afterOrder) in the order of (distance, orderOfSurface). The distance of a triangle must
// be the same in all queries of one ray.
void traverseOrdered(inout Traversal r) {
    // Triangles at tMin itself may come after, too, and queries leave out both ends of their range. Distances along stored
    // planes are not quite the driver's.
    float tBefore = r.tMin > 0.0 ? uintBitsToFloat(floatBitsToUint(r.tMin) - 1u) : r.tMin;
    float tBehind = r.t;
    if (kPlanes) {
        float size = abs(r.tMin) + length(r.origin);
        tBefore = max(r.tMin - 1e-5 * size, 0.0);
        tBehind = r.t + 1e-5 * size;
    }
    rayQueryEXT query;
    rayQueryInitializeEXT(query, structure, gl_RayFlagsNoOpaqueEXT, instanceMask(r), r.origin, tBefore, r.direction,
                          tBehind);
    while (rayQueryProceedEXT(query)) {
        float t = rayQueryGetIntersectionTEXT(query, false);
        uint triangle = r.firstTriangle + uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
        Triangle tri = fetchTriangle(triangle);
        bool front = dot(cross(tri.v1 - tri.v0, tri.v2 - tri.v0), r.direction) < 0.0;
        if (kPlanes) {
            Plane plane = fetchPlane(triangle);
            t = planeDistance(plane, r.origin, r.direction);
            front = dot(plane.normal, r.direction) < 0.0;
        }
        uint order = orderOfSurface(tri.primitive, front);
        bool after = t > r.tMin || (t == r.tMin && order > r.afterOrder);
        if (after && (t < r.t || (t == r.t && order < r.order))) {
            r.t = t;
            r.triangle = triangle;
            r.order = order;
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
    if (ordered && (kPlanes || !r.anyHit)) {
        traverseOrdered(r);
    } else {
        traverseNearest(r);
    }
}
