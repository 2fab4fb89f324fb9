# The ROS side: messages, the library of src/ros, the nodes, and their tests with a ROS master.

# ROS needs the system's Python, not one of pyenv or conda that may come first on PATH.
foreach(python PYTHON_EXECUTABLE Python3_EXECUTABLE)
  if(NOT DEFINED ${python} AND EXISTS "/usr/bin/python3")
    set(${python} /usr/bin/python3 CACHE FILEPATH "The Python that ROS came with")
  endif()
endforeach()
find_package(catkin REQUIRED COMPONENTS
  diagnostic_updater geometry_msgs message_generation resource_retriever rosbag roscpp roslib std_msgs std_srvs tf2
  tf2_eigen tf2_msgs tf2_ros visualization_msgs)

add_message_files(FILES ContactForces.msg FractureEvent.msg StepReport.msg SurfaceMesh.msg)
add_service_files(FILES GetEvents.srv SaveSurface.srv)
generate_messages(DEPENDENCIES geometry_msgs std_msgs)
catkin_package(
  INCLUDE_DIRS include
  CATKIN_DEPENDS diagnostic_updater geometry_msgs message_runtime resource_retriever rosbag roscpp roslib std_msgs
    std_srvs tf2 tf2_eigen tf2_msgs tf2_ros visualization_msgs)

file(GLOB ros_sources CONFIGURE_DEPENDS src/ros/*.cpp)
file(GLOB ros_headers CONFIGURE_DEPENDS include/cfem_cutting/ros/*.h)
add_library(cfem_cutting_ros STATIC ${ros_sources} ${ros_headers})
add_dependencies(cfem_cutting_ros ${PROJECT_NAME}_generate_messages_cpp ${catkin_EXPORTED_TARGETS})
target_include_directories(cfem_cutting_ros PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}/include)
target_include_directories(cfem_cutting_ros SYSTEM PUBLIC
  ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_INCLUDE_DESTINATION} ${catkin_INCLUDE_DIRS})
target_link_libraries(cfem_cutting_ros PUBLIC cfem_cutting_io ${catkin_LIBRARIES} PRIVATE cfem_cutting_options)

foreach(node cutting_node tool_path_player)
  add_executable(${node} src/nodes/${node}.cpp)
  target_link_libraries(${node} PRIVATE cfem_cutting_ros cfem_cutting_options)
  set_target_properties(${node} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
  install(TARGETS ${node} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
endforeach()
catkin_install_python(PROGRAMS src/nodes/pace_playback.py src/nodes/play_bag.py
  DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(DIRECTORY config launch rviz urdf DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
install(DIRECTORY test/bags DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/test)

include(CTest)
if(NOT BUILD_TESTING)
  return()
endif()

# Needs a master and the parameters of parameters.test.
find_package(GTest REQUIRED)
add_executable(test_parameters test/rostest/parameters_test.cpp)
target_compile_definitions(test_parameters PRIVATE CFEM_CUTTING_SOURCE_DIR="${CMAKE_CURRENT_SOURCE_DIR}")
target_link_libraries(test_parameters PRIVATE cfem_cutting_ros cfem_cutting_options GTest::gtest)
set_target_properties(test_parameters PROPERTIES
  RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})

# Tests of the running node: each *.test brings its own master.
file(GLOB rostests CONFIGURE_DEPENDS test/rostest/*.test)
foreach(rostest ${rostests})
  get_filename_component(name ${rostest} NAME_WE)
  add_test(NAME rostest.${name} COMMAND ${CATKIN_DEVEL_PREFIX}/env.sh rostest ${rostest})
  set_tests_properties(rostest.${name} PROPERTIES RUN_SERIAL TRUE TIMEOUT 600)
endforeach()
