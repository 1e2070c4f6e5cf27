#pragma once

// Structures of the library as they pass between host and device: their GLSL names, the numbers they consist
// of, and their conversion from single to double precision.

#include <vector>

#include "tests/shader/oracles.h"

// NOLINTBEGIN(bugprone-macro-parentheses)
/// A structure of the mirror that a library declares; the arguments are its fields, as members of `s`.
#define DUOLUX_MIRROR_TYPE(Name, ...)                          \
    DUOLUX_GLSL_TYPE(duolux::mirror::single::Name, #Name, ""); \
    namespace duolux::mirror::single {                         \
    inline std::vector<double> numbers(const Name& s) {        \
        return duolux::test::numbers(__VA_ARGS__);             \
    }                                                          \
    }                                                          \
    namespace duolux::mirror::twice {                          \
    inline std::vector<double> numbers(const Name& s) {        \
        return duolux::test::numbers(__VA_ARGS__);             \
    }                                                          \
    }                                                          \
    static_assert(true)
// NOLINTEND(bugprone-macro-parentheses)

namespace duolux::mirror {

namespace single {
template <std::size_t N>
std::vector<double> numbers(const Array<N>& a) {
    return {a.items, a.items + N};
}
}  // namespace single
namespace twice {
template <std::size_t N>
std::vector<double> numbers(const Array<N>& a) {
    return {a.items, a.items + N};
}
}  // namespace twice

}  // namespace duolux::mirror

DUOLUX_MIRROR_TYPE(Bsdf, s.baseColor, s.metallic, s.roughness);
DUOLUX_MIRROR_TYPE(BsdfFrame, s.shading, s.geometric);
DUOLUX_MIRROR_TYPE(BsdfSample, s.wi, s.pdf, s.weight);
DUOLUX_MIRROR_TYPE(Triangle, s.v0, s.v1, s.v2, s.primitive, s.materialFlags);
DUOLUX_MIRROR_TYPE(SurfacePoint, s.position, s.geometricNormal, s.shadingNormal, s.triangle, s.behindOthers,
                   s.offset);
DUOLUX_MIRROR_TYPE(Segment, s.origin, s.direction, s.t, s.order);
DUOLUX_MIRROR_TYPE(Plane, s.normal, s.offset);
DUOLUX_MIRROR_TYPE(LightMatrix, s.m00, s.m01, s.m10, s.m11);
DUOLUX_MIRROR_TYPE(Light, s.invisible, s.visible);
DUOLUX_MIRROR_TYPE(Material, s.bsdf.baseColor, s.flags, s.bsdf.metallic, s.bsdf.roughness);
DUOLUX_MIRROR_TYPE(FilmSum, s.r, s.g, s.b);
DUOLUX_MIRROR_TYPE(Emitter, s.v0, s.flags, s.v1, s.positionError, s.v2, s.triangle, s.emission.invisible,
                   s.density, s.emission.visible);
DUOLUX_MIRROR_TYPE(AliasEntry, s.threshold, s.alias);
DUOLUX_MIRROR_TYPE(EmitterChoice, s.index, s.u);
DUOLUX_MIRROR_TYPE(EmitterPoint, s.position, s.normal, s.positionError);
DUOLUX_MIRROR_TYPE(EmittedRay, s.point, s.direction, s.flux);
DUOLUX_MIRROR_TYPE(EmitterSeen, s.point, s.intensity);
DUOLUX_MIRROR_TYPE(Gathered, s.light, s.lastBounce, s.previousBounce);
DUOLUX_MIRROR_TYPE(PixelSums, s.invisible, s.visible, s.nonFinite, s.clamped, s.cameraRays, s.bounceRays,
                   s.shadowRays, s.emitterRays, s.lastBounce, s.previousBounce);
DUOLUX_MIRROR_TYPE(PixelResult, s.invisible, s.visible, s.nonFinite, s.clamped, s.cameraRays, s.bounceRays,
                   s.shadowRays, s.emitterRays, s.lastBounce, s.previousBounce);
DUOLUX_MIRROR_TYPE(LaneResult, s.nonFinite, s.clamped, s.lightRays, s.bounceRays, s.shadowRays, s.lastBounce,
                   s.previousBounce, s.invisible, s.visible);

namespace duolux::mirror::single {

inline twice::Bsdf widen(const Bsdf& bsdf) {
    return {test::widen(bsdf.baseColor), test::widen(bsdf.metallic), test::widen(bsdf.roughness)};
}
inline twice::BsdfFrame widen(const BsdfFrame& f) {
    return {test::widen(f.shading), test::widen(f.geometric)};
}
inline twice::Triangle widen(const Triangle& t) {
    return {test::widen(t.v0), test::widen(t.v1), test::widen(t.v2), t.primitive, t.materialFlags};
}
inline twice::SurfacePoint widen(const SurfacePoint& p) {
    return {test::widen(p.position), test::widen(p.geometricNormal), test::widen(p.shadingNormal), p.triangle,
            p.behindOthers,          test::widen(p.offset)};
}
inline twice::LightMatrix widen(const LightMatrix& m) {
    return {test::widen(m.m00), test::widen(m.m01), test::widen(m.m10), test::widen(m.m11)};
}
inline twice::Light widen(const Light& l) {
    return {test::widen(l.invisible), test::widen(l.visible)};
}
inline twice::Material widen(const Material& m) {
    return {widen(m.bsdf), m.flags};
}
inline twice::FilmSum widen(const FilmSum& s) {
    return {s.r, s.g, s.b};
}
inline twice::Gathered widen(const Gathered& g) {
    return {widen(g.light), test::widen(g.lastBounce), test::widen(g.previousBounce)};
}
inline twice::PixelSums widen(const PixelSums& s) {
    return {widen(s.invisible),
            widen(s.visible),
            s.nonFinite,
            s.clamped,
            s.cameraRays,
            s.bounceRays,
            s.shadowRays,
            s.emitterRays,
            test::widen(s.lastBounce),
            test::widen(s.previousBounce)};
}

}  // namespace duolux::mirror::single
