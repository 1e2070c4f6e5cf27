#include <cstdlib>

// Linked into every test program: Mesa caches compiled shaders in the build folder, not in the user's.
namespace {

[[maybe_unused]] const bool kMoved = ::setenv("XDG_CACHE_HOME", DUOLUX_TEST_CACHE, 1) == 0;

}  // namespace
