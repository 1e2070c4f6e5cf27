// Where a path may scatter. All surfaces along a segment are met in order; one of them is chosen by weighted reservoir
// sampling (Chao, "A General Purpose Unequal Probability Sampling Plan", Biometrika 69(3), 1982).
#ifndef DUOLUX_LIB_VERTEX_GLSL
#define DUOLUX_LIB_VERTEX_GLSL

#include "shaders/lib/bsdf.glsl"
#include "shaders/lib/surface.glsl"

struct Vertex {
    Bsdf bsdf;
    SurfacePoint point;
    float weight;     // of the chosen vertex
    float weightSum;  // of all vertices of the segment
};

// Offers a further vertex, with a weight above 0, and a uniform number `u`. Returns whether it replaces the chosen
// vertex.
bool offerVertex(inout Vertex vertex, Bsdf bsdf, SurfacePoint point, float weight, float u) {
    float weightSum = vertex.weightSum + weight;
    bool chosen = u * weightSum < weight;
    if (chosen) {
        vertex.bsdf = bsdf;
        vertex.point = point;
        vertex.weight = weight;
    }
    vertex.weightSum = weightSum;
    return chosen;
}

#endif
