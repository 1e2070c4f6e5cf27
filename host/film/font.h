#pragma once

#include <span>

namespace duolux {

/// The TrueType file of DejaVu Sans, embedded so that the installed program needs no system font.
std::span<const unsigned char> fontFile();

}  // namespace duolux
