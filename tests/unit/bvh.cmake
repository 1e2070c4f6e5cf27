duolux_test(bvh_test SOURCES bvh_test.cpp LINK duolux_bvh)
