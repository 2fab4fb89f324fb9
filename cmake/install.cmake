# Installs the core, so that `find_package(cfem_cutting)` and `cfem_cutting::core` (or one room of it, such as
# `cfem_cutting::volume`) work in other projects, ROS or not. Alone: cmake --install .build --component core
include(CMakePackageConfigHelpers)

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/cfem_cutting)
add_library(cfem_cutting::core ALIAS cfem_cutting_core)

get_property(rooms GLOBAL PROPERTY CFEM_CUTTING_ROOMS)
install(TARGETS cfem_cutting_core ${rooms} EXPORT cfem_cutting_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT core)
foreach(room ${rooms})
  string(REPLACE cfem_cutting_ "" room ${room})
  install(DIRECTORY include/cfem_cutting/${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/cfem_cutting
    COMPONENT core FILES_MATCHING PATTERN "*.h")
endforeach()

install(EXPORT cfem_cutting_targets FILE cfem_cuttingTargets.cmake NAMESPACE cfem_cutting::
  DESTINATION ${config_dir} COMPONENT core)
# Catkin writes a cfem_cuttingConfig.cmake of its own into the build folder; ours is kept apart from it.
set(catkin_config_dir ${CMAKE_INSTALL_DATADIR}/cfem_cutting/cmake)
configure_package_config_file(cmake/cfem_cuttingConfig.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/core_config/cfem_cuttingConfig.cmake
  INSTALL_DESTINATION ${config_dir} PATH_VARS catkin_config_dir)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/core_config/cfem_cuttingConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  ${CMAKE_CURRENT_BINARY_DIR}/core_config/cfem_cuttingConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/core_config/cfem_cuttingConfigVersion.cmake
  DESTINATION ${config_dir} COMPONENT core)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/cfem_cutting COMPONENT core)

# What scripts/fetch_data has fetched, if it has: configurations name it as package://cfem_cutting/data/…
install(DIRECTORY data DESTINATION ${CMAKE_INSTALL_DATADIR}/cfem_cutting OPTIONAL)
