# duolux_discover_glsl_tests(TARGET FOLDER [further arguments of gtest_discover_tests]): adds the tests of a
# shader_test to CTest. CTest asks the program for its tests when it runs, and again if a test file of FOLDER
# has changed; nothing is rebuilt for this.
include(GoogleTest)
function(duolux_discover_glsl_tests target folder)
  set(script ${CMAKE_CURRENT_BINARY_DIR}/${target}_fresh.cmake)
  file(WRITE ${script} "file(GLOB lists \"${CMAKE_CURRENT_BINARY_DIR}/${target}*_tests.cmake\")
file(GLOB files \"${folder}/*_test.glsl\")
foreach(list IN LISTS lists)
  foreach(file IN LISTS files ITEMS \"${folder}\")
    if(EXISTS \"\${list}\" AND \"\${file}\" IS_NEWER_THAN \"\${list}\")
      file(REMOVE \"\${list}\")
    endif()
  endforeach()
endforeach()
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${script})
  gtest_discover_tests(${target} DISCOVERY_MODE PRE_TEST ${ARGN})
endfunction()
