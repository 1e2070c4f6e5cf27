#pragma once

#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "host/film/image.h"
#include "host/render/checkpoint.h"

namespace duolux {

/// How images of a film are written: the display row, the exposure in stops, and metadata that say what was
/// rendered.
ImageOptions filmImageOptions(const FilmOrigin& origin, const Film& film, float exposure);

/// Carries out every step though some fail, and throws for the first that did in the end.
class WriteAll {
  public:
    void operator()(const std::function<void()>& step);
    void rethrow() const;

  private:
    std::exception_ptr failure_;
};

/// A step for each file.
void writeImages(WriteAll& write, const std::vector<std::string>& files, const RadianceImage& image,
                 const ImageOptions& options);

/// What to tell of a film that overflowed.
inline constexpr const char* kFilmOverflowed =
    "some pixels are brighter than the film can hold and were clamped; does the light grow with every "
    "bounce?";

}  // namespace duolux
