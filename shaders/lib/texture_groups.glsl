// The groups of material parameters (texture_layout.h) that any material of the scene has textures for, and whether any
// surface is there only in part (coverageOf), so that a scene does not pay for others.
#ifndef DUOLUX_LIB_TEXTURE_GROUPS_GLSL
#define DUOLUX_LIB_TEXTURE_GROUPS_GLSL

#include "shaders/shared/kernel_interface.h"
#include "shaders/shared/texture_layout.h"

#ifdef DUOLUX_PLAIN
const uint kTextureGroups = 0u;
const bool kCoverage = false;
#else
layout(constant_id = kSpecTextureGroups) const uint kTextureGroups = 0u;
layout(constant_id = kSpecCoverage) const bool kCoverage = false;
#endif

bool isTextured(uint group) { return (kTextureGroups & (1u << group)) != 0u; }

// Whether textures or colours of vertices scale the emission of some material.
bool isEmissionScaled() { return isTextured(kGroupEmission) || isTextured(kGroupEmissionColour); }

#endif
