// Point emitters: the same radiant intensity in all directions. No ray can meet one, so the path tracer finds their
// light only as direct light.
#ifndef DUOLUX_LIB_EMITTER_POINT_GLSL
#define DUOLUX_LIB_EMITTER_POINT_GLSL

#include "shaders/lib/emitter/emitter_types.glsl"

// The only direction from the point of the scene; emission is intensity over the square of the distance.
EmitterSample samplePointEmitter(Emitter emitter, uint index, vec3 point) {
    vec3 offset = emitter.v0 - point;
    float distanceSquared = dot(offset, offset);
    EmitterSample s;
    s.distance = sqrt(distanceSquared);
    s.wi = offset / s.distance;
    s.emission = scaled(emitter.emission, vec3(1.0 / distanceSquared));
    s.pdf = emitter.density;
    s.delta = true;
    s.emitter = index;
    s.coincident = kNoTriangle;
    return s;
}

Radiance2 irradianceFromPoint(Emitter emitter, vec3 point, vec3 normal) {
    vec3 offset = emitter.v0 - point;
    float distanceSquared = dot(offset, offset);
    float cosine = max(dot(normal, offset), 0.0) / sqrt(distanceSquared);
    return scaled(emitter.emission, vec3(distanceSquared > 0.0 ? cosine / distanceSquared : 0.0));
}

EmitterPoint pointOnPointEmitter(Emitter emitter) {
    return EmitterPoint(emitter.v0, vec3(0.0, 0.0, 1.0), 0.0, vec2(0.0));
}

EmittedRay emitFromPoint(Emitter emitter, vec2 u) {
    EmittedRay ray;
    ray.direction = uniformSphere(u);
    ray.point = SurfacePoint(emitter.v0, ray.direction, ray.direction, 0u, 0u, 0.0);
    ray.flux = scaled(emitter.emission, vec3(4.0 * kPi / emitter.density));
    return ray;
}

// The camera cannot see a point.
EmitterSeen seePointEmitter(Emitter emitter, vec3 toCamera) {
    return EmitterSeen(SurfacePoint(emitter.v0, toCamera, toCamera, 0u, 0u, 0.0), Radiance2(vec3(0.0), vec3(0.0)));
}

#endif
