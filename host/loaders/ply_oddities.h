#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "host/loaders/ply_header.h"

namespace duolux {

/// Errors that do not prevent a PLY file from being loaded.
enum class PlyOddity { kShortFace, kBadFace, kUnusedVertex, kNormal, kColour, kUv, kFaceUv, kCount };

/// What is odd about a PLY file, for one warning of each kind.
class PlyOddities {
  public:
    /// `place`: returns where the oddity is; called for the first of its kind only.
    template <typename Place>
    void count(PlyOddity oddity, const Place& place) {
        Found& found = found_[static_cast<std::size_t>(oddity)];
        if (found.count++ == 0) found.first = place();
    }

    /// A property that the loader does not read.
    void noteUnused(const PlyElement& element, const PlyProperty& property);

    /// Lines of a text that have more numbers than their element has properties.
    void countOverlongLines(std::uint64_t lines) { overlongLines_ = lines; }

    /// Adds the warnings, including those about the header alone: unknown elements and lines.
    void warn(const std::filesystem::path& path, const PlyHeader& header,
              std::vector<std::string>& warnings) const;

  private:
    struct Found {
        std::uint64_t count = 0;
        std::string first;  ///< its place
    };

    std::array<Found, static_cast<std::size_t>(PlyOddity::kCount)> found_;
    std::vector<std::string> unused_;  ///< properties
    std::uint64_t overlongLines_ = 0;
};

}  // namespace duolux
