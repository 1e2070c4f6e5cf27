duolux_test(app_test SOURCES app_tree_folder_test.cpp LINK duolux_options)
