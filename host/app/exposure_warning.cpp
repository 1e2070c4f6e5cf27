#include "host/app/exposure_warning.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "host/app/info_json.h"
#include "host/view/darkness.h"

namespace duolux {

namespace {

constexpr double kLitPart = 0.01;
constexpr float kDarkestGrey = 1.0f / (255.0f * 12.92f);  // sRGB code 1 of 255, linear

/// A position as options take it: in the coordinates of the file.
std::string point(const Scene& scene, const glm::vec3& place) {
    const glm::dvec3 p = placeInFile(scene, place);
    return fmt::format("{},{},{}", p.x, p.y, p.z);
}

std::string describe(const Scene& scene, const DarkReason& reason) {
    const std::string position = "--camera-position " + point(scene, reason.better.position);
    const std::string lookAt = "--look-at " + point(scene, reason.better.target);
    switch (reason.darkness) {
        case Darkness::kNothingEmits:
            return "nothing emits light; --lamp adds a lamp";
        case Darkness::kLooksPast:
            return fmt::format(
                "the camera looks past the scene, or from too far away: it covers {:.1f} % of the picture; "
                "try {} {}",
                100.0f * reason.filled, position, lookAt);
        case Darkness::kOnlyEmitters:
            return "the camera sees only emitters, and they emit no visible light";
        case Darkness::kNoBounces:
            return "with 0 bounces only emitters are visible, and the surfaces in view emit no visible "
                   "light; try more --bounces";
        case Darkness::kNothingVisible:
            return "no reflectance turns the emitted light into visible light; this needs entries in the "
                   "second row of \"opaque\"";
        case Darkness::kBlackSurfaces:
            return fmt::format("the surfaces in view (material \"{}\") are black and reflect nothing",
                               reason.material);
        case Darkness::kBehind:
            return fmt::format(
                "the camera is behind a wall or inside of an object: it sees the unlit sides of surfaces "
                "(material \"{}\") whose other sides are lit; try {} {}",
                reason.material, position, lookAt);
        case Darkness::kFacingAway:
            return fmt::format(
                "the emitters (material \"{}\") face away from the surfaces in view: they emit from their "
                "front side, on which corners are counter-clockwise; turn them, set \"sides\": \"both\" in "
                "their emission in a JSON scene, or add --lamp",
                reason.material);
        case Darkness::kEnclosed:
            return fmt::format(
                "no light reaches what the camera sees (material \"{}\"): other surfaces block the light of "
                "the emitters; try --lamp, or {} {}",
                reason.material, position, lookAt);
        case Darkness::kMirrors:
            return fmt::format(
                "the surfaces in view (material \"{}\") are metal or glass, which shows only what it "
                "reflects "
                "or refracts, and that is dark; place emitters or bright surfaces around them",
                reason.material);
        case Darkness::kUnknown:
            break;
    }
    return addedLamp(scene).is_null() ? "little light reaches what the camera sees; try --lamp, or more --spp"
                                      : "little light reaches what the camera sees; try more --spp";
}

/// A histogram of the pixels' brightest channels, in half stops.
class Brightness {
  public:
    Brightness(const ImageRows& rows, glm::vec2 display)
        : pixels_(static_cast<double>(rows.width) * static_cast<double>(rows.height)) {
        std::vector<glm::vec3> invisible(rows.width), visible(rows.width);
        for (std::uint32_t row = 0; row < rows.height; ++row) {
            rows.read(row, invisible, visible);
            for (std::size_t i = 0; i < rows.width; ++i) {
                const glm::vec3 c = display.x * invisible[i] + display.y * visible[i];
                const float brightest = std::max({c.x, c.y, c.z});
                if (!(brightest > 0x1p-30f)) continue;
                const int bin = static_cast<int>(std::floor(2.0f * std::log2(brightest))) + kZero;
                ++counts_[static_cast<std::size_t>(std::clamp(bin, 0, kBins - 1))];
            }
        }
    }

    double pixels() const { return pixels_; }

    /// The number of pixels of at least 2^stops, rounded to half a stop.
    double above(float stops) const {
        const int first = static_cast<int>(std::ceil(2.0f * stops)) + kZero;
        double sum = 0.0;
        for (int bin = std::max(first, 0); bin < kBins; ++bin)
            sum += static_cast<double>(counts_[static_cast<std::size_t>(bin)]);
        return sum;
    }

    /// The largest value, in stops, that at least `wanted` pixels reach, rounded down to half a stop; empty
    /// if it is below -30.
    std::optional<float> reachedBy(double wanted) const {
        double reached = 0.0;
        for (int bin = kBins - 1; bin >= 0; --bin) {
            reached += static_cast<double>(counts_[static_cast<std::size_t>(bin)]);
            if (reached > 0.0 && reached >= wanted) return 0.5f * static_cast<float>(bin - kZero);
        }
        return std::nullopt;
    }

  private:
    static constexpr int kBins = 160, kZero = 60;
    std::array<std::uint64_t, kBins> counts_{};
    double pixels_;
};

std::string overexposureWarning(const Brightness& brightness, float exposure) {
    constexpr double kMost = 0.5, kFew = 0.2;  // of the pixels that are lit
    constexpr double kLeast = 0.05;            // of all pixels: a lamp alone may be as bright as it is
    const double lit = brightness.above(std::log2(kDarkestGrey) - exposure);
    const double clipped = brightness.above(-exposure);
    if (!(clipped > kMost * lit) || lit < kLeast * brightness.pixels()) return {};
    const std::optional<float> bright = brightness.reachedBy(kFew * lit);
    // Their half stop must end below white.
    return fmt::format(
        "{:.0f} % of what is lit in the picture is brighter than white and clipped; try --exposure {:g}",
        100.0 * clipped / lit, -(bright.value_or(0.0f) + 0.5f));
}

}  // namespace

std::string exposureWarning(const LoadedScene& scene, const ImageRows& rows, float exposure, bool clips) {
    const Brightness brightness(rows, scene.display);
    const std::optional<float> bright = brightness.reachedBy(kLitPart * brightness.pixels());
    if (bright && std::exp2(*bright + exposure) >= kDarkestGrey)
        return clips ? overexposureWarning(brightness, exposure) : std::string();
    const std::string dark = fmt::format("less than {:g} % of the picture is lit: ", 100.0 * kLitPart);
    if (bright) {
        return dark +
               fmt::format("all of it is very dark; try --exposure {:.0f}", std::ceil(-1.0f - *bright));
    }
    const DarkReason reason = whyDark(scene, scene.settings);
    const bool said = std::any_of(scene.warnings.begin(), scene.warnings.end(), [&](const Warning& warning) {
        return (reason.darkness == Darkness::kNothingEmits && warning.kind == WarningKind::kBlackPicture) ||
               (reason.darkness == Darkness::kFacingAway && warning.kind == WarningKind::kEmittersFaceAway);
    });
    if (said) return {};
    return dark + describe(scene, reason);
}

}  // namespace duolux
