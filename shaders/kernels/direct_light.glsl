// Emitted light in the path tracer: emission that a path meets, and direct light at its vertices, either by next-event
// estimation (with shadow rays, unless nothing can block an emitter) or in closed form.

// A shadow ray in flight.
struct Shadow {
    bool pending;
    Segment segment;
    float distance;                // to the emitter
    uint beforeOrder;              // of the emitter if surfaces coincide with it
    ReflectanceMatrix importance;  // W O f cos / pdf and what was crossed so far (kTransparencyGeneral)
    Radiance2 emission;            // of the emitter (kTransparencyGeneral), else the contribution if nothing blocks it
    uint scatterings;              // events on the whole path, for the statistics
};

void addRadiance(inout SampleRadiance received, Radiance2 arriving, uint scatterings) {
    addRadiance(received, arriving, scatterings, params.bounces, params.display);
}

// Collects what the surface emits, which may be nothing; weighted, because direct light is sampled at vertices, too.
void collectEmission(inout SampleRadiance received, Path path, SurfaceHit hit, ReflectanceMatrix w, float t,
                     uint rank) {
    Emitter emitter = emitterOfTriangle(rank, params.emittingTriangles);
    float pdf = emitterPdf(emitter, t * t, hit.cosine);
    float misWeight = path.scatterings > 0u ? balanceHeuristic(path.bsdfPdf, pdf) : 1.0;
    if (kDirectLight == kDirectLightClosedForm) misWeight = path.scatterings > 0u ? 0.0 : 1.0;
    // Without a branch on whether the triangle emits, which makes `global` 8 % slower on lavapipe.
    Radiance2 emission = emissionOn(emitter, hit.front);
    if (isEmissionScaled()) emission = scaled(emission, hit.emissionTexel);
    Radiance2 collected = matrixApply(w, emission);
    addRadiance(received, scaled(collected, vec3(misWeight)), path.scatterings);
}

// `importance`: W O at the vertex.
void connectToEmitter(inout Shadow shadow, inout SampleRadiance received, SurfaceHit hit, ReflectanceMatrix importance,
                      vec3 wo, uvec2 words, uint scatterings) {
    EmitterSample sampled = sampleEmitter(params.emitterCount, hit.point.position, words);
    BsdfFrame frame = frameOf(hit.point, hit.bsdf);
    vec3 f = bsdfEvaluate(hit.bsdf, frame, wo, sampled.wi, kModeRadiance);
    // The weight of the balance heuristic, pdf / (pdf + bsdfPdf), over pdf. No other strategy finds a delta.
    float otherPdf = sampled.delta ? 0.0 : bsdfPdf(hit.bsdf, frame, wo, sampled.wi, kModeRadiance);
    float weight = 1.0 / (sampled.pdf + otherPdf);
    if (kAttenuates && isInside(hit.bsdf, dot(frame.geometric, sampled.wi) < 0.0)) {
        f *= exp(-hit.bsdf.attenuation * sampled.distance);
    }
    ReflectanceMatrix reflected = scaled(importance, f * (bsdfCosine(frame, sampled.wi, kModeRadiance) * weight));
    Radiance2 contribution = matrixApply(reflected, sampled.emission);
    bool contributes = sampled.distance > 0.0 && maxComponent(contribution.invisible + contribution.visible) > 0.0;
    if (kTransparency == kTransparencyIdentity) {
        if (contributes) addRadiance(received, contribution, scatterings);
    } else if (contributes) {
        shadow.pending = true;
        shadow.segment = leaveVertex(hit.point, hit.bsdf, sampled.wi);
        shadow.distance = sampled.distance;
        if (kTransmits) {
            // A ray that leaves on the other side starts there, nearer to the emitter, which must not hide itself.
            vec3 toEmitter = hit.point.position + sampled.wi * sampled.distance - shadow.segment.origin;
            shadow.distance = length(toEmitter);
            shadow.segment.direction = toEmitter / shadow.distance;
        }
        shadow.beforeOrder = kNoTriangle;
        if (sampled.coincident != kNoTriangle) {
            Plane plane = fetchPlane(sampled.coincident);
            shadow.distance = planeDistance(plane, shadow.segment.origin, sampled.wi);
            shadow.beforeOrder = orderOfSurface(sampled.emitter, dot(plane.normal, sampled.wi) < 0.0);
        }
        shadow.scatterings = scatterings;
        if (kTransparency == kTransparencyGeneral) {
            shadow.importance = reflected;
            shadow.emission = sampled.emission;
        } else {
            shadow.emission = contribution;
        }
    }
}

// Light from all emitters on a diffuse vertex.
void addClosedForm(inout SampleRadiance received, SurfaceHit hit, ReflectanceMatrix importance, uint scatterings) {
    Radiance2 total = irradianceFromEmitters(params.emitterCount, hit.point.position, hit.point.shadingNormal);
    ReflectanceMatrix reflected = scaled(importance, diffuseEvaluate(hit.bsdf));
    addRadiance(received, matrixApply(reflected, total), scatterings);
}

// The shadow ray has met a surface, or nothing more up to the emitter.
void continueShadow(inout Shadow shadow, inout SampleRadiance received, Traversal ray, bool found, uint material,
                    float coverage) {
    if (kTransparency == kTransparencyCoverage && found) {
        shadow.emission = scaled(shadow.emission, vec3(1.0 - coverage));
        crossSurface(shadow.segment, ray);
        shadow.pending = coverage < 1.0;
        return;
    }
    if (kTransparency == kTransparencyGeneral && found) {
        ReflectanceMatrix m = crossed(shadow.importance, material, coverage);
        shadow.importance = m;
        crossSurface(shadow.segment, ray);
        shadow.pending = maxComponent(m.m00 + m.m01 + m.m10 + m.m11) > 0.0;
        return;
    }
    if (!found) {
        bool general = kTransparency == kTransparencyGeneral;
        Radiance2 arriving = general ? matrixApply(shadow.importance, shadow.emission) : shadow.emission;
        addRadiance(received, arriving, shadow.scatterings);
    }
    shadow.pending = false;
}
