// How a kernel reaches the triangles of a scene and finds those along a ray: by a tree of ours in texel buffers or,
// compiled with DUOLUX_STORAGE, in storage buffers; with DUOLUX_RAY_QUERY, by an acceleration structure of the driver's.
#ifdef DUOLUX_RAY_QUERY

#include "shaders/kernels/ray_query.glsl"

#else

#include "shaders/lib/traverse.glsl"
#ifdef DUOLUX_STORAGE
layout(binding = kBindingNodes, std430) readonly buffer NodesBlock { uvec4 nodeTexels[]; };
uvec4 fetchNodeTexel(uint index) { return nodeTexels[index]; }
#else
layout(binding = kBindingNodes, rgba32ui) uniform readonly uimageBuffer nodeTexels;
uvec4 fetchNodeTexel(uint index) { return imageLoad(nodeTexels, int(index)); }
#endif

#endif

#ifdef DUOLUX_STORAGE
layout(binding = kBindingTriangles, std430) readonly buffer PairsBlock { uvec4 pairTexels[]; };
uvec4 fetchPairTexel(uint index) { return pairTexels[index]; }
#else
layout(binding = kBindingTriangles, rgba32ui) uniform readonly uimageBuffer pairTexels;
uvec4 fetchPairTexel(uint index) { return imageLoad(pairTexels, int(index)); }
#endif
