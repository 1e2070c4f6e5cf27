// The scene as the kernels of both integrators see it: buffers, parameters, and functions that fetch from them.
#include "shaders/shared/bvh_layout.h"
#include "shaders/shared/path_tracer_layout.h"

layout(constant_id = kSpecSmoothNormals) const bool kSmoothNormals = true;
layout(constant_id = kSpecVertexColours) const bool kVertexColours = false;
layout(constant_id = kSpecSampler) const uint kSampler = kSamplerSobol;
layout(constant_id = kSpecTeamSize) const uint kTeamSize = 8u;

layout(binding = kBindingNormals, rgba32ui) uniform readonly uimageBuffer normalTexels;
layout(binding = kBindingMaterials, rgba32ui) uniform readonly uimageBuffer materialTexels;
layout(binding = kBindingEmitters, rgba32ui) uniform readonly uimageBuffer emitterTexels;
layout(binding = kBindingPlanes, rgba32ui) uniform readonly uimageBuffer planeTexels;
layout(binding = kBindingColours, rgba32ui) uniform readonly uimageBuffer colourTexels;
layout(binding = kBindingAlbedo, rgba32ui) uniform readonly uimageBuffer albedoTexels;
layout(binding = kBindingTextures, rgba32ui) uniform readonly uimageBuffer textureTexels;
layout(binding = kBindingAtlas, rgba32ui) uniform readonly uimageBuffer atlasTexels;
layout(binding = kBindingCorners, rgba32ui) uniform readonly uimageBuffer cornerTexels;
layout(binding = kBindingVertices, rgba32ui) uniform readonly uimageBuffer vertexTexels;
layout(binding = kBindingSecondUvs, rgba32ui) uniform readonly uimageBuffer secondUvTexels;
layout(binding = kBindingParams, scalar) uniform ParamsBlock { PathParams params; };
layout(binding = kBindingTeams, scalar) buffer TeamsBlock { TeamProgress teams[]; };

#include "shaders/kernels/layout.glsl"
#include "shaders/lib/camera.glsl"
#include "shaders/lib/emitter.glsl"
#include "shaders/lib/material_textures.glsl"
#include "shaders/lib/sampler.glsl"
#include "shaders/lib/surface.glsl"
#include "shaders/lib/transport.glsl"
#include "shaders/lib/vertex_colour.glsl"

uvec4 fetchNormalTexel(uint index) { return imageLoad(normalTexels, int(index)); }
uvec4 fetchMaterialTexel(uint index) { return imageLoad(materialTexels, int(index)); }
uvec4 fetchEmitterTexel(uint index) { return imageLoad(emitterTexels, int(index)); }
uvec4 fetchPlaneTexel(uint index) { return imageLoad(planeTexels, int(index)); }
uvec4 fetchColourTexel(uint index) { return imageLoad(colourTexels, int(index)); }
uvec4 fetchAlbedoTexel(uint index) { return imageLoad(albedoTexels, int(index)); }
uvec4 fetchTextureTexel(uint index) { return imageLoad(textureTexels, int(index)); }
uvec4 fetchAtlasTexel(uint index) { return imageLoad(atlasTexels, int(index)); }
uvec4 fetchCornerTexel(uint index) { return imageLoad(cornerTexels, int(index)); }
uvec4 fetchVertexTexel(uint index) { return imageLoad(vertexTexels, int(index)); }
uvec4 fetchSecondUvTexel(uint index) { return imageLoad(secondUvTexels, int(index)); }

// What a triangle's textures of these groups say at a point, see sampleTextures().
TextureValues texturesAt(uint triangle, uint material, uint groups, vec2 barycentric) {
    TextureValues values = noTextures();
    if (kTextureGroups == 0u) return values;
    // A loop, because only loops skip what no lane needs.
    uint textured = groups == 0u ? 0u : min(fetchTextureRange(material).y, 1u);
    for (uint i = 0u; i < textured; i++) {
        vec2 uv = vec2(0.0), secondUv = vec2(0.0);
        if (kVertexRecords) {
            uv = vertexUv(fetchVertices(triangle), barycentric);
            secondUv = secondVertexUv(triangle, barycentric);
        }
        values = sampleTextures(material, groups, uv, secondUv);
    }
    return values;
}

ReflectanceMatrix fromDevice(DeviceReflectanceMatrix m) { return ReflectanceMatrix(m.m00, m.m01, m.m10, m.m11); }
ReflectanceMatrix sceneOpaque() { return fromDevice(params.opaque); }
ReflectanceMatrix sceneTransparent() { return fromDevice(params.transparent); }

// Whether a ray visits the surfaces along it one by one, including coincident ones.
const bool kOrdered = kTransparency != kTransparencyZero || kPlanes;

// The textures that say how much of a surface is there.
const uint kCoverageGroups = kCoverage ? kTextureGroups & (1u << kGroupBase) : 0u;

// How much of a triangle's surface is there at a point.
float coverageAt(uint triangle, uint materialIndex, vec2 barycentric) {
    if (!kCoverage) return 1.0;
    Material material = fetchMaterial(materialIndex);
    if (kVertexColours) material.alpha *= vertexAlpha(triangle, barycentric);
    if (isTextured(kGroupBase)) {
        material.alpha *= texturesAt(triangle, materialIndex, kCoverageGroups, barycentric).base.w;
    }
    return coverageOf(material);
}

// T where only a part of the surface is there: light passes unchanged through the rest.
ReflectanceMatrix transparentAt(uint material, float coverage) {
    ReflectanceMatrix m = transparentOf(material);
    if (!kCoverage) return m;
    vec3 rest = vec3(1.0 - coverage);
    return ReflectanceMatrix(m.m00 * coverage + rest, m.m01 * coverage, m.m10 * coverage, m.m11 * coverage + rest);
}

// W behind a surface.
ReflectanceMatrix crossed(ReflectanceMatrix w, uint material, float coverage) {
    if (kTransparency == kTransparencyCoverage) return scaled(w, vec3(1.0 - coverage));
    return multiply(w, transparentAt(material, coverage));
}

// Light behind a surface. `transparency`: a value of kTransparency.
Radiance2 crossed(Radiance2 light, uint material, float coverage, uint transparency) {
    if (transparency == kTransparencyCoverage) return scaled(light, vec3(1.0 - coverage));
    return matrixApply(transparentAt(material, coverage), light);
}

// What colours of vertices make of the emission of a material with these flags.
vec3 emissionColour(uint flags, vec3 colour) {
    return isTextured(kGroupEmissionColour) && (flags & kMaterialUnlit) != 0u ? colour : vec3(1.0);
}

vec3 emissionTexel(uint triangle, vec2 barycentric) {
    uint material = fetchTriangle(triangle).materialFlags & kMaterialMask;
    vec3 texel = texturesAt(triangle, material, 1u << kGroupEmission, barycentric).emission.xyz;
    if (isTextured(kGroupEmissionColour)) {
        texel *= emissionColour(fetchMaterial(material).flags, vertexColour(triangle, barycentric));
    }
    return texel * coverageAt(triangle, material, barycentric);
}
