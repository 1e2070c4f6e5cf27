#pragma once

#include <string>

#include "host/film/image.h"
#include "host/scene/scene.h"

namespace duolux {

/// A line that says so and names the likely cause and its remedy where less than 1 % of a picture's pixels
/// are as bright as the darkest grey of a PNG; empty where the picture is fine.
std::string darkPictureWarning(const Scene& scene, const ImageRows& rows, float exposure);

}  // namespace duolux
