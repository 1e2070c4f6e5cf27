// The 2x2 blocks of the surfaces, as the scene needs them: constants leave out what no block of it does.
// The kernel that includes this defines sceneOpaque and sceneTransparent, the blocks that all materials share if
// kOneReflectance.
#ifndef DUOLUX_LIB_TRANSPORT_GLSL
#define DUOLUX_LIB_TRANSPORT_GLSL

#include "shaders/lib/light_matrix.glsl"
#include "shaders/lib/material.glsl"

layout(constant_id = kSpecTransmittance) const uint kTransmittance = 2u;
layout(constant_id = kSpecSecondColumn) const bool kSecondColumn = true;
layout(constant_id = kSpecInvisibleScatters) const bool kInvisibleScatters = true;
layout(constant_id = kSpecVisibleScatters) const bool kVisibleScatters = true;
layout(constant_id = kSpecInvisibleCrosses) const bool kInvisibleCrosses = true;
layout(constant_id = kSpecVisibleCrosses) const bool kVisibleCrosses = true;
layout(constant_id = kSpecOneReflectance) const bool kOneReflectance = false;

LightMatrix sceneOpaque();
LightMatrix sceneTransparent();

LightMatrix opaqueOf(uint material) {
    return kOneReflectance ? sceneOpaque() : fetchOpaque(material);
}

LightMatrix transparentOf(uint material) {
    return kOneReflectance ? sceneTransparent() : fetchTransparent(material);
}

LightMatrix multiply(LightMatrix a, LightMatrix b) {
    return kSecondColumn ? lightMultiply(a, b) : lightMultiplyFirstColumn(a, b);
}

// Importance that no surface can pass on by scattering or straight through is known without a look at the surface.
bool canScatter(LightMatrix w) {
    return (kInvisibleScatters && maxComponent(w.m00 + w.m10) > 0.0) ||
           (kVisibleScatters && maxComponent(w.m01 + w.m11) > 0.0);
}

bool canCross(LightMatrix w) {
    return (kInvisibleCrosses && maxComponent(w.m00 + w.m10) > 0.0) ||
           (kVisibleCrosses && maxComponent(w.m01 + w.m11) > 0.0);
}

// Russian roulette: the probability that a path goes on which carries `weight` of what it began with. The square root
// lets paths fade instead of all carrying the same until they end: less noise for the rays traced. Where weights grow
// (crossing surfaces that also scatter) every path survives and carries the growth.
float survivalProbability(float weight) { return weight < 1.0 ? min(sqrt(weight), 0.95) : 1.0; }

#endif
