// Closed meshes of 8 and 20 triangles, every ray against every triangle: no ray passes between triangles. The
// principle is exact: each corner is projected to the same place for all triangles, and a difference of two
// rounded products has the sign of the exact one, or is 0, which counts as inside.
#include "shaders/lib/intersect.glsl"

// Octahedron: corners 2k and 2k + 1 on axis k. Icosahedron: the cyclic permutations of (0, +-1, +-golden ratio), faces
// counter-clockwise from outside.
const float kGolden = 1.618034;
const vec3 kIcosahedron[12] = vec3[](
    vec3(0.0, 1.0, kGolden), vec3(0.0, 1.0, -kGolden), vec3(0.0, -1.0, kGolden), vec3(0.0, -1.0, -kGolden),
    vec3(1.0, kGolden, 0.0), vec3(1.0, -kGolden, 0.0), vec3(-1.0, kGolden, 0.0), vec3(-1.0, -kGolden, 0.0),
    vec3(kGolden, 0.0, 1.0), vec3(-kGolden, 0.0, 1.0), vec3(kGolden, 0.0, -1.0), vec3(-kGolden, 0.0, -1.0));
const uvec3 kFaces[20] = uvec3[](
    uvec3(0, 2, 8), uvec3(0, 8, 4), uvec3(0, 4, 6), uvec3(0, 6, 9), uvec3(0, 9, 2), uvec3(3, 10, 5), uvec3(3, 1, 10),
    uvec3(3, 11, 1), uvec3(3, 7, 11), uvec3(3, 5, 7), uvec3(2, 5, 8), uvec3(8, 5, 10), uvec3(8, 10, 4), uvec3(4, 10, 1),
    uvec3(4, 1, 6), uvec3(6, 1, 11), uvec3(6, 11, 9), uvec3(9, 11, 7), uvec3(9, 7, 2), uvec3(2, 7, 5));

vec3 corners[12];
uint faceCount;

uvec3 face(uint i) {
    return faceCount == 20u ? kFaces[i] : uvec3(i & 1u, 2u + ((i >> 1u) & 1u), 4u + (i >> 2u));
}

// A mesh of random shape, squeezed along a random direction to a hundredth at most.
void makeMesh(bool icosahedron, float scale, vec3 offset) {
    faceCount = icosahedron ? 20u : 8u;
    vec3 along = randomDirection();
    float squeeze = randomScale(-6.6, 0.0) - 1.0;
    for (uint i = 0u; i < 12u; i++) {
        vec3 p = kIcosahedron[i];
        if (!icosahedron) {
            p = vec3(0.0);
            p[(i / 2u) % 3u] = (i & 1u) == 0u ? 1.0 : -1.0;
        }
        p *= randomFloat(0.7, 1.4);
        corners[i] = (p + along * (dot(p, along) * squeeze)) * scale + offset;
    }
}

struct Crossings { uint front; uint back; float nearest; };

Crossings crossingsOf(vec3 origin, vec3 direction, bool once) {
    vec3 axisU, axisV;
    orthonormalBasis(direction, axisU, axisV);
    Crossings found = Crossings(0u, 0u, 1e30);
    for (uint i = 0u; i < faceCount; i++) {
        uvec3 f = face(i);
        Triangle tri = Triangle(corners[f.x], corners[f.y], corners[f.z], i, 0u);
        TriangleHit h = intersectTriangle(tri, origin, direction, axisU, axisV, once);
        found.front += h.hit && h.front ? 1u : 0u;
        found.back += h.hit && !h.front ? 1u : 0u;
        found.nearest = h.hit && h.t > 0.0 ? min(found.nearest, h.t) : found.nearest;
    }
    return found;
}

// A corner, a point on an edge, or a point close to an edge.
vec3 target() {
    uvec3 f = face(randomUint() % faceCount);
    uint kind = randomUint() % 4u;
    vec3 p = corners[f.x];
    vec3 q = corners[f.y];
    float s = kind == 0u ? 0.0 : randomFloat();
    vec3 onEdge = p * (1.0 - s) + q * s;
    return kind == 3u ? mix(onEdge, corners[f.z], randomScale(-24.0, -2.0)) : onEdge;
}

void countLeaks(bool icosahedron, float scale, vec3 offset) {
    makeMesh(icosahedron, scale, offset);
    uint leaks = 0u;
    for (uint i = 0u; i < 64u; i++) {
        vec3 origin = offset + (target() - offset) * randomFloat(0.0, 0.05);
        Crossings found = crossingsOf(origin, normalize(target() - origin), i % 2u == 0u);
        leaks += found.nearest < 1e30 ? 0u : 1u;
    }
    EXPECT_EQ(leaks, 0u);
}

// 2^16 x 64 and 2^17 x 64 rays: 1.26e7 in all.
TEST_N(NothingLeaksThroughIcosahedra, 65536) {
    countLeaks(true, randomScale(-10.0, 20.0), vec3(0.0));
}

TEST_N(NothingLeaksThroughOctahedraFarFromTheOrigin, 131072) {
    float scale = randomScale(-10.0, 20.0);
    countLeaks(false, scale, randomDirection() * scale * randomScale(0.0, 10.0));
}

