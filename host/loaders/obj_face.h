#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "host/loaders/obj_complaints.h"
#include "host/loaders/obj_part.h"
#include "host/loaders/source_text.h"

namespace duolux {

/// Reads the faces of one part of an OBJ file.
class ObjFaceReader {
  public:
    ObjFaceReader(const char* end, const ObjPartTarget& target, ObjComplaints& complaints, ObjPart& part)
        : end_(end), target_(target), complaints_(complaints), part_(part) {}

    /// Reads a statement `f` that follows the statements `seen`. Faces with vertex indices out of range are
    /// left out, and the first of them is recorded.
    void read(const char* line, const char* arguments, const ObjCounts& seen);

  private:
    struct Index {
        std::string_view text;  ///< empty: absent
        std::int64_t value = 0;
    };

    Index readIndex(const char* at) const;
    const char* readCorner(const char* corner, const ObjCounts& seen);
    void addNormal(const char* corner, const Index& normal, const ObjCounts& seen);
    void addUv(const char* corner, const Index& uv, const ObjCounts& seen);
    void addOptional(std::optional<std::uint32_t> index, std::vector<std::uint32_t>& indices,
                     std::uint32_t none) const;
    void leaveOut(const char* line, std::size_t firstCorner);
    TextProblem notACorner(const char* corner) const;

    const char* end_;
    const ObjPartTarget& target_;
    ObjComplaints& complaints_;
    ObjPart& part_;
    std::optional<TextProblem> bad_;  ///< the problem of the current face
};

}  // namespace duolux
