// Gathering: paths from the camera carry a matrix of importance W per colour channel, whose rows are the two components
// of the pixel. At a surface W E is collected; W O f_opaque goes on in a new direction, W T straight on.
//
// A team of lanes takes some samples of each of a range of pixels: a lane that has finished a pixel takes the team's next,
// so that all stay busy. Path rays and shadow rays share one traversal, which lanes leave and enter as they finish and
// begin rays. All crossings along a ray are met in order: at each, emission and next-event
// estimation are gathered, and one of them is chosen, in proportion to the importance it would carry, to scatter on.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/kernels/film_layers.glsl"
#include "shaders/kernels/scene.glsl"
#include "shaders/lib/polygon_light.glsl"
#include "shaders/lib/slot_sums.glsl"

layout(constant_id = kSpecDirectLight) const uint kDirectLight = kDirectLightSampled;
layout(constant_id = kSpecHasEmitters) const bool kHasEmitters = true;

layout(binding = kBindingPixels, rgba32ui) uniform readonly uimageBuffer pixelTexels;
layout(binding = kBindingResults, scalar) writeonly buffer ResultsBlock { SlotResult results[]; };
layout(push_constant, scalar) uniform DispatchBlock { DispatchParams dispatch; };

// Whether anything can be gathered after a scattering event. (Nothing in between means T without a second column.)
const bool kPathsGoOn = kDirectLight != kDirectLightClosedForm || kInvisibleScatters;

// A path under way: the segment it is on.
struct Path {
    LightMatrix importance;  // W up to here on the segment, the transmittances of the surfaces crossed included
    vec3 origin;
    vec3 direction;
    float t;             // the last surface crossed on the segment, and where: the walk goes on after it
    uint order;
    float bsdfPdf;       // density of the direction, per steradian
    uint scatterings;    // events before the segment
    uint crossings;      // on the segment
    bool ended;
};

// Where a path may scatter. One vertex of a segment is kept, by weighted reservoir sampling.
struct Vertex {
    LightMatrix importance;  // W O, of the chosen vertex
    Bsdf bsdf;
    SurfacePoint point;
    float weight;            // of the chosen vertex
    float weightSum;         // of all vertices of the segment
};

// A shadow ray under way.
struct Shadow {
    bool pending;
    vec3 origin;
    vec3 direction;
    float distance;      // of the emitter, and its order if it has coincident surfaces
    uint beforeOrder;
    float t;             // last surface crossed
    uint order;
    LightMatrix importance;  // W O f cos / pdf and what was crossed so far (kTransmittanceGeneral)
    Light emission;          // of the emitter (kTransmittanceGeneral), or else the contribution if nothing is in between
    uint scatterings;        // events on the whole path, for the statistics
};

void gather(inout Gathered gathered, Light light, uint scatterings) {
    gather(gathered, light, scatterings, params.bounces, params.display);
}

Path cameraPath(uint pixel, vec2 u) {
    uint width = params.camera.width;
    vec2 position = vec2(float(int(pixel % width)), float(int(pixel / width))) + u;
    Path path;
    path.importance = lightIdentity();
    CameraRay ray = cameraRay(params.camera, position);
    path.origin = ray.origin;
    path.direction = ray.direction;
    path.t = 0.0;
    path.order = kNoTriangle;
    path.bsdfPdf = 0.0;
    path.scatterings = 0u;
    path.crossings = 0u;
    path.ended = false;
    return path;
}

