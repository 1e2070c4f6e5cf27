duolux_test(bvh_test SOURCES bvh_sah_test.cpp bvh_test.cpp bvh_pairs_test.cpp LINK duolux_bvh duolux_generators duolux_view)
