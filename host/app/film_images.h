#pragma once

#include <string>
#include <vector>

#include "host/app/outputs.h"
#include "host/film/image.h"
#include "host/render/checkpoint.h"

namespace duolux {

/// How images of a film are written: the display row, the exposure in stops, and metadata that say what was
/// rendered.
ImageOptions filmImageOptions(const FilmOrigin& origin, const Film& film, float exposure);

/// Writes an image to each file.
void writeImages(WriteAll& write, const std::vector<std::string>& files, const ImageRows& rows,
                 const ImageOptions& options);

/// What to tell of a film that overflowed.
std::string describeOverflow(const Film& film);

}  // namespace duolux
