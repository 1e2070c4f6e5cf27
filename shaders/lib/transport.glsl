// The 2x2 reflectance matrices of surfaces. Specialisation constants remove the code that no matrix of the scene needs.
// The kernel that includes this defines sceneOpaque and sceneTransparent, the matrices that all materials share if
// kOneReflectance is true.
#ifndef DUOLUX_LIB_TRANSPORT_GLSL
#define DUOLUX_LIB_TRANSPORT_GLSL

#include "shaders/lib/reflectance_matrix.glsl"
#include "shaders/lib/material.glsl"
#include "shaders/shared/path_tracer_layout.h"

layout(constant_id = kSpecTransparency) const uint kTransparency = kTransparencyGeneral;
layout(constant_id = kSpecSecondColumn) const bool kSecondColumn = true;
layout(constant_id = kSpecInvisibleScatters) const bool kInvisibleScatters = true;
layout(constant_id = kSpecVisibleScatters) const bool kVisibleScatters = true;
layout(constant_id = kSpecInvisibleCrosses) const bool kInvisibleCrosses = true;
layout(constant_id = kSpecVisibleCrosses) const bool kVisibleCrosses = true;
layout(constant_id = kSpecOneReflectance) const bool kOneReflectance = false;

ReflectanceMatrix sceneOpaque();
ReflectanceMatrix sceneTransparent();

ReflectanceMatrix opaqueOf(uint material) {
    return kOneReflectance ? sceneOpaque() : fetchOpaque(material);
}

ReflectanceMatrix transparentOf(uint material) {
    return kOneReflectance ? sceneTransparent() : fetchTransparent(material);
}

ReflectanceMatrix multiply(ReflectanceMatrix a, ReflectanceMatrix b) {
    return kSecondColumn ? matrixMultiply(a, b) : matrixMultiplyFirstColumn(a, b);
}

// Whether any surface of the scene can scatter, or transmit, some of the importance of a path; known without reading
// the surface's material.
bool canScatter(ReflectanceMatrix w) {
    return (kInvisibleScatters && maxComponent(w.m00 + w.m10) > 0.0) ||
           (kVisibleScatters && maxComponent(w.m01 + w.m11) > 0.0);
}

bool canCross(ReflectanceMatrix w) {
    return (kInvisibleCrosses && maxComponent(w.m00 + w.m10) > 0.0) ||
           (kVisibleCrosses && maxComponent(w.m01 + w.m11) > 0.0);
}

// Russian roulette: the probability that a path continues whose throughput is `weight` relative to its start. With the
// square root, throughput decreases gradually along a path, which gives less noise per ray than constant throughput
// with more terminations. Where the throughput grows (crossings of surfaces that also scatter), every path continues.
float survivalProbability(float weight) { return weight < 1.0 ? min(sqrt(weight), 0.95) : 1.0; }

#endif
