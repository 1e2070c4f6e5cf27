// Emitting triangles: radiance is the same in all directions of a side and, without textures, at all points.
#ifndef DUOLUX_LIB_EMITTER_TRIANGLE_GLSL
#define DUOLUX_LIB_EMITTER_TRIANGLE_GLSL

#include "shaders/lib/emitter/emitter_types.glsl"
#include "shaders/lib/frame.glsl"
#include "shaders/lib/polygon_light.glsl"
#include "shaders/lib/warp.glsl"

bool coincidesWithOthers(Emitter emitter) { return kPlanes && (emitter.flags & kEmitterCoincident) != 0u; }

EmitterPoint pointOnTriangleEmitter(Emitter emitter, vec2 u) {
    vec2 b = uniformTriangle(u);
    EmitterPoint on;
    on.normal = normalize(cross(emitter.v1 - emitter.v0, emitter.v2 - emitter.v0));
    on.position = emitter.v0 * (1.0 - b.x - b.y) + emitter.v1 * b.x + emitter.v2 * b.y;
    on.positionError = emitter.positionError;
    on.barycentric = b;
    if (kPlanes) {
        Plane plane = fetchPlane(emitter.triangle);
        on.position = ontoPlane(plane, on.position);
        on.positionError = planeError(plane, on.position);
    }
    return on;
}

// Converts the density pdfArea (m^-2) of a point on an emitter to a density per steradian at a point
// sqrt(distanceSquared) away.
float pdfAreaToSolidAngle(float pdfArea, float distanceSquared, float cosAtEmitter) {
    return pdfArea * distanceSquared / max(abs(cosAtEmitter), 1e-12);
}

EmitterSample sampleTriangleEmitter(Emitter emitter, uint index, vec3 point, vec2 u) {
    EmitterPoint on = pointOnTriangleEmitter(emitter, u);
    vec3 offset = on.position - point;
    float side = dot(on.normal, offset) < 0.0 ? 1.0 : -1.0;
    // To just in front of the emitter, which must not hide itself; or to itself, if surfaces that coincide with it may.
    bool coincident = coincidesWithOthers(emitter);
    vec3 toEmitter = offset + on.normal * (coincident ? 0.0 : side * on.positionError);
    float distanceSquared = dot(toEmitter, toEmitter);
    EmitterSample s;
    s.distance = sqrt(distanceSquared);
    s.wi = toEmitter / s.distance;
    float cosAtEmitter = dot(on.normal, s.wi);
    s.emission = emissionAt(emitter, on, cosAtEmitter < 0.0);
    s.pdf = pdfAreaToSolidAngle(emitter.density, distanceSquared, cosAtEmitter);
    s.delta = false;
    s.emitter = index;
    s.coincident = coincident ? emitter.triangle : kNoTriangle;
    return s;
}

// Light that reaches a point from the whole emitter if nothing is in between: the integral of radiance times the cosine
// with `normal` over the solid angle.
Radiance2 irradianceFromTriangle(Emitter emitter, vec3 point, vec3 normal) {
    vec3 a = emitter.v0 - point;
    vec3 edge1 = emitter.v1 - emitter.v0;
    vec3 edge2 = emitter.v2 - emitter.v0;
    bool front = dot(cross(edge1, edge2), a) < 0.0;
    return scaled(emissionOn(emitter, front), vec3(projectedSolidAngle(a, edge1, edge2, normal)));
}

// The point on the side of `normal`. Coincident surfaces may be on either side, so the point counts as behind them.
SurfacePoint emitterSurface(Emitter emitter, EmitterPoint on, vec3 normal) {
    bool coincident = coincidesWithOthers(emitter);
    float offset = coincident ? 0.0 : on.positionError;
    vec3 position = coincident ? on.position : on.position + normal * offset;
    return SurfacePoint(position, normal, normal, emitter.triangle, coincident ? 1u : 0u, offset);
}

// Flux of a light path (W) per unit of emitted radiance if the point has the density pdfArea (m^-2), the side is chosen
// uniformly from `sides`, and the direction has the density cos / pi.
float emittedFlux(float pdfArea, float sides) { return kPi * sides / pdfArea; }

// `side`: a uniform number, which chooses the side.
EmittedRay emitFromTriangle(Emitter emitter, EmitterPoint on, float side, vec2 u) {
    bool bothSides = (emitter.flags & kEmitterBack) != 0u;
    vec3 normal = !bothSides || side < 0.5 ? on.normal : -on.normal;
    EmittedRay ray;
    ray.point = emitterSurface(emitter, on, normal);
    ray.direction = fromFrame(normal, cosineHemisphere(u));
    ray.flux = scaled(emitter.emission, vec3(emittedFlux(emitter.density, bothSides ? 2.0 : 1.0)));
    if (emissionVaries()) ray.flux = scaled(ray.flux, emissionTexel(emitter.triangle, on.barycentric));
    return ray;
}

EmitterSeen seeTriangleEmitter(Emitter emitter, EmitterPoint on, vec3 toCamera) {
    bool front = dot(on.normal, toCamera) > 0.0;
    return EmitterSeen(emitterSurface(emitter, on, front ? on.normal : -on.normal),
                       scaled(emissionAt(emitter, on, front), vec3(1.0 / emitter.density)));
}

#endif
