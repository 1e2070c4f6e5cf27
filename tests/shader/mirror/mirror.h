#pragma once

// The shader library as C++ through GLM, from the same source: duolux::mirror::single has its functions in
// float, duolux::mirror::twice in double. The first shows whether a device computes the same as C++, the
// second shows the rounding errors of the library. Neither shows that the library is correct.

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/integer.hpp>
#include <span>
#include <vector>

namespace duolux::mirror {

/// v->*swizzle::zw is v.zw.
namespace swizzle {
template <int... Components>
struct Swizzle {};
inline constexpr Swizzle<0, 1> xy;
inline constexpr Swizzle<1, 0> yx;
inline constexpr Swizzle<2, 3> zw;
inline constexpr Swizzle<0, 1, 2> xyz;
inline constexpr Swizzle<1, 2, 3> yzw;
inline constexpr Swizzle<1, 2, 0> yzx;
inline constexpr Swizzle<2, 0, 1> zxy;

template <glm::length_t N, typename T, int... Components>
glm::vec<sizeof...(Components), T> operator->*(const glm::vec<N, T>& v, Swizzle<Components...>) {
    return glm::vec<sizeof...(Components), T>(v[Components]...);
}
}  // namespace swizzle

/// uint[N].
template <std::size_t N>
struct Array {
    std::uint32_t items[N];
    template <std::integral... Items>
    explicit(false) Array(Items... values) : items{values...} {}
    std::uint32_t& operator[](std::size_t i) { return items[i]; }
    std::uint32_t operator[](std::size_t i) const { return items[i]; }

    friend std::vector<double> numbers(const Array& a) { return {a.items, a.items + N}; }
    friend Array widen(const Array& a) { return a; }
};

/// The contents of the kernels' texel buffers. The library reads a scene only through the functions that
/// fetch from them.
struct Texels {
    std::vector<glm::uvec4> nodes, pairs, planes, normals, colours, materials, emitters, albedo;
    std::vector<glm::uvec4> textures, atlas, corners, vertices, secondUvs;
};
inline Texels& texels() {
    static Texels instance;
    return instance;
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"  // BSDFs have parameters that others need

namespace single {
using real = float;
#include "tests/shader/mirror/library.inc"
}  // namespace single

namespace twice {
using real = double;
#include "tests/shader/mirror/library.inc"
}  // namespace twice

#pragma GCC diagnostic pop

}  // namespace duolux::mirror
