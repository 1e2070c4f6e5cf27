file(GLOB cases CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} malformed_*.cpp)
duolux_test(malformed_test
  SOURCES ${cases}
  LINK duolux_test_program)
target_compile_definitions(malformed_test PRIVATE DUOLUX_EXECUTABLE="$<TARGET_FILE:duolux>")
add_dependencies(malformed_test duolux)
