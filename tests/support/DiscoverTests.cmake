# duolux_discover_tests(TARGET [FILTER ...] [TIMEOUT ...] [ENVIRONMENT ...]): adds each test suite of a GoogleTest program
# to CTest, as TARGET.SUITE. The tests of a suite share a process, because opening a device and compiling kernels takes
# longer than most tests. CTest asks the program for its suites whenever it runs.
# FILTER: as for --gtest_filter. TIMEOUT: seconds for a suite (600).
function(duolux_discover_tests target)
  cmake_parse_arguments(ARG "" "FILTER;TIMEOUT" "ENVIRONMENT" ${ARGN})
  if(NOT ARG_FILTER)
    set(ARG_FILTER *)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 600)
  endif()
  set(script ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
  file(GENERATE OUTPUT ${script} CONTENT "set(target ${target})
set(program \"$<TARGET_FILE:${target}>\")
set(filter \"${ARG_FILTER}\")
set(properties TIMEOUT ${ARG_TIMEOUT} ENVIRONMENT \"${ARG_ENVIRONMENT}\")
include(\"${CMAKE_CURRENT_FUNCTION_LIST_DIR}/AddSuites.cmake\")
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${script})
endfunction()
