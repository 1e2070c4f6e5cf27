// The path tracer: paths from the camera carry a matrix of importance W per colour channel, whose rows are the two
// components of the pixel. At a surface W E is collected; W O f_opaque continues in a new direction, W T straight on.
//
// A team of lanes takes some samples of each of a range of pixels. Path rays and shadow rays share one traversal, which
// lanes leave and enter as they finish and begin rays. All crossings along a ray are met in order: at each, emission
// and direct light are added, and one of them is chosen, in proportion to the importance that it would carry, to
// continue from.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/kernels/film_layers.glsl"
#include "shaders/kernels/scene.glsl"
#include "shaders/lib/pixel_sums.glsl"

layout(constant_id = kSpecDirectLight) const uint kDirectLight = kDirectLightSampled;
layout(constant_id = kSpecEmittingTriangles) const bool kEmittingTriangles = true;

layout(binding = kBindingPixels, rgba32ui) uniform readonly uimageBuffer pixelTexels;
layout(binding = kBindingResults, scalar) writeonly buffer ResultsBlock { PixelResult results[]; };
layout(push_constant, scalar) uniform DispatchBlock { PathTracerDispatch dispatch; };

#include "shaders/kernels/segment.glsl"
#include "shaders/kernels/camera_path.glsl"
#include "shaders/kernels/direct_light.glsl"
#include "shaders/kernels/team.glsl"

// Whether a path can find emission after a scattering event. (The closed form is used where T has no second column.)
const bool kPathsContinue = kDirectLight != kDirectLightClosedForm || kInvisibleScatters;

// The path continues from the chosen vertex of the segment, or ends.
void endSegment(inout Path path, inout Vertex vertex) {
    float weightSum = vertex.weightSum;
    vertex.weightSum = 0.0;
    path.ended = true;
    if (!kPathsContinue || !(weightSum > 0.0)) return;
    float survival;
    if (!survives(path.stream, path.scatterings, path.crossings, weightSum, survival)) return;

    vec2 u = drawPair(path.stream, sampleDimension(path.scatterings, 0u, kDimensionDirection));
    BsdfSample s = scatter(vertex, -path.segment.direction, u, path.stream, path.scatterings, kModeRadiance);
    path.importance = scaled(path.scattered, s.weight * (weightSum / (vertex.weight * survival)));
    path.segment = leaveVertex(vertex.point, vertex.bsdf, s.wi);
    path.bsdfPdf = s.pdf;
    path.scatterings += 1u;
    path.crossings = 0u;
    path.ended = !(s.pdf > 0.0);
}

// Whether the layer of normals still waits for the first surface of which something is there.
bool showsNormal(Path path) { return kLayerNormal && path.scatterings == 0u && layers.normal == vec3(0.0); }

// The path has met a surface: emission, direct light, a candidate for scattering, and the crossing.
void meetSurface(inout Path path, inout Vertex vertex, inout Shadow shadow, inout SampleRadiance received,
                 Traversal ray, Triangle tri, SurfaceHit hit) {
    ReflectanceMatrix onSegment = importanceOf(path);
    ReflectanceMatrix w = onSegment;
    if (kCoverage || kAttenuates) w = scaled(w, hit.unabsorbed * hit.coverage);
    vec3 wo = -path.segment.direction;
    if (showsNormal(path) && hit.coverage > 0.0) layers.normal = hit.point.shadingNormal;
    if (kEmittingTriangles) collectEmission(received, path, hit, w, ray.t, tri.primitive);

    ReflectanceMatrix scattered = multiply(w, opaqueOf(hit.materialIndex));
    vec3 albedo = bsdfAlbedo(hit.bsdf, frameOf(hit.point, hit.bsdf), wo);
    float weight = matrixWeight(scaled(scattered, albedo), params.rowWeight);
    if (path.scatterings < params.bounces && materialScatters(hit.material, hit.front) && weight > 0.0) {
        if (kDirectLight == kDirectLightClosedForm) addClosedForm(received, hit, scattered, path.scatterings + 1u);
        if (kDirectLight == kDirectLightSampled) {
            uvec2 u = drawWords(path.stream, sampleDimension(path.scatterings, path.crossings, kDimensionEmitter));
            connectToEmitter(shadow, received, hit, scattered, wo, u, path.scatterings + 1u);
        }
        float u = 0.0;
        if (kPathsContinue) u = crossingChoice(path.stream, path.scatterings, path.crossings);
        if (offerVertex(vertex, hit.bsdf, hit.point, weight, u)) path.scattered = scattered;
    }

    bool passes = false;
    if (kTransparency != kTransparencyZero && canCross(onSegment)) {
        path.importance = crossed(onSegment, hit.materialIndex, hit.coverage);
        ReflectanceMatrix m = path.importance;
        passes = maxComponent(m.m00 + m.m01 + m.m10 + m.m11) > 0.0;
        crossSurface(path.segment, ray);
        path.crossings += 1u;
    }
    if (!passes) endSegment(path, vertex);
}

uint pixelInOrder(uint place) {
    uint index = dispatch.firstPixel + place;
    return imageLoad(pixelTexels, int(index >> 2u))[index & 3u];
}

