// Shooting: paths from the emitters, particles that carry a column L of flux per colour channel. At a surface O
// f_opaque L is connected to the camera and may go on in a new direction, T L goes straight on: the adjoint of
// path.comp, with the matrices multiplied from the left, in the order met.
//
// Scheduling is path.comp's: a team of lanes takes the paths of a range one after the other, and rays along the path
// and rays to the camera share one traversal. All surfaces along a ray are met in order: at each, the particle is
// connected to the camera, and one of them is chosen, in proportion to the flux that it would scatter, to go on from.
//
// What arrives at the camera is added to the film with atomics, in integers: in any order the sums are the same.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#ifdef DUOLUX_INT64_ATOMICS
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require
#endif

#include "shaders/kernels/scene.glsl"
#include "shaders/lib/film.glsl"
#include "shaders/lib/light_path.glsl"
#include "shaders/shared/light_layout.h"

layout(constant_id = kSpecCameraTransmittance) const uint kCameraTransmittance = kTransmittanceGeneral;
layout(constant_id = kSpecFilmBands) const uint kFilmBands = 1u;
layout(constant_id = kSpecBandPixels) const uint kBandPixels = 1u;

layout(binding = kBindingResults, scalar) writeonly buffer ResultsBlock { LaneResult results[]; };
#ifdef DUOLUX_INT64_ATOMICS
layout(binding = kBindingFilm, scalar) buffer FilmBlock { uint64_t sums[]; } film[kFilmBands];
#else
layout(binding = kBindingFilm, scalar) buffer FilmBlock { uvec2 sums[]; } film[kFilmBands];
#endif
layout(push_constant, scalar) uniform DispatchBlock { LightDispatch dispatch; };

// Component that surfaces may scatter or pass on, the largest channel: without second columns the visible one is lost
// on all but the camera.
float carried(Light l) { return maxComponent(l.invisible + (kSecondColumn ? l.visible : vec3(0.0))); }

// How much light counts in a pixel.
float rowWeighted(Light l) { return maxComponent(params.rowWeight.x * l.invisible + params.rowWeight.y * l.visible); }

// Russian roulette on connections, where only a part of their worth is left.
float connectionSurvival(float left, float whole) { return min(left / whole, 1.0); }

float channelMean(vec3 v) { return (v.x + v.y + v.z) * (1.0 / 3.0); }

// Adds to one sum of the film; whether that was beyond the range of 63 bits before.
bool filmAtomicAdd(uint band, uint index, uvec2 quanta) {
#ifdef DUOLUX_INT64_ATOMICS
    return unpackUint2x32(atomicAdd(film[band].sums[index], packUint2x32(quanta))).y >= 0x80000000u;
#else
    uint before = atomicAdd(film[band].sums[index].x, quanta.x);
    return atomicAdd(film[band].sums[index].y, quanta.y + (before + quanta.x < before ? 1u : 0u)) >= 0x80000000u;
#endif
}

void splat(inout LaneSums sums, Light light, Connection connection, uvec2 path) {
    uint pixel = connection.pixel;
    vec3 total = light.invisible + light.visible;
    float sum = total.x + total.y + total.z;
    // Not the other way round: NaN is to be dropped.
    bool fine = sum < kLargestRadiance;
    sums.nonFinite += fine ? 0u : 1u;
    if (!fine) return;
    sums.clamped += sum * dispatch.inverseQuantum >= kFilmLargest ? 1u : 0u;
    uint index = (kFilmBands > 1u ? pixel % kBandPixels : pixel) * kFilmSums;
    uvec2[kFilmSums] quanta;
    FilmRounding u = filmRounding(path.y, path.x, connection.dimension, params.seed);
    for (int c = 0; c < 3; c++) {
        quanta[c] = filmQuantise(light.invisible[c], dispatch.inverseQuantum, u.invisible[c]);
        quanta[c + 3] = filmQuantise(light.visible[c], dispatch.inverseQuantum, u.visible[c]);
    }
    for (uint band = 0u; band < kFilmBands; band++) {
        if (kFilmBands == 1u || pixel / kBandPixels == band) {
            uint beyond = 0u;
            for (uint i = 0u; i < kFilmSums; i++) beyond |= filmAtomicAdd(band, index + i, quanta[i]) ? 1u << i : 0u;
            // A sum beyond the range stays there, but must not get as far as 2^64, where it would begin again: what
            // finds it there takes away what it has added. So a sum ends up beyond the range if and only if the exact
            // one does, in whatever order; the host knows it by its sign.
            while (beyond != 0u) {
                uint i = uint(findLSB(beyond));
                beyond &= beyond - 1u;
                filmAtomicAdd(band, index + i, filmNegate(quanta[i]));
            }
        }
    }

    vec3 displayed = params.display.x * light.invisible + params.display.y * light.visible;
    float mean = channelMean(displayed);
    float inverseUnit = dispatch.inverseQuantum * (1.0 / kStatisticsQuanta);
    uint scatterings = connection.scatterings;
    if (scatterings == params.bounces) sums.lastBounce = filmAddSigned(sums.lastBounce, mean, inverseUnit);
    if (scatterings + 1u == params.bounces) sums.previousBounce = filmAddSigned(sums.previousBounce, mean, inverseUnit);
    sums.invisible = filmAddSigned(sums.invisible, channelMean(light.invisible), inverseUnit);
    sums.visible = filmAddSigned(sums.visible, channelMean(light.visible), inverseUnit);
}

