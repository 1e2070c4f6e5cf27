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
layout(binding = kBindingParams, scalar) uniform ParamsBlock { PathParams params; };
layout(binding = kBindingTeams, scalar) buffer TeamsBlock { TeamProgress teams[]; };

#include "shaders/kernels/layout.glsl"
#include "shaders/lib/camera.glsl"
#include "shaders/lib/emitter.glsl"
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

ReflectanceMatrix fromDevice(DeviceReflectanceMatrix m) { return ReflectanceMatrix(m.m00, m.m01, m.m10, m.m11); }
ReflectanceMatrix sceneOpaque() { return fromDevice(params.opaque); }
ReflectanceMatrix sceneTransparent() { return fromDevice(params.transparent); }

// Whether a ray visits the surfaces along it one by one, including coincident ones.
const bool kOrdered = kTransparency != kTransparencyZero || kPlanes;
