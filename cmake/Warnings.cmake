# Warnings for the project's own targets. Libraries from the system are included as SYSTEM and stay silent.
add_library(duolux_warnings INTERFACE)
# GCC 12 follows the optimised code of std::string and std::vector into cases that cannot occur, and reports overlaps
# and overflows there (GCC bugs 105651, 105762 and others); GCC 13 does not.
set(DUOLUX_GCC12_WARNINGS -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
target_compile_options(duolux_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wcast-align -Woverloaded-virtual
  -Wdouble-promotion -Wimplicit-fallthrough $<$<BOOL:${DUOLUX_WERROR}>:-Werror>
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:${DUOLUX_GCC12_WARNINGS}>)

# Assertions name files relative to the root: the program does not tell where it was built.
add_compile_options(-fmacro-prefix-map=${CMAKE_SOURCE_DIR}/=)

# duolux_library(NAME SOURCES ... LINK ...): one library per folder of host/, includes are relative to the root.
function(duolux_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC ${CMAKE_SOURCE_DIR})
  target_link_libraries(${name} PUBLIC ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK} duolux_warnings)
endfunction()