vec3 directionToCamera(vec3 point) { return connectToCamera(params.camera, point).direction; }

// Sets up a ray to the camera.
void connect(inout Connection connection, LightPath path, Outgoing outgoing) {
    CameraConnection camera = connectToCamera(params.camera, outgoing.point.position);
    float cosine = max(dot(outgoing.point.geometricNormal, camera.direction), 0.0);
    Light arriving = lightScale(outgoing.radiance, vec3(cosine * camera.importance));
    // Light that counts less than its brightness, by components that are not displayed, is connected less often.
    float brightness = maxComponent(max(arriving.invisible, arriving.visible));
    float worth = max(params.rowWeight.x, params.rowWeight.y) * brightness;
    float survival = connectionSurvival(rowWeighted(arriving), worth);
    // So is what a surface sends in a flat direction, which is dim by the cosine: a sixth of the rays for 6 to 8 % of
    // variance.
    survival *= outgoing.scatterings > 0u ? min(3.0 * cosine, 1.0) : 1.0;
    uint dimension = sampleDimension(outgoing.scatterings, path.crossings, kDimensionCamera);
    float roulette = sampleChoice(path.id.y, path.id.x, dimension, params.seed).x;
    // Not the other way round: what is not a number is traced, and counted when it arrives.
    connection.pending = camera.visible && !(brightness <= 0.0) && !(roulette >= survival);
    RayBegin begin = leaveSurface(outgoing.point, camera.direction);
    connection.origin = begin.origin;
    connection.direction = camera.direction;
    connection.distance = camera.distance;
    connection.t = begin.t;
    connection.order = begin.order;
    connection.light = arriving;
    connection.roulette = roulette;
    connection.survival = survival;
    connection.pixel = camera.pixel;
    connection.scatterings = outgoing.scatterings;
    connection.dimension = dimension;
}

// The particle of this number is at its emitter, as at a vertex that it is about to leave.
void emitPath(out LightPath path, out Vertex vertex, out Outgoing outgoing, uvec2 id) {
    uint dimension = sampleDimension(0u, 0u, kDimensionLight);
    LightSample light = sampleLight(params.lightCount, sampleWords(kSampler, id.y, id.x, dimension, params.seed));
    Material material = fetchMaterial(light.material);
    bool bothSides = (material.flags & kMaterialEmitsBack) != 0u;
    bool front = !bothSides || sampleChoice(id.y, id.x, dimension, params.seed).y < 0.5;
    vec3 normal = front ? light.normal : -light.normal;
    Light flux = lightScale(material.emission, vec3(emittedFlux(material.lightPdfArea, bothSides ? 2.0 : 1.0)));
    SurfacePoint point = pointOnLight(light, normal);
    // Its directions are those of a white diffuse surface.
    vertex = Vertex(flux, Bsdf(vec3(1.0)), point, normal, 1.0, 0.0);
    path.id = id;
    path.emitted = carried(flux);
    path.scatterings = 0u;
    path.crossings = 0u;
    path.ended = !(path.emitted > 0.0) || params.bounces == 0u;

    // Whatever side the particle leaves from, the camera sees the one that faces it.
    bool seenFront = dot(light.normal, directionToCamera(light.position)) > 0.0;
    outgoing.point = pointOnLight(light, seenFront ? light.normal : -light.normal);
    outgoing.radiance = lightScale(materialEmission(material, seenFront), vec3(1.0 / material.lightPdfArea));
    outgoing.scatterings = 0u;
}

