// The record of an emitter, shared by C++ and GLSL. The emitting triangles of a scene come first, in the
// order of their ranks (DevicePair::primitive), so that the rank of an emitting triangle is the index of its
// record. Point emitters follow.
#ifndef DUOLUX_SHADERS_SHARED_EMITTER_LAYOUT_H
#define DUOLUX_SHADERS_SHARED_EMITTER_LAYOUT_H

#include "shaders/shared/kernel_interface.h"

DUOLUX_BEGIN

DUOLUX_CONST uint kEmitterTexels = 6u;      // of 4 x uint32
DUOLUX_CONST uint kEmitterAliasTexel = 5u;  // the texel that holds the entry of the alias table

// Kinds of emitters. The record of an emitter has its kind in DeviceEmitter.flags.
DUOLUX_CONST uint kEmitterKindTriangle = 8u;
DUOLUX_CONST uint kEmitterKindPoint = 16u;
DUOLUX_CONST uint kEmitterKindsWithClosedForm = 24u;  // whose direct light irradianceFromEmitters computes
DUOLUX_CONST uint kAllEmitterKinds = kEmitterKindTriangle | kEmitterKindPoint;

// The other flags.
DUOLUX_CONST uint kEmitterFront = 1u;       // emits on the front side
DUOLUX_CONST uint kEmitterBack = 2u;        // emits on the back side
DUOLUX_CONST uint kEmitterCoincident = 4u;  // other surfaces coincide with the triangle, kSpecPlanes only

#ifdef __cplusplus
struct DeviceEmitter {
    vec3 v0;  // v0, v1, v2: corners; v0: position of a point emitter
    uint unused;
    vec3 v1;
    float positionError;  // bound on the rounding error of a point on the triangle, as for hits
    vec3 v2;
    uint triangle;   // index of the triangle in device memory; only with kSpecPlanes, or where emission
                     // varies over a triangle
    vec3 invisible;  // radiance; of a point emitter radiant intensity, W sr^-1
    float density;   // with which next-event estimation samples a point of the emitter, m^-2; of a point
                     // emitter the probability of choosing it
    vec3 visible;
    uint flags;  // beside the emission: a hit reads only these two texels
    // Entry of the alias table (Walker 1974; Vose 1991).
    float threshold;  // probability of keeping this entry
    uint alias;       // the entry to use otherwise
    uint unused2[2];
};
static_assert(sizeof(DeviceEmitter) == kEmitterTexels * 16);
static_assert(offsetof(DeviceEmitter, threshold) == kEmitterAliasTexel * 16);
#endif

DUOLUX_END
#endif
