# Command line programs. They run without a ROS master; with ROS they read bags too.

add_executable(replay src/nodes/replay.cpp)
target_link_libraries(replay PRIVATE cfem_cutting_io cfem_cutting_options)
if(CFEM_CUTTING_ROS)
  target_compile_definitions(replay PRIVATE CFEM_CUTTING_WITH_BAGS)
  target_link_libraries(replay PRIVATE cfem_cutting_ros)
  set_target_properties(replay PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
  install(TARGETS replay RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
else()
  install(TARGETS replay RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
