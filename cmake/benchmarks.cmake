# Benchmarks (Google Benchmark): build with -DCFEM_CUTTING_BENCHMARKS=ON, run lib/cfem_cutting/benchmark_<name>
# of the build's devel folder (by itself: of the build).
if(NOT CFEM_CUTTING_BENCHMARKS)
  return()
endif()
find_package(benchmark REQUIRED)

foreach(name elasticity cutting)
  add_executable(benchmark_${name} benchmark/${name}_benchmark.cpp benchmark/yardstick.cpp)
  target_compile_definitions(benchmark_${name} PRIVATE CFEM_CUTTING_SOURCE_DIR="${CMAKE_CURRENT_SOURCE_DIR}")
  target_include_directories(benchmark_${name} PRIVATE src/elasticity test)
  target_link_libraries(benchmark_${name} PRIVATE cfem_cutting_io cfem_cutting_options benchmark::benchmark)
endforeach()
