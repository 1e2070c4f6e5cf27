#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/app/tuning_options.h"
#include "host/app/view_options.h"

namespace duolux {

/// What `duolux render` was asked for, as text where only the scene gives it a meaning.
struct RenderOptions {
    std::string scene;
    std::vector<std::string> outputs;
    std::string preset, blend, size, sampler, integrator, directLight, device, report, sampleRange,
        checkpoint, resume, aov;
    std::optional<std::uint32_t> spp, bounces, seed;
    std::optional<double> timeLimit;
    TuningOptions tuning;
    ViewOptions view;
    float exposure = 0.0f;
    bool quiet = false;
    bool strict = false;
};

/// `options` must outlive the command.
void addRenderOptions(CLI::App& command, RenderOptions& options);

/// `-o a.png a.exr`: after -o, words that are neither options nor the scene are further images.
void sortWords(const CLI::App& command, RenderOptions& options);

}  // namespace duolux
