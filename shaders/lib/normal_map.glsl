// Shading normals from images.
#ifndef DUOLUX_LIB_NORMAL_MAP_GLSL
#define DUOLUX_LIB_NORMAL_MAP_GLSL

#include "shaders/lib/vertex_records.glsl"

// The unit normal of a texel (0 to 1 for -1 to 1; z away from the surface's front) in the frame; `scale`: of x and y.
// Where the texel says nothing, that is the frame's normal.
vec3 mappedNormal(vec3 texel, float scale, TangentFrame frame) {
    vec3 n = vec3((texel.x * 2.0 - 1.0) * scale, (texel.y * 2.0 - 1.0) * scale, texel.z * 2.0 - 1.0);
    vec3 world = frame.tangent * n.x + frame.bitangent * n.y + frame.normal * n.z;
    return dot(world, world) > 1e-12 ? normalize(world) : frame.normal;
}

// Bends a shading normal by as little as keeps the mirror image of `view` (unit, above the geometric normal's horizon)
// above that horizon, too: otherwise a shiny surface would be black there. The result is on the side of `view`
// (Keller et al., "The Iray Light Transport Simulation and Rendering System", 2017, appendix A.3). Normals there that
// need no bending are returned as they are.
vec3 bentNormal(vec3 normal, vec3 geometric, vec3 view) {
    float above = dot(geometric, view);
    if (above <= 0.0) return normal;
    // The geometric normal itself mirrors `view` to a direction as high as `view`.
    float lowest = min(0.01, 0.9 * above);
    vec3 mirrored = 2.0 * dot(normal, view) * normal - view;
    float height = dot(geometric, mirrored);
    vec3 raised = normalize(mirrored + geometric * (lowest - height));
    // Both sides of a normal mirror alike.
    vec3 facing = dot(normal, view) < 0.0 ? -normal : normal;
    return height < lowest ? normalize(view + raised) : facing;
}

// The shading normal on the side of `geometric` (unit). `view`: unit, towards the viewer.
vec3 normalMapped(vec3 texel, float scale, TangentFrame frame, vec3 geometric, vec3 view) {
    vec3 n = mappedNormal(texel, scale, frame);
    return bentNormal(dot(frame.normal, geometric) < 0.0 ? -n : n, geometric, view);
}

#endif
