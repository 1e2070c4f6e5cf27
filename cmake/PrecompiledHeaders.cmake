# Precompiles headers that take long to compile. Sources still include the headers that they use. By default, ccache does
# not cache compilations with precompiled headers, so a build with ccache has none.
if("${CMAKE_CXX_COMPILER_LAUNCHER}" MATCHES ccache)
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()

# CLI11 compiles its validators into every source that includes it. Command lines and most tests compute little, so low
# optimisation suffices for them in a release build.
add_library(duolux_quick INTERFACE)
target_compile_options(duolux_quick INTERFACE $<$<CONFIG:Release>:-O1>)

# For the libraries, for those that call Vulkan, for the command lines, and for the tests.
set(DUOLUX_PRECOMPILED
  <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <optional> <span> <string> <string_view>
  <utility> <vector> <fmt/format.h> <glm/glm.hpp> <nlohmann/json.hpp>)
set(DUOLUX_PRECOMPILED_VULKAN <fmt/format.h> <vulkan/vulkan_raii.hpp>)
set(DUOLUX_PRECOMPILED_PROGRAM ${DUOLUX_PRECOMPILED} <CLI/CLI.hpp>)
set(DUOLUX_PRECOMPILED_TEST ${DUOLUX_PRECOMPILED} <gmock/gmock.h> <gtest/gtest.h>)
