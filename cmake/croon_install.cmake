# The package: find_package(croon) gives croon::croon and what it consists of; the component `program` gives
# croon_add_program, for which the package has the rest. docs/library.md shows both. What is run, not compiled against, is in
# the install component `runtime`, of which croon_package.cmake makes a .deb.
include(CMakePackageConfigHelpers)

set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/croon")

# install_libraries(<export> <target>...)
function(install_libraries export)
  foreach(target IN LISTS ARGN)
    string(REGEX REPLACE "^croon_" "" name ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  endforeach()
  install(TARGETS ${ARGN} EXPORT ${export} ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  install(EXPORT ${export} NAMESPACE croon:: DESTINATION "${package_folder}")
endfunction()

set(libraries croon_openvdb croon_framework croon_registry croon_stages croon_library)
if(TARGET croon_cgal)
  list(APPEND libraries croon_cgal)
endif()
install_libraries(croonTargets ${libraries})
set_target_properties(croon_library PROPERTIES EXPORT_NAME croon)

# Headers of framework are <croon/geometry/plane.hpp>; a stage has the same includes inside and outside of the tree
# ("framework/geometry/plane.hpp"), for the folder `framework` is a link to the one that it is in.
install(DIRECTORY framework/ DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/croon" FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY registry DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/croon" FILES_MATCHING PATTERN "*.hpp")
install(CODE "file(CREATE_LINK . \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}/croon/framework\" SYMBOLIC)")

if(CROON_BUILD_TOOLS)
  install_libraries(croonProgramTargets croon_simulation croon_experiment_file croon_run croon_store croon_analysis
    croon_report croon_session croon_cli croon_program)
  install(TARGETS croon COMPONENT runtime)
  install(TARGETS croon_openvdb_module LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/croon"
    COMPONENT runtime)
  install(FILES experiments/store/version.hpp DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/croon/experiments/store")
  install(FILES "${PROJECT_BINARY_DIR}/experiments/store/version.cpp.in"
    "${PROJECT_BINARY_DIR}/experiments/store/croon_commit.cmake" DESTINATION "${package_folder}")
  # They extend each other.
  install(FILES experiments/best.json experiments/demo.json experiments/demo_car.json experiments/driving.json
    experiments/rig.json
    DESTINATION "${CMAKE_INSTALL_DATADIR}/croon/experiments" COMPONENT runtime)
  install(DIRECTORY experiments/paper experiments/ablations experiments/evaluation experiments/workloads
    DESTINATION "${CMAKE_INSTALL_DATADIR}/croon/experiments" COMPONENT runtime
    FILES_MATCHING PATTERN "*.json" PATTERN "*.csv")
endif()

set(CROON_HAS_PROGRAM ${CROON_BUILD_TOOLS})
configure_package_config_file(cmake/croonConfig.cmake.in "${CMAKE_CURRENT_BINARY_DIR}/croonConfig.cmake"
  INSTALL_DESTINATION "${package_folder}")
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/croonConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/croonConfig.cmake" "${CMAKE_CURRENT_BINARY_DIR}/croonConfigVersion.cmake"
  cmake/croon_add_stage.cmake cmake/croon_add_version.cmake cmake/croon_add_program.cmake cmake/write_version.cmake
  cmake/stage_list.cpp.in DESTINATION "${package_folder}")