// Edges along which the edge functions are exactly 0: the coordinate planes of the regular octahedron.
TEST(NothingLeaksWhereEdgeFunctionsVanish) {
    faceCount = 8u;
    for (uint i = 0u; i < 6u; i++) {
        corners[i] = vec3(0.0);
        corners[i][i / 2u] = (i & 1u) == 0u ? 1.0 : -1.0;
    }
    vec3 d = vec3(0.0);
    uint axis = randomUint() % 3u;
    d[axis] = (randomUint() & 1u) == 0u ? 1.0 : -1.0;
    EXPECT_LT(crossingsOf(vec3(0.0), d, true).nearest, 1e30);
    d[(axis + 1u) % 3u] = randomFloat(-2.0, 2.0);
    EXPECT_LT(crossingsOf(vec3(0.0), normalize(d), true).nearest, 1e30);
    // From outside, straight at a corner, and along an edge.
    EXPECT_LT(crossingsOf(vec3(-3.0, 0.0, 0.0), vec3(1.0, 0.0, 0.0), true).nearest, 1e30);
    EXPECT_LT(crossingsOf(vec3(-0.25, -3.0, 0.0), vec3(0.0, 1.0, 0.0), true).nearest, 1e30);
}

// A ray that enters a closed surface also leaves it, even at silhouettes; with `once`, it does both equally often.
TEST_N(RaysFromOutsideEnterIffTheyLeave, 16384) {
    makeMesh(true, randomScale(-10.0, 20.0), vec3(0.0));
    uint unmatched = 0u;
    uint unequal = 0u;
    uint met = 0u;
    for (uint i = 0u; i < 64u; i++) {
        vec3 p = target();
        vec3 origin = p + randomDirection() * length(corners[0]) * randomFloat(4.0, 8.0);
        bool once = i % 2u == 0u;
        Crossings found = crossingsOf(origin, normalize(p - origin), once);
        met += found.front > 0u ? 1u : 0u;
        unmatched += (found.front > 0u) == (found.back > 0u) ? 0u : 1u;
        unequal += once && found.front != found.back ? 1u : 0u;
    }
    EXPECT_GT(met, 16u);
    EXPECT_EQ(unmatched, 0u);
    EXPECT_EQ(unequal, 0u);
}

// Along the edges and through the corners of the regular octahedron, where edge functions are exactly 0.
TEST(WhereEdgeFunctionsVanishASurfaceIsMetOnce) {
    faceCount = 8u;
    for (uint i = 0u; i < 6u; i++) {
        corners[i] = vec3(0.0);
        corners[i][i / 2u] = (i & 1u) == 0u ? 1.0 : -1.0;
    }
    uint axis = randomUint() % 3u;
    vec3 d = vec3(0.0);
    d[axis] = (randomUint() & 1u) == 0u ? 1.0 : -1.0;
    d[(axis + 1u) % 3u] = testIndex() % 2u == 0u ? 0.0 : float(int(randomUint() % 9u) - 4);
    Crossings found = crossingsOf(vec3(0.0), normalize(d), true);
    // Includes crossings behind the ray's origin: a line crosses the closed surface twice.
    EXPECT_EQ(found.front + found.back, 2u);
}

// A sheet of triangles with sides of 1, seen from up to a million sides away: each ray crosses it once.
const uint kSheet = 6u;

TEST_N(ASheetIsCrossedOnceFromAnyDistance, 8192) {
    vec3 x, y;
    vec3 normal = randomDirection();
    orthonormalBasis(normal, x, y);
    uint wrong = 0u;
    for (uint i = 0u; i < 8u; i++) {
        vec3 towards = randomDirection();
        towards = dot(towards, normal) < 0.0 ? -towards : towards;
        vec3 origin = normalize(towards + normal) * randomScale(1.0, 20.0);
        // A corner, a point on an edge, or any point.
        uint kind = randomUint() % 4u;
        vec2 cell = vec2(float(int(randomUint() % 3u) - 1), float(int(randomUint() % 3u) - 1));
        float s = randomFloat();
        vec2 inCell = kind == 0u ? vec2(0.0) : (kind == 1u ? vec2(s, 0.0) : (kind == 2u ? vec2(s, s) : randomVec2()));
        vec3 p = (cell.x + inCell.x) * x + (cell.y + inCell.y) * y;
        vec3 direction = normalize(p - origin);
        vec3 axisU, axisV;
        orthonormalBasis(direction, axisU, axisV);
        uint crossings = 0u;
        for (uint k = 0u; k < 2u * kSheet * kSheet; k++) {
            vec2 corner = vec2(float(int((k >> 1u) % kSheet)), float(int((k >> 1u) / kSheet))) - 3.0;
            vec2 a = corner + ((k & 1u) == 0u ? vec2(1.0, 0.0) : vec2(0.0, 1.0));
            vec2 far = corner + 1.0;
            vec3 v0 = corner.x * x + corner.y * y;
            vec3 v1 = a.x * x + a.y * y;
            vec3 v2 = far.x * x + far.y * y;
            // Both windings, as exporters write them.
            Triangle tri = (k & 2u) == 0u ? Triangle(v0, v1, v2, k, 0u) : Triangle(v0, v2, v1, k, 0u);
            crossings += intersectTriangle(tri, origin, direction, axisU, axisV, true).hit ? 1u : 0u;
        }
        wrong += crossings == 1u ? 0u : 1u;
    }
    EXPECT_EQ(wrong, 0u);
}
