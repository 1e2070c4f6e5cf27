# Warnings for the project's own targets. Libraries from the system are included as SYSTEM and stay silent.
add_library(duolux_warnings INTERFACE)
target_compile_options(duolux_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wcast-align -Woverloaded-virtual
  -Wdouble-promotion -Wimplicit-fallthrough $<$<BOOL:${DUOLUX_WERROR}>:-Werror>
  # GCC 12 warns of overlapping copies inside std::string::insert and replace where there are none (GCC bug 105651).
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>)

# Assertions name files relative to the root: the program does not tell where it was built.
add_compile_options(-fmacro-prefix-map=${CMAKE_SOURCE_DIR}/=)

# duolux_library(NAME SOURCES ... LINK ...): one library per folder of host/, includes are relative to the root.
function(duolux_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC ${CMAKE_SOURCE_DIR})
  target_link_libraries(${name} PUBLIC ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK} duolux_warnings)
endfunction()
