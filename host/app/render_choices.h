#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/app/render_options.h"
#include "host/render/checkpoint.h"
#include "host/render/render.h"
#include "host/view/load.h"

namespace duolux {

// What the options of `duolux render` mean, once they are seen together and with the scene. All functions
// throw UsageError for combinations that the options' own checks cannot detect.

/// The scene's settings that the command line overrides.
struct Overrides {
    std::optional<Reflectance> reflectance;
    std::optional<glm::uvec2> size;
    std::optional<Sampler> sampler;
    std::optional<Integrator> integrator;
    std::optional<SampleRange> range;
    FilmLayerSet layers = 0;

    /// The choices on which loading the scene depends.
    SceneChoices choices(const RenderOptions& options) const;

    void applyTo(RenderSettings& settings, const RenderOptions& options) const;
};

Overrides parseOverrides(const RenderOptions& options);

DirectLight chooseDirectLight(const RenderOptions& options, const RenderSettings& settings);

/// Refuses layers that would not be filled, or not be kept by any of the outputs.
void requireUseOfLayers(const RenderOptions& options, const std::vector<std::string>& outputs,
                        const RenderSettings& settings);

/// Prevents a mistyped name of a checkpoint from replacing an image.
void requireNoOtherFile(const std::string& checkpoint);

/// The samples to trace: those of --sample-range (`range`), or of the checkpoint, or all. Warns of samples
/// beyond these that a checkpoint has; they are kept.
SampleRange chooseSamples(const RenderOptions& options, const std::optional<SampleRange>& range,
                          const std::optional<Checkpoint>& resumed, std::uint32_t spp);

/// Makes a render resume from a checkpoint, which must outlive it. Throws InputError if the checkpoint is of
/// another render.
void resumeFrom(const Checkpoint& resumed, const RenderOptions& options, const LoadedScene& scene,
                SampleRange samples, RenderControl& control);

}  // namespace duolux
