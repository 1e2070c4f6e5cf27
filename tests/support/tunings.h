#pragma once

#include <string>
#include <vector>

#include "host/device_scene/tuning.h"

namespace duolux::test {

/// Every layout and kernel that a device supports.
inline std::vector<TuningChoice> allTunings(const DeviceInfo& device) {
    std::vector<TuningChoice> all;
    for (const Layout layout : {Layout::kTexel, Layout::kStorage}) {
        for (const KernelKind kernel : {KernelKind::kRefilling, KernelKind::kPlain})
            all.push_back({layout, kernel});
    }
    if (device.rayQueries) all.push_back({Layout::kRayQuery, KernelKind::kPlain});
    return all;
}

/// The name of one of allTunings, for messages.
inline std::string nameOf(const TuningChoice& choice) {
    return std::string(duolux::nameOf(*choice.layout)) + ", " + duolux::nameOf(*choice.kernel);
}

}  // namespace duolux::test
