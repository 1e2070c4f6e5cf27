#pragma once

#include "host/vk/device.h"

namespace duolux::test {

/// The one device of a test executable: chosen by the environment variable DUOLUX_DEVICE (default "cpu"),
/// with validation on. Every executable that links duolux_test_device fails at its end if there was any
/// validation message.
Device& device();

}  // namespace duolux::test
