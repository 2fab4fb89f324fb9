# One test program a room: test/<room>/*_test.cpp.
include(CTest)
if(NOT BUILD_TESTING)
  return()
endif()
find_package(GTest REQUIRED)
include(GoogleTest)

function(add_room_test room)
  file(GLOB sources CONFIGURE_DEPENDS test/${room}/*_test.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(test_${room} ${sources})
  target_include_directories(test_${room} PRIVATE test src/${room})
  target_link_libraries(test_${room} PRIVATE cfem_cutting_${room} cfem_cutting_options GTest::gtest_main ${ARGN})
  gtest_discover_tests(test_${room} TEST_PREFIX ${room}. DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
endfunction()

foreach(room geometry volume elasticity blade cutting contact surface simulation io)
  add_room_test(${room})
endforeach()

# Closed forms, balances and other codes: what doc/verification.md lists.
set(verification_dir ${CMAKE_BINARY_DIR}/verification)
file(GLOB analytic_sources CONFIGURE_DEPENDS test/analytic/*.cpp)
list(FILTER analytic_sources EXCLUDE REGEX _main\\.cpp$)
add_executable(test_analytic ${analytic_sources})
target_include_directories(test_analytic PRIVATE test)
target_compile_definitions(test_analytic PRIVATE CFEM_CUTTING_VERIFICATION_DIR="${verification_dir}")
target_link_libraries(test_analytic PRIVATE cfem_cutting_elasticity cfem_cutting_options GTest::gtest_main)
gtest_discover_tests(test_analytic TEST_PREFIX analytic. DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)

find_package(Python3 REQUIRED COMPONENTS Interpreter)
add_executable(calculix_export test/analytic/calculix_export_main.cpp)
target_include_directories(calculix_export PRIVATE test test/analytic)
target_link_libraries(calculix_export PRIVATE cfem_cutting_elasticity cfem_cutting_options)
add_test(NAME analytic.calculix COMMAND Python3::Interpreter
  ${CMAKE_CURRENT_SOURCE_DIR}/test/analytic/compare_with_calculix.py $<TARGET_FILE:calculix_export>
  ${CMAKE_BINARY_DIR}/calculix ${verification_dir}/calculix.tsv)

# The replay program from its command line; the liver needs scripts/fetch_data.
add_test(NAME replay COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/test/replay/replay_test.py
  $<TARGET_FILE:replay> ${CMAKE_CURRENT_SOURCE_DIR} $<$<BOOL:${CFEM_CUTTING_ROS}>:--bags>)
set_tests_properties(replay PROPERTIES TIMEOUT 600)

# The installed core serves a project without ROS.
add_test(NAME install COMMAND ${CMAKE_COMMAND} -D build=${CMAKE_BINARY_DIR}
  -P ${CMAKE_CURRENT_SOURCE_DIR}/test/install/install_test.cmake)

add_test(NAME scripts.make_tissue COMMAND Python3::Interpreter
  ${CMAKE_CURRENT_SOURCE_DIR}/test/scripts/make_tissue_test.py $<TARGET_FILE:replay> ${CMAKE_CURRENT_SOURCE_DIR})
include(random_cuts)
