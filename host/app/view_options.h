#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "host/view/load.h"

namespace duolux {

/// The options of camera and lamp, as they are written.
struct ViewOptions {
    std::string lookAt, position, up;
    std::optional<float> vfov;
    bool lamp = false, noLamp = false;

    /// Camera and lamp only. Throws UsageError.
    SceneChoices choices() const;
};

void addViewOptions(CLI::App& command, ViewOptions& options);

}  // namespace duolux
