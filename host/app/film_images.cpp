#include "host/app/film_images.h"

#include <fmt/format.h>

#include <new>

#include "host/app/options.h"
#include "host/base/memory.h"
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

std::string describeOverflow(const Film& film) {
    return fmt::format(
        "some light is brighter than the film holds and was clamped: its largest radiance is {:.3g}, at least "
        "2^28 times the mean of the picture at a first look",
        film.largestRadiance());
}

void WriteAll::operator()(const std::string& file, const std::function<void()>& step) {
    const auto fail = [&](const Error& error) {
        if (failure_) {
            warn(error.what());
        } else {
            failure_ = error;
        }
    };
    try {
        step();
    } catch (const Error& e) {
        fail(e);
    } catch (const std::bad_alloc&) {
        fail(outOfMemory(fmt::format("{}: cannot write", file), "expected a smaller --size, or more memory"));
    } catch (const std::exception& e) {
        fail(MachineError(fmt::format("{}: cannot write: {}", file, e.what())));
    }
}

void WriteAll::warnOfFirst() const {
    if (failure_) warn(failure_->what());
}

void WriteAll::rethrow() const {
    if (failure_) throw *failure_;
}

void writeImages(WriteAll& write, const std::vector<std::string>& files, const ImageRows& rows,
                 const ImageOptions& options) {
    for (const std::string& file : files)
        write(file, [&] { writeImage(file, rows, options); });
}

}  // namespace duolux
