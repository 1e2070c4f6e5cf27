// The light tracer: paths from the emitters carry a column L of flux per colour channel. At a surface O f_opaque L is
// connected to the camera and may continue in a new direction, T L continues straight on: the adjoint of the path
// tracer, with the matrices multiplied from the left, in the order met.
//
// A team of lanes takes the paths of a range one after the other. Rays along the path and rays to the camera share one
// traversal. All surfaces along a ray are met in order: at each, the path is connected to the camera, and one of them
// is chosen, in proportion to the flux that it would scatter, to continue from.
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
#include "shaders/shared/light_tracer_layout.h"

layout(constant_id = kSpecCameraTransparency) const uint kCameraTransparency = kTransparencyGeneral;
// Whether rays to the camera visit the surfaces along them one by one.
const bool kVisitsToCamera =
    kCameraTransparency == kTransparencyGeneral || kCameraTransparency == kTransparencyCoverage;
layout(constant_id = kSpecFilmBands) const uint kFilmBands = 1u;
layout(constant_id = kSpecBandPixels) const uint kBandPixels = 1u;

layout(binding = kBindingResults, scalar) writeonly buffer ResultsBlock { LaneResult results[]; };
#ifdef DUOLUX_INT64_ATOMICS
layout(binding = kBindingFilm, scalar) buffer FilmBlock { uint64_t sums[]; } film[kFilmBands];
#else
layout(binding = kBindingFilm, scalar) buffer FilmBlock { uvec2 sums[]; } film[kFilmBands];
#endif
layout(push_constant, scalar) uniform DispatchBlock { LightTracerDispatch dispatch; };

#include "shaders/kernels/segment.glsl"
#include "shaders/kernels/camera_connection.glsl"
#include "shaders/kernels/team.glsl"

// Where a light path starts.
struct Start {
    Emitter emitter;
    EmitterPoint on;
    float side;  // a uniform number
};

// The start of the light path of this number. `outgoing`: what the camera may see of it, whichever side the path leaves
// from.
Start startPath(uvec2 stream, out Outgoing outgoing) {
    EmitterChoice choice =
        chooseEmitter(params.emitterCount, drawWords(stream, sampleDimension(0u, 0u, kDimensionEmitter)));
    Start start;
    start.emitter = fetchEmitter(choice.index);
    start.on = pointOnEmitter(start.emitter, choice.u);
    start.side = drawChoice(stream, sampleDimension(0u, 0u, kDimensionSide));
    EmitterSeen seen = seeEmitter(start.emitter, start.on, directionToCamera(start.on.position));
    outgoing = Outgoing(seen.point, seen.intensity, 0u);
    return start;
}

// The light path leaves its emitter.
LightPath emitPath(uvec2 stream, Start start, vec2 u) {
    EmittedRay ray = emitRay(start.emitter, start.on, start.side, u);
    LightPath path;
    path.stream = stream;
    path.flux = ray.flux;
    path.emitted = carried(ray.flux);
    path.segment = leaveSurface(ray.point, ray.direction, false);
    path.scatterings = 0u;
    path.crossings = 0u;
    path.ended = !(path.emitted > 0.0) || params.bounces == 0u;
    return path;
}

// Whether the path continues from the chosen vertex of the segment; if it does, its flux there carries the weights.
bool endSegment(inout LightPath path, inout Vertex vertex) {
    float weightSum = vertex.weightSum;
    vertex.weightSum = 0.0;
    if (!kInvisibleScatters && !kSecondColumn) return false;
    if (!(weightSum > 0.0) || path.scatterings + 1u >= params.bounces) return false;
    float survival;
    bool continues = survives(path.stream, path.scatterings, path.crossings, weightSum / path.emitted, survival);
    path.scattered = scaled(path.scattered, vec3(weightSum / (vertex.weight * survival)));
    return continues;
}

// The light path leaves a vertex for a new segment.
void beginSegment(inout LightPath path, Vertex vertex, vec2 u) {
    BsdfSample s = scatter(vertex, -path.segment.direction, u, path.stream, path.scatterings, kModeImportance);
    path.flux = scaled(path.scattered, s.weight);
    path.segment = leaveVertex(vertex.point, vertex.bsdf, s.wi);
    path.scatterings += 1u;
    path.crossings = 0u;
    path.ended = !(s.pdf > 0.0);
}

