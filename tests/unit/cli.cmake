duolux_test(cli_unit_test SOURCES cli_exit_status_test.cpp cli_progress_test.cpp LINK duolux_cli)
