#pragma once

#include "tests/mutation/mutation.h"

namespace duolux::test {

/// Runs the shader tests for each mutation; they compile the library at run time, so nothing is built.
void tryInLibrary(MutationList& list);

/// Builds each mutation in a copy of the project, which is kept for the next run, and runs the tests of the
/// host and of its renders.
void tryInProgram(MutationList& list);

}  // namespace duolux::test
