#pragma once

#include <string>

namespace duolux {

/// The system's name for the processor.
std::string processorName();

}  // namespace duolux
