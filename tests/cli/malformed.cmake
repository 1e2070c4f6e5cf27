duolux_test(malformed_test
  SOURCES malformed_test.cpp malformed_meshes.cpp malformed_scenes.cpp malformed_options.cpp
  LINK duolux_test_program)
target_compile_definitions(malformed_test PRIVATE DUOLUX_EXECUTABLE="$<TARGET_FILE:duolux>")
add_dependencies(malformed_test duolux)
