duolux_test(scene_test
  SOURCES scene_energy_test.cpp scene_hash_test.cpp scene_image_plane_test.cpp scene_origin_test.cpp scene_transform_test.cpp scene_validate_test.cpp scene_files.cpp
  LINK duolux_view)
