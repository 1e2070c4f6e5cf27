#pragma once

#include <string>
#include <vector>

#include "host/cli/outputs.h"
#include "host/film/image.h"
#include "host/render/checkpoint.h"

namespace duolux {

/// Options for writing images of a film: the display row, the exposure in stops, and metadata that describe
/// the render.
ImageOptions filmImageOptions(const FilmOrigin& origin, const Film& film, float exposure);

/// Writes an image to each file.
void writeImages(WriteAll& write, const std::vector<std::string>& files, const ImageRows& rows,
                 const ImageOptions& options);

/// The warning for a film that has overflowed.
std::string describeOverflow(const Film& film);

}  // namespace duolux
