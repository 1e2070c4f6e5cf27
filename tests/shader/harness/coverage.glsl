// The functions that instrumented libraries call: two words for each point, see coverage.h.
#ifndef DUOLUX_TESTS_SHADER_HARNESS_COVERAGE_GLSL
#define DUOLUX_TESTS_SHADER_HARNESS_COVERAGE_GLSL

#include "tests/shader/harness/report_layout.h"

layout(binding = kBindingCoverage, scalar) buffer CoverageBlock { uint reached_[]; };

void coverFunction_(uint point) { reached_[2u * point] = 1u; }

bool coverCondition_(uint point, bool condition) {
    reached_[2u * point + (condition ? 1u : 0u)] = 1u;
    return condition;
}

#endif
