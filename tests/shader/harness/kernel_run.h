#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "host/vk/kernel.h"

namespace duolux::test {

/// A larger dispatch could run longer than a driver's watchdog allows.
constexpr std::uint32_t kInvocationsPerDispatch = 1u << 20;

/// A kernel of the harness, with the given bindings and, if coverage is measured, the buffer of its counters.
Kernel harnessKernel(std::string_view name, std::span<const std::uint32_t> spirv,
                     std::vector<Binding> bindings, std::span<const Specialization> constants,
                     std::uint32_t pushConstantBytes);

/// Number of words that instrumented libraries write, see coverage.h; 0: coverage is not measured.
std::size_t& coverageWords();

/// Returns these words after all kernels, and releases their buffer.
std::vector<std::uint32_t> takeCoverage();

}  // namespace duolux::test