// The next ray: the shadow ray first, then the path's. `inEmitterTree`: the path looks only for emitters.
Traversal nextRay(Path path, Shadow shadow, bool inEmitterTree, inout PixelSums sums) {
    bool onPath = !shadow.pending;
    bool fromCamera = onCameraSegment(path);
    sums.shadowRays += shadow.pending ? 1u : 0u;
    sums.cameraRays += onPath && fromCamera ? 1u : 0u;
    sums.bounceRays += onPath && !fromCamera && !inEmitterTree ? 1u : 0u;
    sums.emitterRays += onPath && inEmitterTree ? 1u : 0u;
    // Selected field by field, which is faster on lavapipe than a branch.
    Traversal ray = traversalStart(inEmitterTree && onPath ? params.emitterRoot : 0u,
                                   shadow.pending ? shadow.segment.origin : path.segment.origin,
                                   shadow.pending ? shadow.segment.direction : path.segment.direction,
                                   shadow.pending ? shadow.segment.t : path.segment.t,
                                   shadow.pending ? shadow.segment.order : path.segment.order,
                                   shadow.pending ? shadow.distance : kInfinity,
                                   shadow.pending && kTransparency == kTransparencyZero);
    if (kPlanes && shadow.pending) ray.order = shadow.beforeOrder;
    return ray;
}

Traversal cameraRayOf(Path path) {
    return traversalStart(0u, path.segment.origin, path.segment.direction, 0.0, kNoTriangle, kInfinity, false);
}

void main() {
    Team team = teamOfLane(dispatch.teamPixels, dispatch.pixelCount, dispatch.firstTeam);
    if (team.items == 0u) return;
    uint taken = takeItem(team);
    uint endSample = dispatch.firstSample + dispatch.sampleCount;
    PixelSums sums = emptyPixelSums();
    emptyLayers();
    SampleRadiance received = noRadiance();
    Vertex vertex;
    vertex.weightSum = 0.0;
    Shadow shadow;
    shadow.pending = false;
    Path path = cameraPath(uvec2(pixelInOrder(itemOf(team, taken)), dispatch.firstSample));
    Traversal ray = cameraRayOf(path);

    while (taken < team.items) {
        // Until some lane has all samples of its pixel.
        do {
            traverse(ray, kOrdered, kLeaveTraversal, kLeaveNodes);
            if (!traversalAlive(ray)) {
                bool found = ray.triangle != kNoTriangle;
                Triangle tri = fetchTriangle(found ? ray.triangle : 0u);
                // Shadow rays and paths share one look-up, because lavapipe executes both sides of a branch.
                uint groups = !found ? 0u : shadow.pending ? kCoverageGroups : kTextureGroups;
                SurfaceHit hit = meetTriangle(path.segment, ray, tri, -path.segment.direction, groups);
                if (shadow.pending) {
                    continueShadow(shadow, received, ray, found, hit.materialIndex, hit.coverage);
                } else if (found) {
                    meetSurface(path, vertex, shadow, received, ray, tri, hit);
                } else {
                    endSegment(path, vertex);
                }

                bool emissionOnly = onlyEmissionLeft(path) && !onCameraSegment(path) && !showsNormal(path);
                if (kTransparency == kTransparencyIdentity) {
                    // Most rays that only look for emitters, and that nothing stops, pass far from all of them.
                    while (emissionOnly && passesAll(path) && !path.ended &&
                           !intersectBox(path.segment.origin, path.segment.direction, path.segment.t,
                                         params.emitterLower, params.emitterUpper)) {
                        endSegment(path, vertex);
                        emissionOnly = onlyEmissionLeft(path);
                    }
                }
                bool emissionCounts =
                    kEmittingTriangles && (kDirectLight != kDirectLightClosedForm || path.scatterings == 0u);
                if (emissionOnly && !emissionCounts) path.ended = true;
                // Emitters along a ray that nothing else can stop are found in their own small tree.
                bool inEmitterTree = passesAll(path) && emissionOnly;
                if (path.ended && !shadow.pending) {
                    addSample(sums, received, dispatch.inverseQuantum,
                              filmRounding(path.stream.x, path.stream.y, kDimensionRounding, params.seed));
                    addLayers();
                    received = noRadiance();
                    path = cameraPath(path.stream + uvec2(0u, 1u));
                    inEmitterTree = false;
                }
                ray = nextRay(path, shadow, inEmitterTree, sums);
            }
        } while (subgroupBallot(path.stream.y == endSample) == uvec4(0u));

        if (path.stream.y == endSample) {
            results[dispatch.firstResult + team.begin + taken] = pixelResult(sums);
            storeLayers(dispatch.firstResult + team.begin + taken);
            finishItem(team);
            taken = takeItem(team);
            sums = emptyPixelSums();
            emptyLayers();
            path = cameraPath(uvec2(pixelInOrder(itemOf(team, taken)), dispatch.firstSample));
            ray = cameraRayOf(path);
            ray.nodesLeft = taken < team.items;
        }
    }
}
