#pragma once

// Structures of the library that travel between host and device.

#include "tests/shader/oracles.h"

// NOLINTBEGIN(bugprone-macro-parentheses)
/// A structure of the mirror that the library declares under the same name.
#define DUOLUX_MIRROR_TYPE(Name)                               \
    DUOLUX_GLSL_TYPE(duolux::mirror::single::Name, #Name, ""); \
    namespace duolux::mirror::single {                         \
    inline twice::Name widen(const Name& s) {                  \
        return duolux::test::widenTo<twice::Name>(s);          \
    }                                                          \
    }                                                          \
    static_assert(true)
// NOLINTEND(bugprone-macro-parentheses)

DUOLUX_MIRROR_TYPE(Bsdf);
DUOLUX_MIRROR_TYPE(BsdfFrame);
DUOLUX_MIRROR_TYPE(BsdfSample);
DUOLUX_MIRROR_TYPE(Triangle);
DUOLUX_MIRROR_TYPE(SurfacePoint);
DUOLUX_MIRROR_TYPE(Segment);
DUOLUX_MIRROR_TYPE(Plane);
DUOLUX_MIRROR_TYPE(ReflectanceMatrix);
DUOLUX_MIRROR_TYPE(Radiance2);
DUOLUX_MIRROR_TYPE(Material);
DUOLUX_MIRROR_TYPE(Texture);
DUOLUX_MIRROR_TYPE(FilmSum);
DUOLUX_MIRROR_TYPE(Emitter);
DUOLUX_MIRROR_TYPE(AliasEntry);
DUOLUX_MIRROR_TYPE(EmitterChoice);
DUOLUX_MIRROR_TYPE(EmitterPoint);
DUOLUX_MIRROR_TYPE(EmittedRay);
DUOLUX_MIRROR_TYPE(EmitterSeen);
DUOLUX_MIRROR_TYPE(SampleRadiance);
DUOLUX_MIRROR_TYPE(PixelSums);
DUOLUX_MIRROR_TYPE(PixelResult);
DUOLUX_MIRROR_TYPE(LaneSums);
DUOLUX_MIRROR_TYPE(LaneResult);
