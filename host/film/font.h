#pragma once

#include <span>

namespace duolux {

/// The TrueType file of DejaVu Sans, embedded so that the installed program needs no font of the system.
std::span<const unsigned char> fontFile();

}  // namespace duolux
