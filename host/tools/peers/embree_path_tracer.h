#pragma once

#include "host/device_scene/emitter_table.h"
#include "host/film/image.h"
#include "host/scene/scene.h"
#include "host/tools/peers/embree_scene.h"

namespace duolux {

/// The path tracer of shaders/kernels/path_tracer.comp for the reflectance `global`, in C++ with Embree's
/// single rays. Bounces, Russian roulette, next-event estimation with the same table of emitters, and
/// multiple importance sampling with the balance heuristic are the same; random numbers are cheaper. Renders
/// the visible component of the image. Throws UsageError for unsupported features: smooth normals, materials
/// with their own reflectance.
RadianceImage renderByEmbree(const EmbreeScene& embree, const Scene& scene, const RenderSettings& settings,
                             const EmitterTable& emitters);

}  // namespace duolux