// Next-event estimation at a vertex: sets up a shadow ray, or gathers at once where nothing can be in between.
void connectToLight(inout Shadow shadow, inout Gathered gathered, Vertex vertex, vec3 wo, uvec2 u, uint scatterings) {
    LightSample light = sampleLight(params.lightCount, u);
    vec3 offset = light.position - vertex.point.position;
    float side = dot(light.normal, offset) < 0.0 ? 1.0 : -1.0;
    // To just in front of the emitter, which must not hide itself; or to itself, if surfaces that coincide with it may.
    vec3 toLight = offset + light.normal * (light.coincident != 0u ? 0.0 : side * light.positionError);
    float distanceSquared = dot(toLight, toLight);
    float distance = sqrt(distanceSquared);
    vec3 direction = toLight / distance;
    float cosAtLight = dot(light.normal, direction);
    Material material = fetchMaterial(light.material);
    Light emission = materialEmission(material, cosAtLight < 0.0);

    float pdf = pdfAreaToSolidAngle(material.lightPdfArea, distanceSquared, cosAtLight);
    vec3 localWo = toFrame(vertex.point.shadingNormal, wo);
    vec3 localWi = toFrame(vertex.point.shadingNormal, direction);
    float cosAtVertex = localWi.z;
    vec3 f = bsdfEvaluate(vertex.bsdf, localWo, localWi);
    // The weight of the balance heuristic, pdf / (pdf + bsdfPdf), over pdf.
    float weight = 1.0 / (pdf + bsdfPdf(vertex.bsdf, localWo, localWi));
    LightMatrix importance = lightScale(vertex.importance, f * (cosAtVertex * weight));
    Light contribution = lightApply(importance, emission);
    bool contributes = cosAtVertex > 0.0 && dot(vertex.point.geometricNormal, direction) > 0.0 && distance > 0.0 &&
                       maxComponent(contribution.invisible + contribution.visible) > 0.0;
    if (kTransmittance == kTransmittanceIdentity) {
        if (contributes) gather(gathered, contribution, scatterings);
    } else if (contributes) {
        RayBegin begin = leaveSurface(vertex.point, direction);
        shadow.pending = true;
        shadow.origin = begin.origin;
        shadow.direction = direction;
        shadow.distance = distance;
        shadow.beforeOrder = kNoTriangle;
        if (light.coincident != 0u) {
            Plane plane = fetchPlane(light.triangle);
            shadow.distance = planeDistance(plane, begin.origin, direction);
            shadow.beforeOrder = orderOfSurface(light.primitive, dot(plane.normal, direction) < 0.0);
        }
        shadow.t = begin.t;
        shadow.order = begin.order;
        shadow.scatterings = scatterings;
        if (kTransmittance == kTransmittanceGeneral) {
            shadow.importance = importance;
            shadow.emission = emission;
        } else {
            shadow.emission = contribution;
        }
    }
}

// Light from all emitters on a diffuse vertex, nothing being in between.
void gatherClosedForm(inout Gathered gathered, Vertex vertex, uint scatterings) {
    Light total = Light(vec3(0.0), vec3(0.0));
    for (uint i = 0u; i < params.lightCount; i++) {
        LightTriangle light = fetchLight(i);
        vec3 a = light.v0 - vertex.point.position;
        vec3 edge1 = light.v1 - light.v0;
        vec3 edge2 = light.v2 - light.v0;
        bool front = dot(cross(edge1, edge2), a) < 0.0;
        Light emission = materialEmission(fetchMaterial(light.material), front);
        float solidAngle = projectedSolidAngle(a, edge1, edge2, vertex.point.shadingNormal);
        total.invisible += emission.invisible * solidAngle;
        total.visible += emission.visible * solidAngle;
    }
    LightMatrix importance = lightScale(vertex.importance, vertex.bsdf.diffuse * (1.0 / kPi));
    gather(gathered, lightApply(importance, total), scatterings);
}

// The path goes on from the chosen vertex of the segment, or ends.
void endSegment(inout Path path, inout Vertex vertex, uint pixel, uint sampleIndex) {
    float weightSum = vertex.weightSum;
    vertex.weightSum = 0.0;
    path.ended = true;
    if (!kPathsGoOn || !(weightSum > 0.0)) return;
    // Russian roulette on the importance that all vertices of the segment would carry, in units of the camera's.
    float survival = path.scatterings >= 2u ? survivalProbability(weightSum) : 1.0;
    uint choice = sampleDimension(path.scatterings, path.crossings, kDimensionChoice);
    if (sampleChoice(pixel, sampleIndex, choice, params.seed).y >= survival) return;

    vec2 u = samplePair(kSampler, pixel, sampleIndex, sampleDimension(path.scatterings, 0u, kDimensionDirection),
                        params.seed);
    BsdfSample s = bsdfSample(vertex.bsdf, toFrame(vertex.point.shadingNormal, -path.direction), u);
    vec3 direction = fromFrame(vertex.point.shadingNormal, s.wi);
    path.importance =
        lightScale(vertex.importance, s.weight * (weightSum / (vertex.weight * survival)));
    RayBegin begin = leaveSurface(vertex.point, direction);
    path.origin = begin.origin;
    path.direction = direction;
    path.t = begin.t;
    path.order = begin.order;
    path.bsdfPdf = s.pdf;
    path.scatterings += 1u;
    path.crossings = 0u;
    path.ended = !(s.pdf > 0.0 && dot(vertex.point.geometricNormal, direction) > 0.0);
}

bool onlyEmissionLeft(Path path) {
    return path.scatterings >= params.bounces || !canScatter(path.importance);
}

// Without the second column all importance is on the first, but for the visible row of the camera's own segment.
LightMatrix importanceOf(Path path) {
    if (kSecondColumn) return path.importance;
    float atCamera = path.scatterings + path.crossings == 0u ? 1.0 : 0.0;
    return LightMatrix(path.importance.m00, vec3(0.0), path.importance.m10, vec3(atCamera));
}

