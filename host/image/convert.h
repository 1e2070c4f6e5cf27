#pragma once

#include "host/scene/image_conversion.h"
#include "host/scene/texture.h"

namespace duolux {

/// The height of white over black in a bump map, as a fraction of the length of a unit of texture
/// coordinates. The MTL format does not state it; this is usual for images of bricks, bark or cloth.
inline constexpr float kBumpHeight = 0.02f;

/// Converts a decoded image.
///
/// Heights h(u, v) from 0 to 1, v down the image, become the normal along (-s dh/du, s dh/dv, 1) in tangent
/// space, s = kBumpHeight (Blinn, "Simulation of Wrinkled Surfaces", SIGGRAPH 1978, for a surface whose
/// coordinates are perpendicular and equally long), encoded as n / 2 + 1 / 2 in floats. Derivatives are
/// differences of the two neighbours of a pixel; those of pixels at an edge that is not repeated, of the
/// pixel and its only neighbour. An image that already holds normals, as some programs write under the name
/// of bump maps (hasNormals), stays as it is.
///
/// Exponents n become roughness (2 / (n + 2))^(1/4), as roughnessOfExponent().
void convert(Image& image, const ImageConversion& conversion);

/// Whether the pixels of a coloured image are nearly all unit vectors above the surface, encoded as normals.
bool hasNormals(const Image& image);

}  // namespace duolux
