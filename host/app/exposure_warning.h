#pragma once

#include <string>

#include "host/film/image.h"
#include "host/scene/scene.h"

namespace duolux {

/// A warning with the likely cause and its remedy if less than 1 % of an image's pixels are as bright as the
/// darkest grey of a PNG; empty otherwise.
std::string darkPictureWarning(const Scene& scene, const ImageRows& rows, float exposure);

}  // namespace duolux
