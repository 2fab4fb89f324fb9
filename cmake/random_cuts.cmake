# Random cuts against exact oracles: a thousand through cuts, and some that stop or cross. scripts/random_cuts
# makes ten thousand.
file(GLOB random_cuts_sources CONFIGURE_DEPENDS test/random_cuts/*.cpp)
add_executable(random_cuts ${random_cuts_sources})
target_include_directories(random_cuts PRIVATE test)
target_link_libraries(random_cuts PRIVATE cfem_cutting_simulation cfem_cutting_options CGAL::CGAL)

set(bunny ${CMAKE_CURRENT_SOURCE_DIR}/data/bunny00.off)
function(add_random_cuts kind first count)
  add_test(NAME random_cuts.${kind}.${first} COMMAND random_cuts
    --kind ${kind} --first ${first} --count ${count} --bunny ${bunny})
  set_tests_properties(random_cuts.${kind}.${first} PROPERTIES TIMEOUT 600)
endfunction()
foreach(first 0 250 500 750)
  add_random_cuts(through ${first} 250)
endforeach()
add_random_cuts(stopped 0 100)
add_random_cuts(crossing 0 100)
# Cuts that folded the surface once.
foreach(first 2414 2538 2766 5186)
  add_random_cuts(through ${first} 1)
endforeach()
add_random_cuts(stopped 789 1)
foreach(first 464 491 520 612 693 857)
  add_random_cuts(crossing ${first} 1)
endforeach()
