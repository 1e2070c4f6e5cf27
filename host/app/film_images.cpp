#include "host/app/film_images.h"

#include <fmt/format.h>

#include "host/base/error.h"
#include "host/base/version.h"

namespace duolux {

ImageOptions filmImageOptions(const FilmOrigin& origin, const Film& film, float exposure) {
    const double pixels = static_cast<double>(film.width()) * film.height();
    const auto samples = static_cast<double>(film.totalSamples() + film.lightPaths());
    ImageOptions out;
    out.display = origin.display;
    out.exposure = exposure;
    // "version", "type" and "name" have a meaning of their own in OpenEXR.
    out.metadata = {{"reflectance", origin.reflectance},
                    {"integrator", nameOf(origin.settings.integrator)},
                    {"spp", fmt::format("{:g}", samples / pixels)},
                    {"seed", fmt::format("{}", origin.settings.seed)},
                    {"bounces", fmt::format("{}", origin.settings.bounces)},
                    {"scene hash", origin.sceneHash},
                    {"Software", fmt::format("duolux {} ({})", versionString(), commitString())}};
    return out;
}

void WriteAll::operator()(const std::function<void()>& step) {
    try {
        step();
    } catch (const Error&) {
        if (!failure_) failure_ = std::current_exception();
    }
}

void WriteAll::rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
}

void writeImages(WriteAll& write, const std::vector<std::string>& files, const RadianceImage& image,
                 const ImageOptions& options) {
    for (const std::string& file : files)
        write([&] { writeImage(file, image, options); });
}

}  // namespace duolux
