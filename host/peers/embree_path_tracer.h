#pragma once

#include "host/film/image.h"
#include "host/gpu/lights.h"
#include "host/peers/embree_scene.h"
#include "host/scene/scene.h"

namespace duolux {

/// What the path tracer of shaders/kernels/path.comp does for the reflectance `global`, in C++ with Embree's
/// single rays: bounces, Russian roulette, next-event estimation by the same table of emitters and multiple
/// importance sampling by the balance heuristic are the same, random numbers are cheaper ones. The visible
/// component of scene.render's picture. Throws UsageError if the scene has what it leaves out: smooth
/// normals, materials with a reflectance of their own.
RadianceImage renderByEmbree(const EmbreeScene& embree, const Scene& scene, const LightTable& lights);

}  // namespace duolux
