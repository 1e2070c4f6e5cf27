# Warnings for the project's own targets. Libraries from the system are included as SYSTEM and stay silent.
add_library(duolux_warnings INTERFACE)
# GCC 12 follows the optimised code of std::string and std::vector into cases that cannot occur, and reports overlaps
# and overflows there (GCC bugs 105651, 105762 and others). GCC 13 and 14 suspect every function that takes a temporary
# and returns a reference, whatever it refers to (GCC bug 107532 and others).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  if(CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    set(DUOLUX_FALSE_WARNINGS -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
  else()
    set(DUOLUX_FALSE_WARNINGS -Wno-dangling-reference)
  endif()
endif()
target_compile_options(duolux_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wcast-align -Woverloaded-virtual
  -Wdouble-promotion -Wimplicit-fallthrough $<$<BOOL:${DUOLUX_WERROR}>:-Werror> ${DUOLUX_FALSE_WARNINGS})

# Assertions name files relative to the root: the program does not tell where it was built.
add_compile_options(-fmacro-prefix-map=${CMAKE_SOURCE_DIR}/=)

# duolux_library(NAME SOURCES ... LINK ... [PRECOMPILE ...]): one library per folder of host/, includes are relative to the
# root. PRECOMPILE: its precompiled headers, if not those of duolux_base.
function(duolux_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;PRIVATE_LINK;PRECOMPILE" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}>)
  target_link_libraries(${name} PUBLIC ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK} $<BUILD_INTERFACE:duolux_warnings>)
  if(ARG_PRECOMPILE)
    target_precompile_headers(${name} PRIVATE ${ARG_PRECOMPILE})
  else()
    target_precompile_headers(${name} REUSE_FROM duolux_base)
  endif()
endfunction()
