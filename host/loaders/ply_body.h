#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "host/base/error.h"
#include "host/loaders/ply_header.h"

namespace duolux {

/// Reads the values of a PLY file in their order: element by element, item by item (a vertex or a face),
/// property by property. Throws InputError, which names the item, where the file ends too early.
class PlyBody {
  public:
    /// All arguments must outlive the object.
    PlyBody(const std::filesystem::path& path, std::string_view bytes, const PlyHeader& header);

    /// Begins an element. The rest of the file is long enough for its items if their lists are empty, so that
    /// memory for them may be reserved.
    void beginElement(const PlyElement& element);
    void beginItem();
    /// The next value of the item.
    double value(PlyType type) {
        return header_.format == PlyFormat::kAscii ? textValue() : binaryValue(type);
    }
    /// The length of the list that comes next. The rest of the file is long enough for it.
    std::size_t listLength(const PlyProperty& property);
    void skip(const PlyProperty& property);
    void endItem();
    void skipElement(const PlyElement& element);

    /// The number of items that are followed by further words on their line.
    std::uint64_t overlongItems() const { return overlongItems_; }

    std::string file() const { return path_.string(); }
    /// The current item, with its line in a text: "line 12 (vertex 3 of 8)". Takes time.
    std::string place() const;
    /// An error in the current item.
    InputError error(std::string_view problem, std::string_view remedy) const;

  private:
    double textValue();
    double binaryValue(PlyType type);
    std::size_t remaining() const { return bytes_.size() - at_; }
    [[noreturn]] void failTooShort() const;

    const std::filesystem::path& path_;
    std::string_view bytes_;
    const PlyHeader& header_;
    const PlyElement* element_ = nullptr;
    std::uint64_t item_ = 0;  ///< the current one; from 1
    std::uint64_t overlongItems_ = 0;
    std::size_t at_;  ///< offset of the next value
};

}  // namespace duolux
