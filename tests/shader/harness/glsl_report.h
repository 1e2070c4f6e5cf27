#pragma once

#include <span>
#include <string>
#include <vector>

#include "tests/shader/harness/glsl_file.h"
#include "tests/shader/harness/report_layout.h"

namespace duolux::test {

/// A failure at one line of a test file.
struct GlslFailure {
    std::size_t line;
    std::string message;
};

/// Reads the results of a test: `expectations`, one for each line of the file from line 0 (an included file);
/// `failedInvocations`, the number of invocations with failures. An expectation that no invocation reached is
/// also a failure.
std::vector<GlslFailure> readExpectations(const GlslFile& file, const GlslFile::Test& test,
                                          std::span<const shared::Expectation> expectations,
                                          std::size_t failedInvocations);

/// The values that NOTE has recorded for the requested invocation, by lines.
std::string readNotes(const GlslFile& file, std::span<const shared::Expectation> expectations);

}  // namespace duolux::test
