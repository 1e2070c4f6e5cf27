#pragma once

#include "tests/mutation/mutation.h"

namespace duolux::test {

/// Asks the shader tests about each: they compile the library when they run, so nothing is built.
void tryInLibrary(MutationList& list);

/// Asks the tests of the host and of what it renders about each, which takes a build: in a copy of the
/// project, which is kept for the next time.
void tryInProgram(MutationList& list);

}  // namespace duolux::test
