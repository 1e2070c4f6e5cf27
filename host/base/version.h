#pragma once

namespace duolux {

/// Semantic version of the program, for example "0.1.0".
const char* versionString();

/// Abbreviated git commit the program was configured from, with "-dirty" if the tree had changes;
/// "unknown" when it was not built from a git checkout.
const char* commitString();

}  // namespace duolux