// The shadow ray has met a surface, or nothing more up to the emitter.
void meetShadow(inout Shadow shadow, inout Gathered gathered, Traversal ray, bool found, uint material) {
    if (kTransmittance == kTransmittanceGeneral && found) {
        LightMatrix m = multiply(shadow.importance, transparentOf(material));
        shadow.importance = m;
        shadow.t = ray.t;
        shadow.order = ray.order;
        shadow.pending = maxComponent(m.m00 + m.m01 + m.m10 + m.m11) > 0.0;
        return;
    }
    if (!found) {
        bool general = kTransmittance == kTransmittanceGeneral;
        gather(gathered, general ? lightApply(shadow.importance, shadow.emission) : shadow.emission, shadow.scatterings);
    }
    shadow.pending = false;
}

// The path has met a surface: emission, next-event estimation, a candidate for scattering, and the crossing.
void meetSurface(inout Path path, inout Vertex vertex, inout Shadow shadow, inout Gathered gathered, Traversal ray,
                 Triangle tri, uint pixel, uint sampleIndex) {
    uint materialIndex = tri.materialFlags & kMaterialMask;
    Material material = fetchMaterial(materialIndex);
    vec3 normal = normalize(cross(tri.v1 - tri.v0, tri.v2 - tri.v0));
    float cosine = dot(normal, path.direction);
    bool front = cosine < 0.0;
    LightMatrix w = importanceOf(path);
    if (kLayerNormal && path.scatterings + path.crossings == 0u)
        layers.normal = surfacePoint(tri, ray.triangle, ray.barycentric, normal, path.direction, kSmoothNormals).shadingNormal;

    float pdfOfLight = pdfAreaToSolidAngle(material.lightPdfArea, ray.t * ray.t, cosine);
    float misWeight = path.scatterings > 0u ? balanceHeuristic(path.bsdfPdf, pdfOfLight) : 1.0;
    if (kDirectLight == kDirectLightClosedForm) misWeight = path.scatterings > 0u ? 0.0 : 1.0;
    Light collected = lightApply(w, materialEmission(material, front));
    gather(gathered, Light(collected.invisible * misWeight, collected.visible * misWeight), path.scatterings);

    LightMatrix scattered = multiply(w, opaqueOf(materialIndex));
    float weight = lightWeight(lightScale(scattered, bsdfAlbedo(material.bsdf, -path.direction)), params.rowWeight);
    bool scatters = path.scatterings < params.bounces && materialScatters(material, front) && weight > 0.0;
    if (scatters) {
        Vertex here;
        here.importance = scattered;
        here.bsdf = material.bsdf;
        bool behindOthers = kPlanes && path.crossings > 0u && path.t == ray.t;
        here.point = surfacePoint(tri, ray.triangle, ray.barycentric, normal, path.direction, kSmoothNormals);
        here.point = placedByPlane(here.point, path.origin + path.direction * ray.t, behindOthers);
        here.weight = weight;
        here.weightSum = vertex.weightSum + weight;
        if (kDirectLight == kDirectLightClosedForm) gatherClosedForm(gathered, here, path.scatterings + 1u);
        if (kDirectLight == kDirectLightSampled) {
            uvec2 u = sampleWords(kSampler, pixel, sampleIndex,
                                  sampleDimension(path.scatterings, path.crossings, kDimensionLight), params.seed);
            connectToLight(shadow, gathered, here, -path.direction, u, path.scatterings + 1u);
        }
        bool chosen = true;
        if (kTransmittance != kTransmittanceZero && kPathsGoOn) {
            uint choice = sampleDimension(path.scatterings, path.crossings, kDimensionChoice);
            chosen = sampleChoice(pixel, sampleIndex, choice, params.seed).x * here.weightSum < weight;
        }
        if (chosen) {
            vertex = here;
        } else {
            vertex.weightSum = here.weightSum;
        }
    }

    bool passes = false;
    if (kTransmittance != kTransmittanceZero && canCross(w)) {
        LightMatrix through = multiply(w, transparentOf(materialIndex));
        passes = maxComponent(through.m00 + through.m01 + through.m10 + through.m11) > 0.0;
        path.importance = through;
        path.t = ray.t;
        path.order = ray.order;
        path.crossings += 1u;
    }
    if (!passes) endSegment(path, vertex, pixel, sampleIndex);
}

uint pixelOfSlot(uint slot) {
    uint imageSlot = dispatch.firstSlot + slot;
    return imageLoad(pixelTexels, int(imageSlot >> 2u))[imageSlot & 3u];
}

vec2 filmSample(uint pixel, uint sampleIndex) {
    return samplePair(kSampler, pixel, sampleIndex, kDimensionPixel, params.seed);
}

