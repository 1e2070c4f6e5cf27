duolux_test(app_test SOURCES app_exit_status_test.cpp app_progress_test.cpp LINK duolux_options)
