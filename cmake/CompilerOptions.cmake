# Warnings for the project's own targets. System libraries are included as SYSTEM, without warnings.
add_library(duolux_warnings INTERFACE)
# GCC 12 reports overlaps and overflows in impossible cases of optimised std::string and std::vector code (GCC bugs
# 105651, 105762 and others). GCC 13 and 14 warn about every function that takes a temporary and returns a reference,
# whatever it refers to (GCC bug 107532 and others).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  if(CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    set(DUOLUX_FALSE_WARNINGS -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
  else()
    set(DUOLUX_FALSE_WARNINGS -Wno-dangling-reference)
  endif()
endif()
target_compile_options(duolux_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wcast-align -Woverloaded-virtual
  -Wdouble-promotion -Wimplicit-fallthrough -Werror=switch $<$<BOOL:${DUOLUX_WERROR}>:-Werror> ${DUOLUX_FALSE_WARNINGS})

# Assertions name files relative to the root, so the program does not reveal where it was built.
add_compile_options(-fmacro-prefix-map=${CMAKE_SOURCE_DIR}/=)

# CLI11 compiles its validators into every source that includes it. Command lines and most tests compute little, so low
# optimisation suffices for them in a release build.
add_library(duolux_quick INTERFACE)
target_compile_options(duolux_quick INTERFACE $<$<CONFIG:Release>:-O1>)

# For builds that compile several sources at once (CMAKE_UNITY_BUILD).
set(CMAKE_UNITY_BUILD_BATCH_SIZE 16)

# duolux_library(NAME SOURCES ... LINK ... [PRIVATE_LINK ...]): one library per folder of host/, with includes relative to
# the root.
function(duolux_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}>)
  target_link_libraries(${name} PUBLIC ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK} $<BUILD_INTERFACE:duolux_warnings>)
endfunction()
