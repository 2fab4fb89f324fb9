# cmake -D build=<build folder> -P install_test.cmake: installs the core alone, builds and runs a user of it.
set(scratch ${build}/install_test)
set(prefix ${scratch}/prefix)
file(REMOVE_RECURSE ${scratch})

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run(${CMAKE_COMMAND} --install ${build} --prefix ${prefix} --component core)
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${scratch}/user -DCMAKE_BUILD_TYPE=Release
  -Dcfem_cutting_DIR= -DCMAKE_PREFIX_PATH=${prefix})
run(${CMAKE_COMMAND} --build ${scratch}/user)
run(${scratch}/user/user)
