#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/scene/source_text.h"

namespace duolux {

/// How many of each statement an OBJ text holds.
struct ObjCounts {
    std::size_t vertices = 0, textureCoordinates = 0, normals = 0, faces = 0;

    ObjCounts& operator+=(const ObjCounts& other);
};

/// What the check notes beyond correctness, for the statements that matter to a loader of whole scenes.
struct ObjNotes {
    struct Smoothing {
        std::size_t face;     ///< first face it holds for, counted within the part of the text
        std::uint32_t group;  ///< 0: off
    };
    struct Library {
        std::size_t offset;
        std::string files;  ///< the rest of the mtllib line
    };
    std::vector<Smoothing> smoothing;
    std::vector<Library> libraries;
    std::size_t ignored = 0;       ///< statements of unknown or unsupported keywords
    std::size_t firstIgnored = 0;  ///< offset of the first of them
};

/// A quick count: only the first letters of each line are looked at. `text` is made of whole lines.
ObjCounts countStatements(std::string_view text);

/// Checks whole lines of an OBJ file so strictly that a lax parser can only read them one way: keywords,
/// numbers, number of arguments, and every index of a face against `total`, the statements of the whole file
/// (`before` are those ahead of this part, for relative indices). Comments behind numbers are blanked out.
/// Offsets in the result and in `notes` are relative to the part. Returns the first problem.
std::optional<TextProblem> checkStatements(std::span<char> text, const ObjCounts& before,
                                           const ObjCounts& total, ObjNotes& notes);

}  // namespace duolux
