# CTest includes this for each test program; see DiscoverTests.cmake, which sets `target`, `program`, `filter` and
# `properties`.
set(list "")
set(status "it is not built")
if(EXISTS "${program}")
  execute_process(COMMAND "${program}" "--gtest_filter=${filter}" --gtest_list_tests OUTPUT_VARIABLE list RESULT_VARIABLE status)
endif()
if(NOT status STREQUAL "0")
  message(WARNING "${program} does not list its tests: ${status}")
  add_test(${target}.NOT_LISTED "${program}")  # fails, too
  return()
endif()
# One suite a line, at its beginning; names of parameters may hold what separates CMake's lists.
string(REGEX REPLACE "[][;]" "" list "${list}")
string(REPLACE "\n" ";" list "${list}")
foreach(line IN LISTS list)
  if(line MATCHES "^([A-Za-z0-9_/]+)\\.( |$)")
    set(suite ${CMAKE_MATCH_1})
    add_test(${target}.${suite} "${program}" "--gtest_filter=${suite}.*")
    set_tests_properties(${target}.${suite} PROPERTIES ${properties})
  endif()
endforeach()
