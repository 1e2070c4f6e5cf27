duolux_test(loaders_test
  SOURCES loaders_assets_test.cpp loaders_json_test.cpp loaders_lenient_test.cpp loaders_many_test.cpp
          loaders_materials_test.cpp loaders_mtl_test.cpp loaders_normals_test.cpp loaders_obj_test.cpp loaders_ply_errors_test.cpp loaders_ply_test.cpp
          loaders_source_text_test.cpp loaders_triangulate_test.cpp scene_files.cpp
  LINK duolux_view)
