# Installed with the library; finds its dependencies.
include(CMakeFindDependencyMacro)
foreach(package Threads Vulkan glm fmt nlohmann_json draco meshoptimizer OpenEXR PNG JPEG)
  find_dependency(${package})
endforeach()
include(${CMAKE_CURRENT_LIST_DIR}/duoluxTargets.cmake)
