#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace duolux {

/// The values of an enumeration that text names, in the order in which help and messages list them. Each such
/// enumeration specialises it as an array beside its `nameOf`.
template <typename E>
inline constexpr std::nullptr_t kValuesOf = nullptr;

/// The names of all values.
template <typename E>
std::vector<std::string> namesOfAll() {
    std::vector<std::string> names;
    for (const E value : kValuesOf<E>)
        names.emplace_back(nameOf(value));
    return names;
}

/// The value with this name, if any.
template <typename E>
std::optional<E> named(std::string_view name) {
    for (const E value : kValuesOf<E>) {
        if (name == nameOf(value)) return value;
    }
    return std::nullopt;
}

}  // namespace duolux
