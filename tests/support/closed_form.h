#pragma once

#include <cstdint>
#include <span>

#include "tests/reference/matrix2.h"
#include "tests/reference/tracer.h"

namespace duolux::test {

using reference::ChannelLight;
using reference::ChannelMatrix;
using reference::Vec3;

/// Radiance on the wall of a closed convex enclosure of uniform emission E whose walls scatter by S = albedo
/// O, cut off after `bounces` scattering events: sum over k = 0..bounces of S^k E. Its limit is (I - S)^-1 E.
ChannelLight enclosureRadiance(const ChannelMatrix& scatter, const ChannelLight& emission,
                               std::uint32_t bounces);

/// Integral of the cosine with `normal` over the solid angle of a plane convex polygon seen from `point`,
/// above the horizon: half the sum over its edges of their angle times the unit normal of the plane through
/// the edge and the point (J. H. Lambert, Photometria, 1760), after the polygon is clipped to the horizon.
double lambertPolygon(const Vec3& point, const Vec3& normal, std::span<const Vec3> polygon);

/// An image with the exact value `light` in all pixels.
reference::Estimates uniformImage(std::uint32_t width, std::uint32_t height, const ChannelLight& light);

/// A pixel with the exact value `light`.
reference::Estimate exactly(const ChannelLight& light);

}  // namespace duolux::test
