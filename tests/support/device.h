#pragma once

#include <string>

#include "host/vk/device.h"

namespace duolux::test {

/// The one device of a test executable, opened when a test first asks for it: the one that the environment
/// variable DUOLUX_DEVICE chooses (default "cpu"), with validation on. Throws MachineError or UsageError if
/// there is none. In every executable that links duolux_test_device a test fails if there was any validation
/// message.
Device& device();

/// Closes it, if it is open: drivers may be gone when main() has ended. Done when GoogleTest's tests are.
void closeDevice();

/// What DUOLUX_DEVICE says.
std::string deviceSelector();

}  // namespace duolux::test
