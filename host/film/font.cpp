#include "host/film/font.h"

// The assembler includes the file: a C++ array of 760,000 numbers would take seconds to compile.
// DUOLUX_FONT_FILE is set by CMake.
asm(".pushsection .rodata\n"
    ".balign 16\n"
    "kFontBegin:\n"
    ".incbin \"" DUOLUX_FONT_FILE
    "\"\n"
    "kFontEnd:\n"
    ".popsection\n");

namespace duolux {

namespace {
extern "C" const unsigned char kFontBegin[];
extern "C" const unsigned char kFontEnd[];
}  // namespace

std::span<const unsigned char> fontFile() {
    return {kFontBegin, kFontEnd};
}

}  // namespace duolux
