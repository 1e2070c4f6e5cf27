#include <cstdlib>

// Linked into every test program: redirects its cache, and those of the programs it starts, to the build
// folder.
namespace {

[[maybe_unused]] const bool kMoved = ::setenv("XDG_CACHE_HOME", DUOLUX_TEST_CACHE, 1) == 0;

}  // namespace
