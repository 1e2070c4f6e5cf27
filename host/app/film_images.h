#pragma once

#include <string>
#include <vector>

#include "host/film/image.h"
#include "host/render/checkpoint.h"

namespace duolux {

/// How images of a film are written: the display row, the exposure in stops, and metadata that say what was
/// rendered.
ImageOptions filmImageOptions(const FilmOrigin& origin, const Film& film, float exposure);

/// Writes all that can be written; then throws for the first that could not.
void writeImages(const std::vector<std::string>& files, const RadianceImage& image,
                 const ImageOptions& options);

}  // namespace duolux
