// What every lobe in this folder takes and returns.
#ifndef DUOLUX_LIB_BSDF_BSDF_TYPES_GLSL
#define DUOLUX_LIB_BSDF_BSDF_TYPES_GLSL

#include "shaders/lib/frame.glsl"
#include "shaders/lib/warp.glsl"
#include "shaders/shared/material_layout.h"

// What a path carries: radiance to the camera (it is traced from the camera), or importance to the emitters (it is
// traced from an emitter). Both modes evaluate the same BSDF f(view, incident). With shading normals the cosine of `wi`
// differs: radiance mode has that to the shading normal, importance mode that to the geometric normal (Veach, "Robust
// Monte Carlo Methods for Light Transport Simulation", 1997, section 5.3).
const uint kModeRadiance = 0u;
const uint kModeImportance = 1u;

// The parameters of all lobes (Material in host/scene/material.h).
struct Bsdf {
    vec3 baseColor;
    float metallic;
    float roughness;
    vec3 f0;              // of the dielectric: reflectance at normal incidence
    float specular;       // of the dielectric: reflectance at grazing incidence
    float transmission;
    float eta;            // index of refraction of the side opposite to wo, relative to that of wo
    uint flags;           // kBsdf...
    float clearcoat;
    float clearcoatRoughness;
    vec3 sheenColor;
    float sheenRoughness;
    vec2 alpha;           // of GGX, along and across the tangent
    vec3 tangent;         // unit, in the plane of the shading normal; of anisotropic lobes
    vec3 attenuation;     // inside glass, per scene unit
    vec3 coatNormal;      // unit, on the side of wo; of the clearcoat, if hasCoatNormals()
};

const uint kBsdfThin = 1u;     // glass is a wall without thickness
const uint kBsdfOutside = 2u;  // wo is on the outside: the triangle's front or, if light does not enter, either side

bool isThin(Bsdf bsdf) { return (bsdf.flags & kBsdfThin) != 0u; }
bool isOutside(Bsdf bsdf) { return (bsdf.flags & kBsdfOutside) != 0u; }

// The unit normals of a surface, both on the side of `wo`, and the unit tangent, at a right angle to the shading
// normal. `wo` is above the geometric normal's horizon, but may be below the shading normal's.
struct BsdfFrame {
    vec3 shading;
    vec3 geometric;
    vec3 tangent;  // used only by anisotropic lobes
    vec3 coat;     // unit, on the same side: the normal of the clearcoat, if hasCoatNormals()
};

#ifdef DUOLUX_PLAIN
const uint kLobes = kLobeDiffuse;
#else
layout(constant_id = kSpecLobes) const uint kLobes = kAllLobes;
#endif

const bool kAnisotropic = (kLobes & kLobeAnisotropic) != 0u;

// Transforms a direction to the frame of the shading normal and the tangent.
vec3 toShadingFrame(BsdfFrame frame, vec3 w) {
    if (!kAnisotropic) return toFrame(frame.shading, w);
    return vec3(dot(frame.tangent, w), dot(cross(frame.shading, frame.tangent), w), dot(frame.shading, w));
}
vec3 fromShadingFrame(BsdfFrame frame, vec3 local) {
    if (!kAnisotropic) return fromFrame(frame.shading, local);
    return normalize(frame.tangent * local.x + cross(frame.shading, frame.tangent) * local.y + frame.shading * local.z);
}

// `wi` is on the other side than `wo` where a lobe transmits: dot(geometric, wi) < 0.
struct BsdfSample {
    vec3 wi;      // unit
    float pdf;    // per steradian; kDeltaPdf: the direction is the only one; 0: nothing is scattered
    vec3 weight;  // f |cos| / pdf
};

// Stands for the infinite density of a delta distribution. Every other strategy has no weight beside it.
const float kDeltaPdf = 1e30;

// The direction towards the camera, and the direction from which light is incident.
vec3 viewOf(vec3 wo, vec3 wi, uint mode) { return mode == kModeRadiance ? wo : wi; }
vec3 incidentOf(vec3 wo, vec3 wi, uint mode) { return mode == kModeRadiance ? wi : wo; }

// The normal to which `wi` has its cosine.
vec3 normalOfMode(BsdfFrame frame, uint mode) { return mode == kModeRadiance ? frame.shading : frame.geometric; }

// The cosine that goes with f.
float bsdfCosine(BsdfFrame frame, vec3 wi, uint mode) { return abs(dot(normalOfMode(frame, mode), wi)); }

// Whether `wi` leaves the surface on the side of `wo`, and light is incident above the horizon of the shading
// normal.
bool reflects(BsdfFrame frame, vec3 wo, vec3 wi, uint mode) {
    return dot(frame.geometric, wi) > 0.0 && dot(frame.shading, incidentOf(wo, wi, mode)) > 0.0;
}

// Whether `wi` leaves the surface on the other side, for both normals.
bool transmits(BsdfFrame frame, vec3 wo, vec3 wi) {
    return dot(frame.geometric, wi) < 0.0 && dot(frame.shading, wi) < 0.0 && dot(frame.shading, wo) > 0.0;
}

const bool kAttenuates = (kLobes & kLobeAttenuation) != 0u;

// Whether light that leaves to a side is inside the object, whose front is outside. `through`: not the side of wo.
bool isInside(Bsdf bsdf, bool through) { return isOutside(bsdf) == through; }

// Whether the main microfacets reflect (and refract) without spreading light.
bool isSmooth(Bsdf bsdf) { return bsdf.alpha.x * bsdf.alpha.y < kSmoothAlpha * kSmoothAlpha; }

#endif
