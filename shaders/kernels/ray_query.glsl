// The interface of shaders/lib/traverse.glsl implemented by ray queries: the driver traverses its own tree, and one
// call traces the whole ray.
#extension GL_EXT_ray_query : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require

#include "shaders/lib/fetch_triangle.glsl"
#include "shaders/lib/plane.glsl"

layout(binding = kBindingNodes) uniform accelerationStructureEXT structure;

struct Traversal {
    // The ray. Only hits after (tMin, afterOrder) in the order of (distance, orderOfSurface) count.
    vec3 origin;
    vec3 direction;
    float tMin;
    uint afterOrder;
    bool anyHit;
    uint firstTriangle;  // of the instance that is traversed
    // The nearest hit so far. triangle == kNoTriangle: no hit yet, and only hits before (t, order) count.
    float t;
    uint triangle;
    uint order;
    vec2 barycentric;
    bool nodesLeft;      // the ray has not been traced yet
};

// Traverses all triangles if `root` is 0, otherwise the emitting triangles, of which `root` is the first.
Traversal traversalStart(uint root, vec3 origin, vec3 direction, float tMin, uint afterOrder, float tMax,
                         bool anyHit) {
    return Traversal(origin, direction, tMin, afterOrder, anyHit, root, tMax, kNoTriangle, kNoTriangle, vec2(0.0),
                     true);
}

bool traversalAlive(Traversal r) { return r.nodesLeft; }

uint instanceMask(Traversal r) { return r.firstTriangle == 0u ? kMaskAll : kMaskEmitters; }

// Finds the nearest triangle strictly between tMin and t or, with anyHit, any triangle in this range.
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

// Finds the first triangle after (tMin, afterOrder) in the order of (distance, orderOfSurface). The distance of a
// triangle must be identical in all queries of one ray.
void traverseOrdered(inout Traversal r) {
    // A triangle at exactly tMin may also come after (tMin, afterOrder), but a query excludes both ends of its range.
    // Distances to stored planes differ slightly from the driver's.
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
            // The query skips everything behind a confirmed triangle. The nearest triangle is not confirmed, because
            // the query would then skip the triangles that coincide with it.
            rayQueryConfirmIntersectionEXT(query);
        }
    }
}

// `leaveTraversal` and `leaveNodes` have no effect: lanes cannot leave a ray query before its end.
void traverse(inout Traversal r, bool ordered, uint leaveTraversal, uint leaveNodes) {
    if (!r.nodesLeft) return;
    r.nodesLeft = false;
    if (ordered && (kPlanes || !r.anyHit)) {
        traverseOrdered(r);
    } else {
        traverseNearest(r);
    }
}
