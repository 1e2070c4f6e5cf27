#pragma once

#include <nlohmann/json.hpp>

#include "host/device_scene/tuning.h"
#include "host/vk/device_info.h"

namespace duolux {

/// Name, driver and kind of a device, for reports.
nlohmann::ordered_json toJson(const DeviceInfo& device);

/// All values of a tuning, for reports.
nlohmann::ordered_json toJson(const Tuning& tuning);

}  // namespace duolux
