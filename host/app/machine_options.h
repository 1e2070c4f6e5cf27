#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "host/vk/device.h"

namespace duolux {

// Options of several commands that choose what the program runs on, and the errors that this leads to.

/// Adds --device to a command. `device` must outlive it.
void addDeviceOption(CLI::App& command, std::string& device);

/// Adds --threads to a command; it takes effect when it is read.
void addThreadsOption(CLI::App& command);

/// The device that --device names. Throws as Device does, and says which environment variables choose
/// drivers where none can be loaded.
Device openDevice(const std::string& selector);

/// All devices, with the same errors.
std::vector<DeviceInfo> findDevices();

}  // namespace duolux
