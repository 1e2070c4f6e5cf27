#include <cstdlib>

// Linked into every test program: what it and the programs that it starts keep for later stays in the build.
namespace {

[[maybe_unused]] const bool kMoved = ::setenv("XDG_CACHE_HOME", DUOLUX_TEST_CACHE, 1) == 0;

}  // namespace
