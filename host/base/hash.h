#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <type_traits>

namespace duolux {

/// XXH3 of these bytes, for keys and tables: much faster than a Hasher for a few of them.
std::uint64_t hashOf(std::span<const std::byte> bytes);

/// XXH3 (Collet, 2019) of whatever is added. Detects accidental changes; not cryptographic.
class Hasher {
  public:
    Hasher();
    ~Hasher();

    void add(std::span<const std::byte> bytes);
    void add(std::string_view text) { add(std::as_bytes(std::span(text.data(), text.size()))); }

    /// Numbers. -0 counts as 0.
    template <typename T>
    requires std::is_arithmetic_v<T>
    void add(T value) {
        if constexpr (std::floating_point<T>) value += T{0};
        add(std::as_bytes(std::span(&value, 1)));
    }

    /// The items of an array, and how many there are. They must have no padding.
    template <typename T>
    void addArray(std::span<const T> items) {
        static_assert(std::is_trivially_copyable_v<T>);
        add(std::uint64_t{items.size()});
        add(std::as_bytes(items));
    }

    std::uint64_t digest() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace duolux