// The light path has met a surface: light for the camera, a candidate for scattering, and the crossing. Returns whether
// the segment continues.
bool meetSurface(inout LightPath path, inout Vertex vertex, out Outgoing outgoing, Traversal ray, Triangle tri) {
    vec3 viewer = directionToCamera(path.segment.origin + path.segment.direction * ray.t);
    SurfaceHit hit = meetTriangle(path.segment, ray, tri, viewer, kTextureGroups);
    vec3 toEmitter = -path.segment.direction;
    float adjoint = materialScatters(hit.material, hit.front) ? shadingAdjoint(hit.point, toEmitter) : 0.0;
    Radiance2 scattered = scaled(matrixApply(opaqueOf(hit.materialIndex), path.flux),
                                 hit.unabsorbed * (hit.coverage * adjoint));
    BsdfFrame frame = frameOf(hit.point, hit.bsdf);
    CameraConnection camera = connectToCamera(params.camera, hit.point.position);
    vec3 f = bsdfEvaluate(hit.bsdf, frame, toEmitter, camera.direction, kModeImportance);
    if (kAttenuates && isInside(hit.bsdf, dot(frame.geometric, camera.direction) < 0.0)) {
        f *= exp(-hit.bsdf.attenuation * camera.distance);
    }
    outgoing = Outgoing(hit.point, scaled(scattered, f), path.scatterings + 1u);

    float weight = carried(scaled(scattered, bsdfAlbedo(hit.bsdf, frame, toEmitter)));
    if (weight > 0.0) {
        float u = crossingChoice(path.stream, path.scatterings, path.crossings);
        if (offerVertex(vertex, hit.bsdf, hit.point, weight, u)) path.scattered = scattered;
    }

    if (kTransparency == kTransparencyZero) return false;
    path.flux = crossed(path.flux, hit.materialIndex, hit.coverage, kTransparency);
    crossSurface(path.segment, ray);
    path.crossings += 1u;
    return carried(path.flux) > 0.0;
}

uvec2 pathStream(uint index) {
    uint low = dispatch.firstLow + index;
    return uvec2(dispatch.firstHigh + (low < index ? 1u : 0u), low);
}

// The next ray: to the camera first, then along the path. It meets nothing if both have ended.
Traversal nextRay(LightPath path, Connection connection, inout LaneSums sums) {
    bool toCamera = connection.pending;
    bool onPath = !toCamera && !path.ended;
    bool emitted = path.scatterings + path.crossings == 0u;
    sums.shadowRays += toCamera ? 1u : 0u;
    sums.lightRays += onPath && emitted ? 1u : 0u;
    sums.bounceRays += onPath && !emitted ? 1u : 0u;
    Segment segment = path.segment;
    if (toCamera) segment = connection.segment;
    Traversal ray = traversalStart(0u, segment.origin, segment.direction, segment.t, segment.order,
                                   toCamera ? connection.distance : kInfinity,
                                   toCamera && !kVisitsToCamera);
    ray.nodesLeft = toCamera || onPath;
    return ray;
}

void main() {
    Team team = teamOfLane(dispatch.teamPaths, dispatch.count, dispatch.firstTeam);
    if (team.items == 0u) return;
    LaneSums sums = emptyLaneSums();
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
            bool connects = false, leaves = false, starts = false;
            Start start;
            if (connection.pending) {
                continueConnection(connection, sums, path.stream, ray, found, tri.materialFlags & kMaterialMask);
            } else if (!path.ended) {
                connects = found;
                bool passes = found && meetSurface(path, vertex, outgoing, ray, tri);
                leaves = !passes && endSegment(path, vertex);
                path.ended = !passes && !leaves;
            }
            // A loop, because only loops skip what no lane needs.
            while (working && path.ended && !connection.pending && !connects) {
                if (hasPath) finishItem(team);
                uint taken = takeItem(team);
                working = taken < team.items;
                hasPath = working;
                path.stream = pathStream(itemOf(team, taken));
                path.crossings = 0u;  // for connect(); emitPath() sets the rest
                start = startPath(path.stream, outgoing);
                vertex.weightSum = 0.0;
                connects = true;
                starts = true;
            }
            if (connects) connect(connection, path, outgoing);
            // Starting and scattering lanes share one draw, because Sobol points are expensive.
            uint dimension = starts ? sampleDimension(0u, 0u, kDimensionEmission)
                                    : sampleDimension(path.scatterings, 0u, kDimensionDirection);
            vec2 u = drawPair(path.stream, dimension);
            if (leaves) beginSegment(path, vertex, u);
            if (starts) path = emitPath(path.stream, start, u);
            connection.pending = connection.pending && working;
            path.ended = path.ended || !working;
            ray = nextRay(path, connection, sums);
        }
    }
    results[dispatch.firstResult + gl_GlobalInvocationID.x] = laneResult(sums);
}
