#include "host/app/film_images.h"

#include <fmt/format.h>

#include <exception>

#include "host/base/error.h"
#include "host/base/version.h"

namespace duolux {

ImageOptions filmImageOptions(const FilmOrigin& origin, const Film& film, float exposure) {
    const double pixels = static_cast<double>(film.width()) * film.height();
    const auto samples = static_cast<double>(film.totalSamples() + film.lightPaths());
    ImageOptions out;
    out.display = origin.display;
    out.exposure = exposure;
    out.metadata = {{"reflectance", origin.reflectance},
                    {"integrator", origin.settings.integrator == Integrator::kLight ? "light" : "path"},
                    {"spp", fmt::format("{:g}", samples / pixels)},
                    {"seed", fmt::format("{}", origin.settings.seed)},
                    {"bounces", fmt::format("{}", origin.settings.bounces)},
                    {"scene hash", origin.sceneHash},
                    {"version", fmt::format("duolux {} ({})", versionString(), commitString())}};
    return out;
}

void writeImages(const std::vector<std::string>& files, const RadianceImage& image,
                 const ImageOptions& options) {
    std::exception_ptr failure;
    for (const std::string& file : files) {
        try {
            writeImage(file, image, options);
        } catch (const Error&) {
            if (!failure) failure = std::current_exception();
        }
    }
    if (failure) std::rethrow_exception(failure);
}

}  // namespace duolux
