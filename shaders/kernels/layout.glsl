// What all kernels share: the size of work groups, and when lanes leave loops.
//
// How a kernel reads the triangles of a scene and finds those along a ray: our tree in texel buffers (the default), our
// tree in storage buffers (DUOLUX_STORAGE), or an acceleration structure of the driver (DUOLUX_RAY_QUERY).
layout(local_size_x_id = kSpecWorkgroupSize) in;
layout(constant_id = kSpecLeaveTraversal) const uint kLeaveTraversal = 4u;
layout(constant_id = kSpecLeaveNodes) const uint kLeaveNodes = 3u;

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