void main() {
    uint team = gl_GlobalInvocationID.x / kTeamSize;
    uint teamBegin = team * dispatch.teamSlots;
    if (teamBegin >= dispatch.slotCount) return;
    uint teamSlots = min(dispatch.teamSlots, dispatch.slotCount - teamBegin);
    uint progress = dispatch.firstTeam + team;

    uint taken = atomicAdd(teams[progress].taken, 1u);
    uint pixel = pixelOfSlot(teamBegin + min(taken, teamSlots - 1u));
    uint sampleIndex = dispatch.firstSample;
    uint endSample = dispatch.firstSample + dispatch.sampleCount;
    SlotSums sums = emptySums();
    emptyLayers();
    Gathered gathered = nothingGathered();
    Vertex vertex;
    vertex.weightSum = 0.0;
    Shadow shadow;
    shadow.pending = false;
    Path path = cameraPath(pixel, filmSample(pixel, sampleIndex));
    Traversal ray = traversalStart(0u, path.origin, path.direction, 0.0, kNoTriangle, kInfinity, false);

    while (taken < teamSlots) {
        // Until some lane has all samples of its slot.
        do {
            traverse(ray, kOrdered, kLeaveTraversal, kLeaveNodes);
            if (!traversalAlive(ray)) {
                bool found = ray.triangle != kNoTriangle;
                Triangle tri = fetchTriangle(found ? ray.triangle : 0u);
                if (shadow.pending) {
                    meetShadow(shadow, gathered, ray, found, tri.materialFlags & kMaterialMask);
                } else if (found) {
                    meetSurface(path, vertex, shadow, gathered, ray, tri, pixel, sampleIndex);
                } else {
                    endSegment(path, vertex, pixel, sampleIndex);
                }

                bool emissionOnly = onlyEmissionLeft(path) && path.scatterings + path.crossings > 0u;
                if (kTransmittance == kTransmittanceIdentity) {
                    // Most rays that only look for emitters, and that nothing stops, pass far from all of them.
                    while (emissionOnly && !path.ended &&
                           !intersectBox(path.origin, path.direction, path.t, params.emitterLower, params.emitterUpper)) {
                        endSegment(path, vertex, pixel, sampleIndex);
                        emissionOnly = onlyEmissionLeft(path);
                    }
                }
                bool emissionCounts =
                    kHasEmitters && (kDirectLight != kDirectLightClosedForm || path.scatterings == 0u);
                if (emissionOnly && !emissionCounts) path.ended = true;
                // Emitters along a ray that nothing else can stop are found in their own small tree.
                bool inEmitterTree = kTransmittance == kTransmittanceIdentity && emissionOnly;
                if (path.ended && !shadow.pending) {
                    addSample(sums, gathered, dispatch.inverseQuantum,
                              filmRounding(pixel, sampleIndex, kDimensionPixel, params.seed));
                    addLayers();
                    gathered = nothingGathered();
                    sampleIndex += 1u;
                    path = cameraPath(pixel, filmSample(pixel, sampleIndex));
                    inEmitterTree = false;
                }
                bool onPath = !shadow.pending;
                bool fromCamera = path.scatterings + path.crossings == 0u;
                sums.shadowRays += shadow.pending ? 1u : 0u;
                sums.cameraRays += onPath && fromCamera ? 1u : 0u;
                sums.bounceRays += onPath && !fromCamera && !inEmitterTree ? 1u : 0u;
                sums.emitterRays += onPath && inEmitterTree ? 1u : 0u;
                ray = traversalStart(inEmitterTree && onPath ? params.emitterRoot : 0u,
                                     shadow.pending ? shadow.origin : path.origin,
                                     shadow.pending ? shadow.direction : path.direction,
                                     shadow.pending ? shadow.t : path.t,
                                     shadow.pending ? shadow.order : path.order,
                                     shadow.pending ? shadow.distance : kInfinity,
                                     shadow.pending && kTransmittance == kTransmittanceZero);
                if (kPlanes && shadow.pending) ray.order = shadow.beforeOrder;
            }
        } while (subgroupBallot(sampleIndex == endSample) == uvec4(0u));

        if (sampleIndex == endSample) {
            results[dispatch.firstResult + teamBegin + taken] = slotResult(sums);
            storeLayers(dispatch.firstResult + teamBegin + taken);
            atomicAdd(teams[progress].finished, 1u);
            taken = atomicAdd(teams[progress].taken, 1u);
            pixel = pixelOfSlot(teamBegin + min(taken, teamSlots - 1u));
            sampleIndex = dispatch.firstSample;
            sums = emptySums();
            emptyLayers();
            path = cameraPath(pixel, filmSample(pixel, sampleIndex));
            ray = traversalStart(0u, path.origin, path.direction, 0.0, kNoTriangle, kInfinity, false);
            ray.nodesLeft = taken < teamSlots;
        }
    }
}
