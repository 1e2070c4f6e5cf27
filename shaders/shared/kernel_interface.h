// Descriptor bindings and specialisation constants of all kernels, for C++ and GLSL.
#ifndef DUOLUX_SHADERS_SHARED_KERNEL_INTERFACE_H
#define DUOLUX_SHADERS_SHARED_KERNEL_INTERFACE_H

#include "shaders/shared/types.h"

DUOLUX_BEGIN

// Descriptor bindings, all in set 0.
DUOLUX_CONST uint kBindingNodes = 0u;      // WideNode as texels or storage, or acceleration structure
DUOLUX_CONST uint kBindingTriangles = 1u;  // texels or storage: DevicePair
DUOLUX_CONST uint kBindingNormals = 2u;    // texels: DeviceNormals
DUOLUX_CONST uint kBindingMaterials = 3u;  // texels: DeviceMaterial
DUOLUX_CONST uint kBindingEmitters = 4u;   // texels: DeviceEmitter
DUOLUX_CONST uint kBindingParams = 5u;     // uniform: PathParams
DUOLUX_CONST uint kBindingPixels = 6u;     // texels: the indices of four pixels each, in the order of tracing
DUOLUX_CONST uint kBindingResults = 7u;    // storage: PixelResult or LaneResult
DUOLUX_CONST uint kBindingTeams = 8u;      // storage: TeamProgress, all zero before a dispatch
DUOLUX_CONST uint kBindingFilm = 9u;       // storage: sums of the light tracer's film, an array of buffers
DUOLUX_CONST uint kBindingPlanes = 10u;    // texels: the plane of each triangle, kSpecPlanes only
DUOLUX_CONST uint kBindingLayers = 11u;    // storage: sums of the film's optional layers
DUOLUX_CONST uint kBindingColours = 12u;   // texels: DeviceColours, kSpecVertexColours only
DUOLUX_CONST uint kBindingRays = 13u;      // texels: TraceRay, two texels each
DUOLUX_CONST uint kBindingHits = 14u;      // storage: TraceHit
DUOLUX_CONST uint kBindingTextures = 15u;  // texels: DeviceTexture
DUOLUX_CONST uint kBindingAtlas = 16u;     // texels: the pixels of all images
DUOLUX_CONST uint kBindingCorners = 17u;   // texels: DeviceCorners, kSpecVertexRecords only
DUOLUX_CONST uint kBindingVertices = 18u;  // texels: DeviceVertex, kSpecVertexRecords only
DUOLUX_CONST uint kBindingSecondUvs = 19u;  // texels: two vertices each, kSpecSecondUvs only
DUOLUX_CONST uint kBindingAlbedo = 20u;     // texels: the tables of albedo_layout.h

// Specialisation constants.
DUOLUX_CONST uint kSpecWorkgroupSize = 0u;
DUOLUX_CONST uint kSpecTeamSize = 1u;        // lanes that share a range of work; divides the workgroup's size
DUOLUX_CONST uint kSpecLeaveTraversal = 2u;  // leave the traversal when fewer lanes of a subgroup are alive
DUOLUX_CONST uint kSpecLeaveNodes = 3u;      // leave the node loop when fewer lanes want nodes
DUOLUX_CONST uint kSpecVoteByShuffle = 4u;   // lanes of a subgroup of 8 vote by shuffles
DUOLUX_CONST uint kSpecPlanes = 5u;          // distances are computed from stored planes
DUOLUX_CONST uint kSpecSmoothNormals = 6u;   // some triangles have shading normals
DUOLUX_CONST uint kSpecVertexColours = 7u;   // colours of vertices scale those of materials
DUOLUX_CONST uint kSpecTransparency = 8u;    // one of kTransparency...
DUOLUX_CONST uint kSpecCameraTransparency = 9u;  // one of kTransparency..., for connections to the camera
// Some O or T has m01 or m11: visible light scatters or is transmitted.
DUOLUX_CONST uint kSpecSecondColumn = 10u;
// Some O has m00 or m01: importance for invisible light scatters.
DUOLUX_CONST uint kSpecInvisibleScatters = 11u;
DUOLUX_CONST uint kSpecVisibleScatters = 12u;    // some O has m10 or m11
DUOLUX_CONST uint kSpecInvisibleCrosses = 13u;   // some T has m00 or m01
DUOLUX_CONST uint kSpecVisibleCrosses = 14u;     // some T has m10 or m11
DUOLUX_CONST uint kSpecOneReflectance = 15u;     // all materials share PathParams.opaque and .transparent
DUOLUX_CONST uint kSpecLobes = 16u;              // sum of the kLobe... that the scene's materials have
DUOLUX_CONST uint kSpecCoverage = 17u;           // some surfaces are there only in part
DUOLUX_CONST uint kSpecEmitterKinds = 18u;       // sum of the kEmitterKind... in the scene
DUOLUX_CONST uint kSpecEmittingTriangles = 19u;  // some triangle emits
DUOLUX_CONST uint kSpecDirectLight = 20u;        // one of kDirectLight...
DUOLUX_CONST uint kSpecCamera = 21u;             // one of kCamera...
DUOLUX_CONST uint kSpecSampler = 22u;            // one of kSampler...
DUOLUX_CONST uint kSpecFilmLayers = 23u;     // the optional layers: bit i stands for the layer with index i
DUOLUX_CONST uint kSpecFilmBands = 24u;      // buffers of the light tracer's film
DUOLUX_CONST uint kSpecBandPixels = 25u;     // pixels of each of them but the last
DUOLUX_CONST uint kSpecTraceMode = 26u;      // one of kTrace...
DUOLUX_CONST uint kSpecCount = 27u;          // count visits and tests, which makes the traversal slower
DUOLUX_CONST uint kSpecTextureGroups = 28u;  // bits of the kGroup... that any material has textures for
// Normals and texture coordinates are those of vertices (DeviceVertex).
DUOLUX_CONST uint kSpecVertexRecords = 29u;
DUOLUX_CONST uint kSpecSecondUvs = 30u;  // some texture has the second set of texture coordinates

DUOLUX_END
#endif
