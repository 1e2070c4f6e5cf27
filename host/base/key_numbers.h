#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "host/base/hash.h"

namespace duolux {

/// Numbers distinct keys from 0 on, in the order of their first use: a hash table with open addressing. Keys
/// are equal if their bytes are; they must have no padding.
template <typename Key>
class KeyNumbers {
  public:
    static_assert(std::has_unique_object_representations_v<Key>);

    /// `expected`: about the number of distinct keys.
    explicit KeyNumbers(std::size_t expected = 0)
        : slots_(std::bit_ceil(2 * expected + kFewest), kEmpty), mask_(slots_.size() - 1) {}

    /// The number of a key, which may be new.
    std::uint32_t numberOf(const Key& key) {
        const std::size_t slot = slotOf(key);
        if (slots_[slot] != kEmpty) return slots_[slot];
        const auto number = static_cast<std::uint32_t>(keys_.size());
        slots_[slot] = number;
        keys_.push_back(key);
        if (2 * keys_.size() > slots_.size()) grow();
        return number;
    }

    /// That of a key which may be missing.
    std::optional<std::uint32_t> find(const Key& key) const {
        const std::uint32_t number = slots_[slotOf(key)];
        return number == kEmpty ? std::nullopt : std::optional(number);
    }

    std::span<const Key> keys() const { return keys_; }

  private:
    static constexpr std::uint32_t kEmpty = 0xffffffffu;
    static constexpr std::size_t kFewest = 16;

    /// The slot of a key, or the empty one in which it belongs.
    std::size_t slotOf(const Key& key) const {
        std::size_t slot = hashOf(std::as_bytes(std::span(&key, 1))) & mask_;
        while (slots_[slot] != kEmpty && std::memcmp(&keys_[slots_[slot]], &key, sizeof key) != 0)
            slot = (slot + 1) & mask_;
        return slot;
    }

    void grow() {
        slots_.assign(2 * slots_.size(), kEmpty);
        mask_ = slots_.size() - 1;
        for (std::uint32_t i = 0; i < keys_.size(); ++i)
            slots_[slotOf(keys_[i])] = i;
    }

    std::vector<Key> keys_;
    std::vector<std::uint32_t> slots_;  ///< numbers
    std::size_t mask_;
};

}  // namespace duolux
