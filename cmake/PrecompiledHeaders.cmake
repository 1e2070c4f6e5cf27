# Headers that take long to compile, compiled once for many sources. Sources include what they use all the same. ccache
# does not store what is compiled with precompiled headers unless it is configured to, so a build with ccache has none.
if("${CMAKE_CXX_COMPILER_LAUNCHER}" MATCHES ccache)
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()

# CLI11 compiles its validators into every source that includes it. Command lines and most tests do not compute, so that
# little optimisation suffices for them, whatever the build type asks for.
add_library(duolux_quick INTERFACE)
target_compile_options(duolux_quick INTERFACE $<$<CONFIG:Release>:-O1>)

# Of the libraries, of those that call Vulkan, of the command lines, and of the tests.
set(DUOLUX_PRECOMPILED
  <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <optional> <span> <string> <string_view>
  <utility> <vector> <fmt/format.h> <glm/glm.hpp> <nlohmann/json.hpp>)
set(DUOLUX_PRECOMPILED_VULKAN <fmt/format.h> <vulkan/vulkan_raii.hpp>)
set(DUOLUX_PRECOMPILED_PROGRAM ${DUOLUX_PRECOMPILED} <CLI/CLI.hpp>)
set(DUOLUX_PRECOMPILED_TEST ${DUOLUX_PRECOMPILED} <gmock/gmock.h> <gtest/gtest.h>)
