#include "host/app/film_images.h"

#include <fmt/format.h>

#include "host/base/stream.h"
#include "host/base/version.h"

namespace duolux {

ImageOptions filmImageOptions(const FilmOrigin& origin, const Film& film, float exposure) {
    const double pixels = static_cast<double>(film.width()) * film.height();
    const auto samples = static_cast<double>(film.totalSamples() + film.lightPaths());
    ImageOptions out;
    out.display = origin.display;
    out.exposure = exposure;
    // OpenEXR reserves the attributes "version", "type" and "name".
    out.metadata = {{"reflectance", origin.reflectance},
                    {"integrator", nameOf(origin.settings.integrator)},
                    {"spp", fmt::format("{:g}", samples / pixels)},
                    {"seed", fmt::format("{}", origin.settings.seed)},
                    {"bounces", fmt::format("{}", origin.settings.bounces)},
                    {"scene hash", origin.sceneHash},
                    {"Software", fmt::format("duolux {} ({})", versionString(), commitString())}};
    return out;
}

std::string describeOverflow(const Film& film) {
    return fmt::format(
        "some radiance exceeds the film's range and was clamped to {:.3g}, at least 2^28 times the mean of "
        "the first samples",
        film.largestRadiance());
}

void writeImages(WriteAll& write, const std::vector<std::string>& files, const ImageRows& rows,
                 const ImageOptions& options) {
    for (const bool pipes : {false, true}) {  // a pipe may wait for its reader
        for (const std::string& file : files) {
            if (isPipe(file) != pipes) continue;
            write(file, [&](const std::filesystem::path& path) { writeImage(path, rows, options); });
        }
    }
}

}  // namespace duolux
