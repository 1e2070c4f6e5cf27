// Chooses an emitter of the scene and dispatches to its kind (emitter/), for next-event estimation, for multiple
// importance sampling (Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, section 9.2) and for
// the light tracer.
#ifndef DUOLUX_LIB_EMITTER_GLSL
#define DUOLUX_LIB_EMITTER_GLSL

#include "shaders/lib/emitter/point.glsl"
#include "shaders/lib/emitter/triangle.glsl"
#include "shaders/lib/rng.glsl"

layout(constant_id = kSpecEmitterKinds) const uint kEmitterKinds = kAllEmitterKinds;

// Whether an emitter is of a kind. Known without its record in a scene that has one kind only.
bool isKind(Emitter emitter, uint kind) {
    return kEmitterKinds == kind || ((kEmitterKinds & kind) != 0u && (emitter.flags & kind) != 0u);
}

// An emitter chosen with the probability that its density holds, and a uniform point of the unit square, for a point on
// it.
struct EmitterChoice {
    uint index;
    vec2 u;
};

// Chooses by the alias table. `u`: uniform words; all 32 bits of the first are used, so that many emitters can be told
// apart.
EmitterChoice chooseEmitter(uint emitterCount, uvec2 u) {
    uint index, fraction;
    umulExtended(u.x, emitterCount, index, fraction);
    float rest = uniformFloat(fraction);
    AliasEntry entry = fetchAliasEntry(index);
    bool keep = rest < entry.threshold;
    // Within the chosen interval the random number is uniform; it is stretched to [0, 1) and reused.
    float remapped = (keep ? rest : rest - entry.threshold) / (keep ? entry.threshold : 1.0 - entry.threshold);
    return EmitterChoice(keep ? index : entry.alias, vec2(min(remapped, 0.99999994), uniformFloat(u.y)));
}

// Samples light that reaches a point of the scene if nothing is in between.
EmitterSample sampleEmitter(uint emitterCount, vec3 point, uvec2 u) {
    EmitterChoice choice = chooseEmitter(emitterCount, u);
    Emitter emitter = fetchEmitter(choice.index);
    if (isKind(emitter, kEmitterKindPoint)) return samplePointEmitter(emitter, choice.index, point);
    return sampleTriangleEmitter(emitter, choice.index, point, choice.u);
}

// The density per steradian with which sampleEmitter samples the direction in which a ray has met this emitter, which
// only a triangle can be.
float emitterPdf(Emitter emitter, float distanceSquared, float cosAtEmitter) {
    return pdfAreaToSolidAngle(emitter.density, distanceSquared, cosAtEmitter);
}

// Light from all emitters, nothing being in between: see irradianceFromTriangle.
Radiance2 irradianceFromEmitters(uint emitterCount, vec3 point, vec3 normal) {
    Radiance2 total = Radiance2(vec3(0.0), vec3(0.0));
    for (uint i = 0u; i < emitterCount; i++) {
        Emitter emitter = fetchEmitter(i);
        Radiance2 arriving = Radiance2(vec3(0.0), vec3(0.0));
        if (isKind(emitter, kEmitterKindPoint)) {
            arriving = irradianceFromPoint(emitter, point, normal);
        } else {
            arriving = irradianceFromTriangle(emitter, point, normal);
        }
        total.invisible += arriving.invisible;
        total.visible += arriving.visible;
    }
    return total;
}

EmitterPoint pointOnEmitter(Emitter emitter, vec2 u) {
    if (isKind(emitter, kEmitterKindPoint)) return pointOnPointEmitter(emitter);
    return pointOnTriangleEmitter(emitter, u);
}

// A light path that leaves from this point.
EmittedRay emitRay(Emitter emitter, EmitterPoint on, float side, vec2 u) {
    if (isKind(emitter, kEmitterKindPoint)) return emitFromPoint(emitter, u);
    return emitFromTriangle(emitter, on, side, u);
}

EmitterSeen seeEmitter(Emitter emitter, EmitterPoint on, vec3 toCamera) {
    if (isKind(emitter, kEmitterKindPoint)) return seePointEmitter(emitter, toCamera);
    return seeTriangleEmitter(emitter, on, toCamera);
}

// Balance heuristic: the weight of the strategy with density a.
float balanceHeuristic(float a, float b) { return a > 0.0 ? a / (a + b) : 0.0; }

#endif
