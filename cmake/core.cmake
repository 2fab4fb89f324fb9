# The ROS-free core: one library a room, each linked to lower rooms only, so that an upward dependency does
# not link. Nothing here knows catkin.

find_package(Eigen3 REQUIRED)
find_package(CGAL REQUIRED QUIET)
find_package(assimp REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(ZLIB REQUIRED)
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(urdfdom REQUIRED IMPORTED_TARGET urdfdom)

add_library(cfem_cutting_options INTERFACE)
target_compile_options(cfem_cutting_options INTERFACE
  $<BUILD_INTERFACE:-Wall -Wextra -Wshadow -Wnon-virtual-dtor $<$<BOOL:${CFEM_CUTTING_WERROR}>:-Werror>>)

# add_room(<name> [dependencies]); a room without sources yet is an interface library.
function(add_room room)
  file(GLOB sources CONFIGURE_DEPENDS src/${room}/*.cpp)
  file(GLOB headers CONFIGURE_DEPENDS include/cfem_cutting/${room}/*.h)
  set(scope PUBLIC)
  if(sources)
    add_library(cfem_cutting_${room} STATIC ${sources} ${headers})
    target_link_libraries(cfem_cutting_${room} PRIVATE $<BUILD_INTERFACE:cfem_cutting_options>)
  else()
    set(scope INTERFACE)
    add_library(cfem_cutting_${room} INTERFACE)
  endif()
  target_include_directories(cfem_cutting_${room} ${scope}
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
  target_link_libraries(cfem_cutting_${room} ${scope} ${ARGN})
  set_target_properties(cfem_cutting_${room} PROPERTIES EXPORT_NAME ${room})
  set_property(GLOBAL APPEND PROPERTY CFEM_CUTTING_ROOMS cfem_cutting_${room})
endfunction()

add_room(geometry Eigen3::Eigen)
# Private, so that CGAL's -frounding-math slows down no other room.
target_link_libraries(cfem_cutting_geometry PRIVATE CGAL::CGAL assimp::assimp)
add_room(volume cfem_cutting_geometry ZLIB::ZLIB)
add_room(elasticity cfem_cutting_volume Threads::Threads)
add_room(blade cfem_cutting_geometry PkgConfig::urdfdom)
add_room(cutting cfem_cutting_elasticity cfem_cutting_blade)
add_room(contact cfem_cutting_elasticity cfem_cutting_blade)
add_room(surface cfem_cutting_elasticity cfem_cutting_blade)
add_room(simulation cfem_cutting_cutting cfem_cutting_contact cfem_cutting_surface)
add_room(io cfem_cutting_simulation yaml-cpp nlohmann_json::nlohmann_json)

get_property(rooms GLOBAL PROPERTY CFEM_CUTTING_ROOMS)
add_library(cfem_cutting_core INTERFACE)
target_link_libraries(cfem_cutting_core INTERFACE cfem_cutting_io)
set_target_properties(cfem_cutting_core PROPERTIES EXPORT_NAME core)
