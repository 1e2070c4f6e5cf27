#pragma once

#include <string>

#include "host/film/image.h"
#include "host/scene/scene.h"

namespace duolux {

/// A warning with the likely cause and its remedy if less than 1 % of an image's pixels are as bright as the
/// darkest grey of a PNG; with the remedy if `clips` and most of the pixels that are lit exceed the range of
/// a PNG; empty otherwise.
std::string exposureWarning(const LoadedScene& scene, const ImageRows& rows, float exposure, bool clips);

}  // namespace duolux
