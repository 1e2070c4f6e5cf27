#pragma once

#include <span>
#include <string>
#include <vector>

#include "tests/shader/harness/glsl_file.h"
#include "tests/shader/harness/report_layout.h"

namespace duolux::test {

/// What is wrong at one line of a test file.
struct GlslFailure {
    std::size_t line;
    std::string message;
};

/// Reads what a test wrote: `expectations`, one a line of the file from line 0 (an included file);
/// `failedInvocations`, how many failed anything. An expectation within the test that no invocation reached
/// is a failure, too.
std::vector<GlslFailure> readExpectations(const GlslFile& file, const GlslFile::Test& test,
                                          std::span<const shared::Expectation> expectations,
                                          std::size_t failedInvocations);

/// What NOTE has shown of the invocation that was asked for, by lines; empty if nothing.
std::string readNotes(const GlslFile& file, std::span<const shared::Expectation> expectations);

}  // namespace duolux::test