// Whether the particle goes on from the chosen vertex of the segment; if it does, the vertex' flux carries the weights.
bool endSegment(LightPath path, inout Vertex vertex) {
    float weightSum = vertex.weightSum;
    vertex.weightSum = 0.0;
    if (!kInvisibleScatters && !kSecondColumn) return false;
    if (!(weightSum > 0.0) || path.scatterings + 1u >= params.bounces) return false;
    // Russian roulette on the flux that all vertices of the segment would scatter, in units of what was emitted.
    float survival = path.scatterings >= 2u ? survivalProbability(weightSum / path.emitted) : 1.0;
    uint choice = sampleDimension(path.scatterings, path.crossings, kDimensionChoice);
    vertex.flux = lightScale(vertex.flux, vec3(weightSum / (vertex.weight * survival)));
    return sampleChoice(path.id.y, path.id.x, choice, params.seed).y < survival;
}

// The particle leaves a vertex for a new segment.
void beginSegment(inout LightPath path, Vertex vertex, uint purpose) {
    uint dimension = sampleDimension(path.scatterings, 0u, purpose);
    vec2 u = samplePair(kSampler, path.id.y, path.id.x, dimension, params.seed);
    // Diffuse light is sampled about the geometric normal, whose cosine the adjoint has on this side: so all directions
    // that the surface scatters to are met. wi has the place of wo: a BSDF is reciprocal.
    vec3 normal = vertex.point.geometricNormal;
    BsdfSample s = bsdfSample(vertex.bsdf, toFrame(normal, vertex.wi), u);
    path.flux = lightScale(vertex.flux, s.weight);
    path.direction = fromFrame(normal, s.wi);
    RayBegin begin = leaveSurface(vertex.point, path.direction);
    path.origin = begin.origin;
    path.t = begin.t;
    path.order = begin.order;
    path.scatterings += purpose == kDimensionDirection ? 1u : 0u;
    path.crossings = 0u;
    path.ended = !(s.pdf > 0.0);
}

// The ray to the camera has met a surface, or nothing more.
void meetConnection(inout Connection connection, inout LaneSums sums, uvec2 path, Traversal ray, bool found,
                    uint material) {
    if (kCameraTransmittance == kTransmittanceGeneral && found) {
        float before = rowWeighted(connection.light);
        Light through = lightApply(transparentOf(material), connection.light);
        // Roulette where what is displayed is lost, by the same number all along the ray.
        connection.survival *= connectionSurvival(rowWeighted(through), before);
        connection.light = through;
        connection.t = ray.t;
        connection.order = ray.order;
        connection.pending = connection.roulette < connection.survival;
        return;
    }
    Light light = connection.light;
    // Surfaces that pass on the invisible component as it is, and nothing of the visible one.
    if (found) light = Light(kCameraTransmittance == kTransmittanceIdentity ? light.invisible : vec3(0.0), vec3(0.0));
    light = lightScale(light, vec3(1.0 / connection.survival));
    if (maxComponent(light.invisible + light.visible) != 0.0) {
        splat(sums, light, connection, path);
    }
    connection.pending = false;
}

// The particle has met a surface: light for the camera, a candidate for scattering, and the crossing. Whether the
// segment goes on.
bool meetSurface(inout LightPath path, inout Vertex vertex, out Outgoing outgoing, Traversal ray, Triangle tri) {
    uint materialIndex = tri.materialFlags & kMaterialMask;
    Material material = fetchMaterial(materialIndex);
    vec3 normal = normalize(cross(tri.v1 - tri.v0, tri.v2 - tri.v0));
    bool front = dot(normal, path.direction) < 0.0;

    bool behindOthers = kPlanes && path.crossings > 0u && path.t == ray.t;
    SurfacePoint point = surfacePoint(tri, ray.triangle, ray.barycentric, normal, path.direction, kSmoothNormals);
    point = placedByPlane(point, path.origin + path.direction * ray.t, behindOthers);
    vec3 wi = -path.direction;
    float adjoint = materialScatters(material, front) ? shadingAdjoint(point, wi) : 0.0;
    Light scattered = lightScale(lightApply(opaqueOf(materialIndex), path.flux), vec3(adjoint));
    vec3 wo = directionToCamera(point.position);
    vec3 f = bsdfEvaluate(material.bsdf, toFrame(point.shadingNormal, wo), toFrame(point.shadingNormal, wi));
    outgoing = Outgoing(point, lightScale(scattered, f), path.scatterings + 1u);

    float weight = carried(lightScale(scattered, bsdfAlbedo(material.bsdf, wi)));
    if (weight > 0.0) {
        float weightSum = vertex.weightSum + weight;
        bool chosen = true;
        if (kTransmittance != kTransmittanceZero) {
            uint choice = sampleDimension(path.scatterings, path.crossings, kDimensionChoice);
            chosen = sampleChoice(path.id.y, path.id.x, choice, params.seed).x * weightSum < weight;
        }
        if (chosen) vertex = Vertex(scattered, material.bsdf, point, wi, weight, weightSum);
        vertex.weightSum = weightSum;
    }

    if (kTransmittance == kTransmittanceZero) return false;
    path.flux = lightApply(transparentOf(materialIndex), path.flux);
    path.t = ray.t;
    path.order = ray.order;
    path.crossings += 1u;
    return carried(path.flux) > 0.0;
}

