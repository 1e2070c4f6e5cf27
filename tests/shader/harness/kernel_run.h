#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "host/vk/kernel.h"

namespace duolux::test {

/// A kernel of the harness: bound is what is asked for and, where coverage is measured, what it is counted
/// in.
Kernel harnessKernel(std::string_view name, std::span<const std::uint32_t> spirv,
                     std::vector<Binding> bindings, std::span<const Specialization> constants,
                     std::uint32_t pushConstantBytes);

/// Words that instrumented libraries write to, see coverage.h; 0: coverage is not measured.
std::size_t& coverageWords();

/// These words, as all kernels have left them; the buffer that held them is given up.
std::vector<std::uint32_t> takeCoverage();

}  // namespace duolux::test
