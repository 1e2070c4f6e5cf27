#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/scene/scene.h"
#include "shaders/shared/path_layout.h"

namespace duolux {

/// Emitting triangles with an alias table over their power, and the sampling density of each material.
struct LightTable {
    std::vector<shared::DeviceLight> lights;
    std::vector<std::uint32_t> triangles;  ///< index in the scene of each light
    std::vector<float> pdfArea;            ///< per material of the scene, m^-2; 0 if it does not emit
};

/// `bothComponents`: whether the power of both components counts, because visible emission reaches surfaces
/// or the light tracer carries it to the camera. Otherwise only the invisible component counts.
LightTable buildLightTable(const Scene& scene, bool bothComponents);

/// Alias table (Vose, "A Linear Algorithm for Generating Random Numbers with a Given Distribution", 1991) for
/// weights that are >= 0 and not all 0.
struct AliasEntry {
    float threshold;
    std::uint32_t alias;
};
std::vector<AliasEntry> buildAliasTable(std::span<const double> weights);

}  // namespace duolux
