#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/base/error.h"
#include "host/film/image.h"
#include "host/render/checkpoint.h"

namespace duolux {

/// How images of a film are written: the display row, the exposure in stops, and metadata that say what was
/// rendered.
ImageOptions filmImageOptions(const FilmOrigin& origin, const Film& film, float exposure);

/// Writes every file though some cannot be written, for whatever reason: warns of those, but for the first,
/// which rethrow() tells in the end.
class WriteAll {
  public:
    /// `step` writes `file`.
    void operator()(const std::string& file, const std::function<void()>& step);
    bool failed() const { return failure_.has_value(); }
    void warnOfFirst() const;  ///< in place of rethrow(), where something else is to be thrown
    void rethrow() const;

  private:
    std::optional<Error> failure_;
};

/// A step for each file.
void writeImages(WriteAll& write, const std::vector<std::string>& files, const ImageRows& rows,
                 const ImageOptions& options);

/// What to tell of a film that overflowed.
std::string describeOverflow(const Film& film);

}  // namespace duolux
