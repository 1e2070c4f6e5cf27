duolux_test(scene_test
  SOURCES scene_assets_test.cpp scene_energy_test.cpp scene_hash_test.cpp scene_json_test.cpp scene_lenient_test.cpp
          scene_many_test.cpp scene_materials_test.cpp scene_mtl_test.cpp scene_names_test.cpp scene_normals_test.cpp scene_obj_test.cpp scene_origin_test.cpp
          scene_transform_test.cpp scene_triangulate_test.cpp scene_two_spheres_test.cpp scene_files.cpp
  LINK duolux_view)
