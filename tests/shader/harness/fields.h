#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

// The fields of a structure, without a list of them.

namespace duolux::test {

/// A structure without constructors and bases. Members that are C arrays are not supported.
template <typename T>
concept Structure = std::is_aggregate_v<T> && std::is_class_v<T>;

namespace fields {

/// Stands for a value of any type; only for use in unevaluated expressions.
struct Anything {
    template <typename T>
    operator T() const;  // NOLINT(google-explicit-constructor,hicpp-explicit-conversions)
};

template <typename S, std::size_t... I>
constexpr bool takes(std::index_sequence<I...>) {
    return requires {
        S{(static_cast<void>(I), Anything{})...};
    };
}

/// A structure takes as many initialisers as it has fields, or fewer.
template <typename S, std::size_t N = 0>
constexpr std::size_t count() {
    if constexpr (takes<S>(std::make_index_sequence<N + 1>()))
        return count<S, N + 1>();
    else
        return N;
}

}  // namespace fields

/// References to the fields of a structure, in the order of their declaration; at most 22.
template <Structure S>
constexpr auto fieldsOf(const S& s) {
    constexpr std::size_t count = fields::count<S>();
    static_assert(count >= 1 && count <= 22);
    if constexpr (count == 1) {
        const auto& [a] = s;
        return std::tie(a);
    } else if constexpr (count == 2) {
        const auto& [a, b] = s;
        return std::tie(a, b);
    } else if constexpr (count == 3) {
        const auto& [a, b, c] = s;
        return std::tie(a, b, c);
    } else if constexpr (count == 4) {
        const auto& [a, b, c, d] = s;
        return std::tie(a, b, c, d);
    } else if constexpr (count == 5) {
        const auto& [a, b, c, d, e] = s;
        return std::tie(a, b, c, d, e);
    } else if constexpr (count == 6) {
        const auto& [a, b, c, d, e, f] = s;
        return std::tie(a, b, c, d, e, f);
    } else if constexpr (count == 7) {
        const auto& [a, b, c, d, e, f, g] = s;
        return std::tie(a, b, c, d, e, f, g);
    } else if constexpr (count == 8) {
        const auto& [a, b, c, d, e, f, g, h] = s;
        return std::tie(a, b, c, d, e, f, g, h);
    } else if constexpr (count == 9) {
        const auto& [a, b, c, d, e, f, g, h, i] = s;
        return std::tie(a, b, c, d, e, f, g, h, i);
    } else if constexpr (count == 10) {
        const auto& [a, b, c, d, e, f, g, h, i, j] = s;
        return std::tie(a, b, c, d, e, f, g, h, i, j);
    } else if constexpr (count == 11) {
        const auto& [a, b, c, d, e, f, g, h, i, j, k] = s;
        return std::tie(a, b, c, d, e, f, g, h, i, j, k);
    } else if constexpr (count == 12) {
        const auto& [a, b, c, d, e, f, g, h, i, j, k, l] = s;
        return std::tie(a, b, c, d, e, f, g, h, i, j, k, l);
    } else if constexpr (count == 13) {
        const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = s;
        return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m);
    } else if constexpr (count == 14) {
        const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = s;
        return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n);
    } else if constexpr (count == 15) {
        const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = s;
        return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o);
    } else if constexpr (count == 16) {
        const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = s;
        return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p);
    } else if constexpr (count == 17) {
        const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q] = s;
        return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q);
    } else if constexpr (count == 18) {
        const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r] = s;
        return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r);
    } else if constexpr (count == 19) {
        const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t_] = s;
        return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t_);
    } else if constexpr (count == 20) {
        const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t_, t] = s;
        return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t_, t);
    } else if constexpr (count == 21) {
        const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t_, t, u] = s;
        return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t_, t, u);
    } else {
        const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t_, t, u, v] = s;
        return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t_, t, u, v);
    }
}

}  // namespace duolux::test
