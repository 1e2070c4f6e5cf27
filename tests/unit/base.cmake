duolux_test(base_test
  SOURCES base_file_test.cpp base_error_test.cpp base_nearest_name_test.cpp base_parallel_test.cpp base_printable_test.cpp base_process_test.cpp base_random_test.cpp base_utf8_test.cpp
  LINK duolux_base)
