duolux_test(view_test
  SOURCES view_bounces_test.cpp view_camera_test.cpp view_emitters_test.cpp view_inside_test.cpp view_lamp_test.cpp view_surface_test.cpp scene_files.cpp
  LINK duolux_view duolux_test_support)
