// Parameters and records of the path tracer's kernel, in part also used by the light tracer's,
// shared by C++ and GLSL (scalar block layout).
#ifndef DUOLUX_SHADERS_SHARED_PATH_TRACER_LAYOUT_H
#define DUOLUX_SHADERS_SHARED_PATH_TRACER_LAYOUT_H

#include "shaders/shared/camera_layout.h"
#include "shaders/shared/emitter_layout.h"
#include "shaders/shared/kernel_interface.h"
#include "shaders/shared/material_layout.h"
#include "shaders/shared/types.h"

DUOLUX_BEGIN

// The largest value of one sample of a pixel, and of the mean of a pixel, in quanta of the film: 2^58.
DUOLUX_CONST float kFilmLargest = 288230376151711744.0f;

DUOLUX_CONST uint kSamplerSobol = 0u;  // Owen-scrambled Sobol points
DUOLUX_CONST uint kSamplerIndependent = 1u;

// How direct light at a vertex is computed.
DUOLUX_CONST uint kDirectLightNone = 0u;     // there is no emitter
DUOLUX_CONST uint kDirectLightSampled = 1u;  // by next-event estimation and multiple importance sampling
// By Lambert's formula for each emitter; only where nothing can block an emitter.
DUOLUX_CONST uint kDirectLightClosedForm = 2u;

// The transmittance of a segment between two points, for the whole scene.
DUOLUX_CONST uint kTransparencyZero = 0u;  // every T is 0: any surface hides what is behind it
// Every T passes importance that has scattered unchanged, and importance in the first column at the camera.
DUOLUX_CONST uint kTransparencyIdentity = 1u;
DUOLUX_CONST uint kTransparencyGeneral = 2u;  // a product of 2x2 matrices, in order
// Every T is 0, but surfaces may be there only in part, and light passes unchanged through the rest: a number.
DUOLUX_CONST uint kTransparencyCoverage = 3u;

// A ReflectanceMatrix: entry ij maps component j to component i, per channel; 0 = invisible, 1 = visible.
struct DeviceReflectanceMatrix {
    vec3 m00;
    vec3 m01;
    vec3 m10;
    vec3 m11;
};

struct PathParams {
    DeviceCamera camera;
    uint seed;
    uint bounces;  // largest number of scattering events on a path
    DeviceReflectanceMatrix opaque;
    DeviceReflectanceMatrix transparent;
    vec2 rowWeight;     // weights of the components (invisible, visible) of a pixel in the distribution of
                        // work; their sum is 1
    vec2 display;       // the row d of eq. 8
    uint emitterCount;  // emitters that next-event estimation and the light tracer choose from
    uint emittingTriangles;  // triangles with a rank below this emit
    uint emitterRoot;   // index of the root node of the tree over emitters or, with the driver's tree, of the
                        // first emitting triangle; 0: there is none
    vec3 emitterLower;  // bounds of the emitting triangles, slightly enlarged
    vec3 emitterUpper;
};

struct PathTracerDispatch {
    uint firstPixel;
    uint pixelCount;
    uint firstSample;
    uint sampleCount;
    uint teamPixels;   // pixels that each team of lanes processes, one after the other
    uint firstResult;  // index of the first pixel's result
    uint firstTeam;    // index of the first team's progress
    float inverseQuantum;
};

// Pixels or light paths that the lanes of a team have started and finished. If the driver has ended the
// kernel's loops early, fewer are finished than requested.
struct TeamProgress {
    uint taken;
    uint finished;
};

// Sums over the samples of one pixel in one dispatch. 64-bit two's complement numbers as (low, high).
struct PixelResult {
    uint invisible[6];
    uint visible[6];
    uint nonFinite;  // samples dropped because they were not finite
    uint clamped;    // samples brighter than the film can hold
    uint cameraRays;
    uint bounceRays;
    uint shadowRays;
    uint emitterRays;
    float lastBounce;      // displayed radiance (mean of channels) with PathParams.bounces scattering events
    float previousBounce;  // the same with one event fewer
};

// Records fetched as texels of 4 x uint32.
DUOLUX_CONST uint kNormalTexels = 1u;  // three octahedral 2 x snorm16 unit vectors, one per vertex
// Three colours, one per vertex: square roots of linear RGB, 10 bits each; and three alphas of 10 bits.
DUOLUX_CONST uint kColourTexels = 1u;

#ifdef __cplusplus
static_assert(sizeof(DeviceReflectanceMatrix) == 48 && sizeof(PixelResult) == 80);
static_assert(offsetof(PathParams, opaque) == 84 && offsetof(PathParams, rowWeight) == 180);
static_assert(offsetof(PathParams, emitterRoot) == 204 && sizeof(PathParams) == 232);

struct DeviceNormals {
    uint octahedral[3];
    uint unused;
};
static_assert(sizeof(DeviceNormals) == kNormalTexels * 16);

struct DeviceColours {
    uint roots[3];
    uint alphas;
};
static_assert(sizeof(DeviceColours) == kColourTexels * 16);
#endif

DUOLUX_END
#endif
