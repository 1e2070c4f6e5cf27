#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <map>
#include <source_location>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "tests/shader/harness/fields.h"

namespace duolux::test {

/// The numbers in a value; those of a structure in the order of its fields. Overload it, in the namespace of
/// a structure, where others are to be compared.
template <typename T>
requires std::is_arithmetic_v<T> std::vector<double> numbers(T x) {
    return {static_cast<double>(x)};
}
template <glm::length_t N, typename T>
std::vector<double> numbers(const glm::vec<N, T>& v) {
    std::vector<double> out;
    for (glm::length_t i = 0; i < N; ++i)
        out.push_back(static_cast<double>(v[i]));
    return out;
}
template <typename... Parts>
requires(sizeof...(Parts) > 1) std::vector<double> numbers(const Parts&... parts);
template <Structure S>
std::vector<double> numbers(const S& s) {
    return std::apply([](const auto&... fields) { return numbers(fields...); }, fieldsOf(s));
}
template <typename... Parts>
requires(sizeof...(Parts) > 1) std::vector<double> numbers(const Parts&... parts) {
    std::vector<double> out;
    const auto append = [&](const std::vector<double>& some) {
        out.insert(out.end(), some.begin(), some.end());
    };
    (append(numbers(parts)), ...);
    return out;
}

/// Compares the results of many invocations and reports once: how many differ, the first, the worst, and the
/// distribution of the differences. The test fails at `where` if any result differs or nothing was compared.
///
///     Census census("uniformFloat");
///     for (std::size_t i = 0; i < words.size(); ++i)
///         census.compare(i, results[i], expected(words[i]), 1e-7);
class Census {
  public:
    explicit Census(std::string what, const std::source_location& where = std::source_location::current())
        : what_(std::move(what)), where_(where) {}
    ~Census();
    Census(const Census&) = delete;
    Census& operator=(const Census&) = delete;

    /// Requires every number to be within `allowed`; 0: equal values. Two NaNs are equal.
    template <typename T, typename U>
    void compare(std::size_t invocation, const T& actual, const U& expected, double allowed = 0.0) {
        const std::vector<double> a = numbers(actual);
        const std::vector<double> e = numbers(expected);
        if (a.size() != e.size()) return addMismatch(invocation);
        for (std::size_t i = 0; i < a.size(); ++i)
            add(invocation, i, a[i], e[i], allowed);
    }

    /// One number of an invocation's result.
    void add(std::size_t invocation, std::size_t number, double actual, double expected, double allowed);

    std::size_t off() const { return off_; }
    std::size_t worstInvocation() const { return worst_.invocation; }
    double worstRatio() const { return worst_.ratio; }  ///< relative to `allowed`; infinite if that is 0

    /// Adds text to the report, for example the arguments of the worst invocation.
    void note(std::string text) { note_ = std::move(text); }

  private:
    struct Case {
        std::size_t invocation = 0, number = 0;
        double actual = 0.0, expected = 0.0, allowed = 0.0, ratio = -1.0;
    };
    void addMismatch(std::size_t invocation);
    static std::string describe(const Case& c);

    std::string what_, note_;
    std::source_location where_;
    std::size_t compared_ = 0, off_ = 0, invocationsOff_ = 0, lastOff_ = static_cast<std::size_t>(-1);
    Case first_, worst_;
    std::map<int, std::size_t> octaves_;  // binary exponents of the differences, relative to `allowed` or 1
};

}  // namespace duolux::test
