#pragma once

#include <string>

#include "host/vk/device.h"

namespace duolux::test {

/// The device of a test executable, opened on first use: the environment variable DUOLUX_DEVICE selects it
/// (default "cpu"), and validation is on. Throws MachineError or UsageError if there is none. In every
/// executable that links duolux_test_device, a test fails if there are any validation messages.
Device& device();

/// Closes the device if it is open, because drivers may be unloaded after main() has returned. Called at the
/// end of GoogleTest's tests.
void closeDevice();

/// The value of DUOLUX_DEVICE.
std::string deviceSelector();

}  // namespace duolux::test
