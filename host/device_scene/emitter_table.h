#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/scene/emitters.h"
#include "host/scene/scene.h"
#include "shaders/shared/emitter_layout.h"

namespace duolux {

/// The rank of a triangle, by which a ray crosses coincident triangles of the same orientation: emitters come
/// first, so that a lamp in the plane of a ceiling is visible; otherwise the order of the scene applies. The
/// rank of an emitting triangle is the index of its record in EmitterTable.
class TriangleRanks {
  public:
    /// `emitters`: the triangles that emit, ascending. Must outlive this object.
    explicit TriangleRanks(std::span<const std::uint32_t> emitters) : emitters_(emitters) {}
    std::uint32_t rankOf(std::uint32_t triangle) const;

  private:
    std::span<const std::uint32_t> emitters_;
};

/// Records of all emitters, with an alias table over their power.
struct EmitterTable {
    std::vector<shared::DeviceEmitter> records;
    /// Emitters that can be chosen by the table: all, or 0 if no power counts.
    std::uint32_t choices = 0;
};

/// `emitters`: listEmitters(scene); the records are in this order. `bothComponents`: whether the power of
/// both components counts, because visible emission reaches surfaces or the light tracer carries it to the
/// camera. Otherwise only the invisible component counts.
EmitterTable buildEmitterTable(const Scene& scene, std::span<const SceneEmitter> emitters,
                               bool bothComponents);

/// The sum of the shared::kEmitterKind... of emitters, for the specialisation of kernels.
std::uint32_t emitterKinds(std::span<const SceneEmitter> emitters);

/// Alias table (Vose, "A Linear Algorithm for Generating Random Numbers with a Given Distribution", 1991) for
/// weights that are >= 0 and not all 0.
struct AliasEntry {
    float threshold;
    std::uint32_t alias;
};
std::vector<AliasEntry> buildAliasTable(std::span<const double> weights);

}  // namespace duolux
