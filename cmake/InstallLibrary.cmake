# Installs the library as a package: `find_package(duolux)` provides the target duolux::duolux, <duolux.h> and the headers
# that it includes.
set(DUOLUX_INCLUDES ${CMAKE_INSTALL_INCLUDEDIR}/duolux)
set(DUOLUX_PACKAGE ${CMAKE_INSTALL_LIBDIR}/cmake/duolux)

# duolux_install_library(FOLDER...): installs the libraries of these folders of host/ and of the shaders, and the public
# headers.
function(duolux_install_library)
  add_library(duolux_all INTERFACE)
  set_target_properties(duolux_all PROPERTIES EXPORT_NAME duolux)
  target_compile_features(duolux_all INTERFACE cxx_std_20)
  list(TRANSFORM ARGN PREPEND duolux_ OUTPUT_VARIABLE libraries)
  target_link_libraries(duolux_all INTERFACE ${libraries})
  install(TARGETS duolux_all duolux_shaders ${libraries} EXPORT duolux
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} INCLUDES DESTINATION ${DUOLUX_INCLUDES})
  install(EXPORT duolux NAMESPACE duolux:: FILE duoluxTargets.cmake DESTINATION ${DUOLUX_PACKAGE})
  install(CODE "
    set(SOURCE \"${CMAKE_SOURCE_DIR}\")
    set(DESTINATION \"\${CMAKE_INSTALL_PREFIX}/${DUOLUX_INCLUDES}\")
    include(\"${CMAKE_SOURCE_DIR}/cmake/InstallHeaders.cmake\")")
  include(CMakePackageConfigHelpers)
  write_basic_package_version_file(${CMAKE_BINARY_DIR}/duoluxConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${CMAKE_SOURCE_DIR}/cmake/duoluxConfig.cmake ${CMAKE_BINARY_DIR}/duoluxConfigVersion.cmake
    DESTINATION ${DUOLUX_PACKAGE})
endfunction()
