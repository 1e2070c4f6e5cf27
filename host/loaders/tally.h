#pragma once

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <string>

namespace duolux {

/// How a reader handles incorrect statements that are harmless or have only one plausible meaning.
enum class Reading {
    kLenient,  ///< reads them as other programs do, with one warning for each kind
    kStrict    ///< rejects them
};

/// How warnings name a kind of incorrect statement, and its consequence.
template <typename Kind>
struct OddityText {
    Kind kind;
    const char* what;
    const char* consequence;
};

/// What a warning about the first of `count` cases adds: " (and 2 more)"; empty if it is the only one.
inline std::string andMore(std::size_t count) {
    return count <= 1 ? std::string() : fmt::format(" (and {} more)", count - 1);
}

/// For each value of an enumeration (whose last value is kCount): the number of occurrences in a text, and
/// the offset of the first.
template <typename Kind>
class Tally {
  public:
    struct Entry {
        std::size_t count = 0;
        std::size_t first = 0;  ///< offset in the text
    };

    void add(Kind kind, std::size_t offset, std::size_t count = 1) {
        Entry& entry = entries_[static_cast<std::size_t>(kind)];
        if (entry.count == 0) entry.first = offset;
        entry.count += count;
    }

    /// Adds the tally of a later part of the text, which begins at `offset`.
    void append(const Tally& later, std::size_t offset) {
        for (std::size_t i = 0; i < entries_.size(); ++i) {
            if (entries_[i].count == 0) entries_[i].first = later.entries_[i].first + offset;
            entries_[i].count += later.entries_[i].count;
        }
    }

    const Entry& operator[](Kind kind) const { return entries_[static_cast<std::size_t>(kind)]; }

  private:
    std::array<Entry, static_cast<std::size_t>(Kind::kCount)> entries_;
};

}  // namespace duolux
