duolux_test(malformed_test
  SOURCES malformed_test.cpp malformed_meshes.cpp malformed_scenes.cpp malformed_options.cpp run_program.cpp)
target_include_directories(malformed_test PRIVATE ${CMAKE_SOURCE_DIR})
target_compile_definitions(malformed_test PRIVATE DUOLUX_EXECUTABLE="$<TARGET_FILE:duolux>")
add_dependencies(malformed_test duolux)
