#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "host/vk/device.h"

namespace duolux {

// Options of several commands that choose the device and the number of threads, and the resulting errors.

/// Adds --device to a command. `device` must outlive it.
void addDeviceOption(CLI::App& command, std::string& device);

/// Adds --threads to a command; it takes effect when it is parsed.
void addThreadsOption(CLI::App& command);

/// Opens the device that --device selects. Throws as Device does; if no driver can be loaded, the message
/// also lists the environment variables that select drivers.
Device openDevice(const std::string& selector);

/// All devices; the same errors.
std::vector<DeviceInfo> findDevices();

}  // namespace duolux
