#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "host/view/load.h"

namespace duolux {

/// The options for camera and lamp, as given on the command line.
struct ViewOptions {
    std::string lookAt, position, up;
    std::optional<float> vfov;
    bool lamp = false, noLamp = false;

    /// The choices of camera and lamp only. Throws UsageError.
    SceneChoices choices() const;
};

void addViewOptions(CLI::App& command, ViewOptions& options);

}  // namespace duolux
