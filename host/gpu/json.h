#pragma once

#include <nlohmann/json.hpp>

#include "host/gpu/tuning.h"
#include "host/vk/device.h"

namespace duolux {

/// For reports: which device, by which driver, of which kind.
nlohmann::ordered_json toJson(const DeviceInfo& device);

/// All of a tuning.
nlohmann::ordered_json toJson(const Tuning& tuning);

}  // namespace duolux