uvec2 pathNumber(uint index) {
    uint low = dispatch.firstLow + index;
    return uvec2(low, dispatch.firstHigh + (low < index ? 1u : 0u));
}

// To the camera first, then along the path. Nothing is to be met where both have ended.
Traversal nextRay(LightPath path, Connection connection, inout LaneSums sums) {
    bool toCamera = connection.pending;
    bool onPath = !toCamera && !path.ended;
    bool emitted = path.scatterings + path.crossings == 0u;
    sums.shadowRays += toCamera ? 1u : 0u;
    sums.lightRays += onPath && emitted ? 1u : 0u;
    sums.bounceRays += onPath && !emitted ? 1u : 0u;
    Traversal ray = traversalStart(0u, toCamera ? connection.origin : path.origin,
                                   toCamera ? connection.direction : path.direction,
                                   toCamera ? connection.t : path.t, toCamera ? connection.order : path.order,
                                   toCamera ? connection.distance : kInfinity,
                                   toCamera && kCameraTransmittance != kTransmittanceGeneral);
    ray.nodesLeft = toCamera || onPath;
    return ray;
}

void main() {
    uint team = gl_GlobalInvocationID.x / kTeamSize;
    uint teamBegin = team * dispatch.teamPaths;
    if (teamBegin >= dispatch.count) return;
    uint teamPaths = min(dispatch.teamPaths, dispatch.count - teamBegin);
    uint progress = dispatch.firstTeam + team;

    LaneSums sums = emptySums();
    Vertex vertex;
    vertex.weightSum = 0.0;
    Connection connection;
    connection.pending = false;
    LightPath path;
    path.ended = true;
    bool hasPath = false;
    bool working = true;
    Traversal ray = nextRay(path, connection, sums);

    while (working) {
        traverse(ray, kOrdered, kLeaveTraversal, kLeaveNodes);
        if (!traversalAlive(ray)) {
            bool found = ray.triangle != kNoTriangle;
            Triangle tri = fetchTriangle(found ? ray.triangle : 0u);
            Outgoing outgoing;
            bool connects = false;
            bool leaves = false;
            uint purpose = kDimensionDirection;
            if (connection.pending) {
                meetConnection(connection, sums, path.id, ray, found, tri.materialFlags & kMaterialMask);
            } else if (!path.ended) {
                connects = found;
                bool passes = found && meetSurface(path, vertex, outgoing, ray, tri);
                leaves = !passes && endSegment(path, vertex);
                path.ended = !passes && !leaves;
            }
            // A loop, because only these skip what no lane needs.
            while (working && path.ended && !connection.pending && !connects) {
                if (hasPath) atomicAdd(teams[progress].finished, 1u);
                uint taken = atomicAdd(teams[progress].taken, 1u);
                working = taken < teamPaths;
                hasPath = working;
                emitPath(path, vertex, outgoing, pathNumber(teamBegin + min(taken, teamPaths - 1u)));
                connects = true;
                leaves = !path.ended;
                purpose = kDimensionEmission;
            }
            if (connects) connect(connection, path, outgoing);
            if (leaves) beginSegment(path, vertex, purpose);
            connection.pending = connection.pending && working;
            path.ended = path.ended || !working;
            ray = nextRay(path, connection, sums);
        }
    }
    results[dispatch.firstResult + gl_GlobalInvocationID.x] = laneResult(sums);
}
