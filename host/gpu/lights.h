#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/scene/scene.h"
#include "shaders/shared/path_layout.h"

namespace duolux {

/// Emitting triangles with an alias table over their power, and the density it gives each material.
struct LightTable {
    std::vector<shared::DeviceLight> lights;
    std::vector<std::uint32_t> triangles;  ///< of each light, its index in the scene
    std::vector<float> pdfArea;            ///< per material of the scene, m^-2: 0 if it does not emit
};

/// `bothComponents`: the power of both counts, because visible emission reaches surfaces or light paths carry
/// it to the camera (else only that of the invisible one, which lights the scene).
LightTable buildLightTable(const Scene& scene, bool bothComponents);

/// Alias table (Vose, "A Linear Algorithm for Generating Random Numbers with a Given Distribution", 1991) of
/// weights that are >= 0 and not all 0.
struct AliasEntry {
    float threshold;
    std::uint32_t alias;
};
std::vector<AliasEntry> buildAliasTable(std::span<const double> weights);

}  // namespace duolux
