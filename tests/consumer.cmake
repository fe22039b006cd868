# cmake -DSOURCE=... -DBUILD=... -DWORK=... [-DCXX=...] -P consumer.cmake: installs, then builds
# separate programs against the installed copy with CMake and with pkg-config. Then installs the
# engine alone, which must not need heavy libraries.

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# All components, from the build under test.
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/full)
run(${CMAKE_COMMAND} -S ${SOURCE}/samples/consumer -B ${WORK}/consumer -G Ninja
  -DCMAKE_PREFIX_PATH=${WORK}/full -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${WORK}/consumer)
run(${WORK}/consumer/press_once)
run(${WORK}/consumer/throw_and_export ${WORK}/cmake.stl)
run(${WORK}/consumer/check_mesh ${WORK}/cmake.stl)
run(${WORK}/consumer/run_servo)

# The same programs without CMake.
if(NOT CXX)
  set(CXX c++)
endif()
file(GLOB_RECURSE pc_files ${WORK}/full/*/claystack-servo.pc)
list(GET pc_files 0 pc_file)
cmake_path(GET pc_file PARENT_PATH pc_folder)
set(ENV{PKG_CONFIG_PATH} ${pc_folder})
file(MAKE_DIRECTORY ${WORK}/pkgconfig)
foreach(use press_once=claystack-engine throw_and_export=claystack-export
        check_mesh=claystack-export run_servo=claystack-servo)
  string(REPLACE = ";" use ${use})
  list(GET use 0 program)
  list(GET use 1 package)
  execute_process(COMMAND pkg-config --static --cflags --libs ${package}
    OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  run(${CXX} -std=c++20 ${SOURCE}/samples/consumer/${program}.cpp -o ${WORK}/pkgconfig/${program}
    ${flags})
endforeach()
run(${WORK}/pkgconfig/press_once)
run(${WORK}/pkgconfig/throw_and_export ${WORK}/pkgconfig.stl)
run(${WORK}/pkgconfig/check_mesh ${WORK}/pkgconfig.stl)
run(${WORK}/pkgconfig/run_servo)
file(SHA256 ${WORK}/cmake.stl by_cmake)
file(SHA256 ${WORK}/pkgconfig.stl by_pkgconfig)
if(NOT by_cmake STREQUAL by_pkgconfig)
  message(FATAL_ERROR "the programs built with CMake and with pkg-config export different files")
endif()

# The engine alone.
run(${CMAKE_COMMAND} -S ${SOURCE} --preset engine-only -B ${WORK}/engine-build
  -DCMAKE_DISABLE_FIND_PACKAGE_CGAL=ON -DCMAKE_DISABLE_FIND_PACKAGE_OpenMesh=ON
  -DCMAKE_DISABLE_FIND_PACKAGE_draco=ON -DCMAKE_DISABLE_FIND_PACKAGE_nlohmann_json=ON)
run(${CMAKE_COMMAND} --build ${WORK}/engine-build)
run(${CMAKE_COMMAND} --install ${WORK}/engine-build --prefix ${WORK}/engine)
run(${CMAKE_COMMAND} -S ${SOURCE}/samples/consumer -B ${WORK}/engine-consumer -G Ninja
  -DCMAKE_PREFIX_PATH=${WORK}/engine -DCMAKE_BUILD_TYPE=Release -DCONSUMER_ENGINE_ONLY=ON)
run(${CMAKE_COMMAND} --build ${WORK}/engine-consumer)
run(${WORK}/engine-consumer/press_once)

execute_process(COMMAND ldd ${WORK}/engine-consumer/press_once
  OUTPUT_VARIABLE libraries COMMAND_ERROR_IS_FATAL ANY)
message(STATUS "libraries of the engine alone:\n${libraries}")
if(libraries MATCHES "CGAL|gmp|mpfr|usb|hidapi|ftdi|libGL|libEGL|OpenMesh|draco|meshoptimizer")
  message(FATAL_ERROR "the engine links libraries that it does not need")
endif()
if(NOT libraries MATCHES "libstdc")
  message(FATAL_ERROR "expected libstdc++ in the output of ldd")
endif()
