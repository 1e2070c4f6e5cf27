#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <limits>
#include <source_location>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "tests/shader/harness/census.h"
#include "tests/shader/harness/compiler.h"
#include "tests/shader/harness/shader_function.h"
#include "tests/shader/mirror/mirror.h"

namespace duolux::test {

/// The allowed difference from the exact result: the larger of `floor` and `ulps` units in the last place of
/// the exact result as a float.
struct Budget {
    double ulps;
    double floor;
};

/// Converts arguments of the functions in single precision to those of the functions in double precision.
/// DUOLUX_MIRROR_TYPE overloads it for a structure, by widenTo().
inline double widen(float x) {
    return static_cast<double>(x);
}
inline std::uint32_t widen(std::uint32_t x) {
    return x;
}
inline std::int32_t widen(std::int32_t x) {
    return x;
}
inline bool widen(bool x) {
    return x;
}
template <glm::length_t N>
glm::vec<N, double> widen(const glm::vec<N, float>& v) {
    return glm::vec<N, double>(v);
}
template <glm::length_t N>
glm::vec<N, std::uint32_t> widen(const glm::vec<N, std::uint32_t>& v) {
    return v;
}

/// A structure of which every field is the widened one of `s`.
template <Structure Wide, Structure S>
Wide widenTo(const S& s) {
    return std::apply([](const auto&... fields) { return Wide{widen(fields)...}; }, fieldsOf(s));
}

/// Size of a unit in the last place of a float of this magnitude.
inline double ulpOf(double x) {
    const float magnitude = static_cast<float>(std::min(std::abs(x), 3.4e38));
    return static_cast<double>(std::nextafter(magnitude, std::numeric_limits<float>::infinity())) -
           static_cast<double>(magnitude);
}

/// " (0.5, 1)" for the values of an argument, " ..." if its numbers are not known.
template <typename T>
std::string describeArgument(const T& argument) {
    if constexpr (requires { numbers(argument); }) {
        std::string out;
        for (const double x : numbers(argument))
            out += fmt::format("{}{:.9g}", out.empty() ? "" : ", ", x);
        return " (" + out + ")";
    } else {
        return " ...";
    }
}

/// Additional text for the report if the library was changed after the oracles were built.
inline std::string describeStaleMirror() {
    const auto built = std::filesystem::last_write_time("/proc/self/exe");
    for (const auto& entry : std::filesystem::directory_iterator(projectRoot() / "shaders/lib")) {
        if (entry.last_write_time() > built) {
            return fmt::format(
                "; {} is newer than this program, whose oracles are those of before: build it again",
                entry.path().filename().string());
        }
    }
    return "";
}

/// Fails the test unless the device's results are within the budget of both oracles: `single`, the library as
/// C++ in float, and `twice`, in double. The report has the worst number in units of the budget with its
/// arguments, and how many are beyond it. Each argument has one element per invocation.
template <typename Result, typename Single, typename Twice, typename... Arguments>
void expectWithinOracles(const std::source_location& place, std::string_view name,
                         const std::vector<Result>& device, const Budget& budget, Single single, Twice twice,
                         const std::vector<Arguments>&... arguments) {
    const auto compare = [&](std::string_view oracle, auto&& reference) {
        Census census(fmt::format("{} against C++ in {}, {:.3g} ulp or {:.3g}", name, oracle, budget.ulps,
                                  budget.floor),
                      place);
        for (std::size_t i = 0; i < device.size(); ++i) {
            const std::vector<double> actual = numbers(device[i]);
            const std::vector<double> expected = numbers(reference(i));
            ASSERT_EQ(actual.size(), expected.size());
            for (std::size_t c = 0; c < actual.size(); ++c) {
                census.add(i, c, actual[c], expected[c],
                           std::max(budget.ulps * ulpOf(expected[c]), budget.floor));
            }
        }
        testing::Test::RecordProperty(fmt::format("{}_{}", name, oracle),
                                      fmt::format("{:.3g} of the budget", census.worstRatio()));
        if (census.off() == 0) return;
        std::string inputs;
        ((inputs += describeArgument(arguments[census.worstInvocation()])), ...);
        census.note(fmt::format(", for{}{}", inputs, describeStaleMirror()));
    };
    compare("float", [&](std::size_t i) { return single(arguments[i]...); });
    compare("double", [&](std::size_t i) { return twice(widen(arguments[i])...); });
}

#define EXPECT_WITHIN_ORACLES(...) expectWithinOracles(std::source_location::current(), __VA_ARGS__)

/// The type of a function's result for the first elements of its arguments.
template <typename Function, typename... Arguments>
auto resultOf(Function f, const std::vector<Arguments>&... arguments) {
    return f(arguments.front()...);
}

}  // namespace duolux::test

/// Calls a function on the device through `library`, and compares it with both oracles. For use in namespace
/// duolux::test.
///     EXPECT_ORACLES(warp, cosineHemisphere, (Budget{2, 5e-7}), us);
#define EXPECT_ORACLES(library, function, budget, ...)                                        \
    do {                                                                                      \
        const auto single_ = [](const auto&... x) { return mirror::single::function(x...); }; \
        const auto twice_ = [](const auto&... x) { return mirror::twice::function(x...); };   \
        const auto device_ =                                                                  \
            (library).call<decltype(resultOf(single_, __VA_ARGS__))>(#function, __VA_ARGS__); \
        EXPECT_WITHIN_ORACLES(#function, device_, budget, single_, twice_, __VA_ARGS__);      \
    } while (false)
