#pragma once

#include <cxxabi.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

// The structures of shaders/ as lists of their 4-byte words, read from the sources. Sentinels in these words
// test whether host and device agree on the offset of each field.

namespace duolux::test {

/// A word of a structure: its name in GLSL, as "camera.position.x" or "invisible[2]", and its place.
struct LayoutWord {
    std::string name;
    bool isFloat;
    std::size_t offset;  ///< in bytes, in scalar block layout
};

/// The words of a structure that a file in shaders/shared or shaders/lib declares. Throws std::runtime_error
/// if none does, or if it has a field of another type than numbers of 4 bytes, vectors of them, structures
/// and arrays of these.
std::vector<LayoutWord> layoutWords(std::string_view structure);

/// The name of a structure without its namespace.
template <typename S>
std::string structureName() {
    const std::unique_ptr<char, void (*)(void*)> name(
        abi::__cxa_demangle(typeid(S).name(), nullptr, nullptr, nullptr), std::free);
    const std::string_view full = name.get();
    return std::string(full.substr(full.rfind(':') + 1));
}

/// The words of the C++ structure, too: it has its fields in the order of their declaration, so that they are
/// where scalar block layout has them if they fill it. Throws std::runtime_error if they do not.
template <typename S>
std::vector<LayoutWord> layoutWords() {
    std::vector<LayoutWord> words = layoutWords(structureName<S>());
    if (words.size() * sizeof(std::uint32_t) != sizeof(S))
        throw std::runtime_error(structureName<S>() + " has another size in C++ than in GLSL");
    return words;
}

/// A value that no other word has; as a float it is between 1 and 2.
inline std::uint32_t sentinel(std::size_t structure, std::size_t word) {
    return 0x3f800001u + static_cast<std::uint32_t>(structure << 12 | word << 1);
}

/// Structures of which every word holds the sentinel of its number.
template <typename S>
std::vector<S> sentinels(std::size_t count) {
    const std::vector<LayoutWord> words = layoutWords<S>();
    std::vector<S> out(count);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t w = 0; w < words.size(); ++w) {
            const std::uint32_t value = sentinel(i, w);
            std::memcpy(reinterpret_cast<std::byte*>(&out[i]) + words[w].offset, &value, sizeof(value));
        }
    }
    return out;
}

}  // namespace duolux::test
