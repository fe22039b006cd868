# cmake -DSOURCE=... -DBUILD=... -DWORK=... [-DCXX=...] -P consumer.cmake: installs, then builds
# separate programs against the installed copy with CMake and with pkg-config. The links of the
# installed pages must lead to installed files. Then installs the engine alone, which must not need
# heavy libraries.

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# A file that is no longer installed must not remain from an earlier run.
file(REMOVE_RECURSE ${WORK}/full ${WORK}/engine)

# All components, from the build under test.
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/full)
find_program(PYTHON3 python3 REQUIRED)
run(${PYTHON3} ${SOURCE}/tests/docs.py --links ${WORK}/full/share/doc)
run(${CMAKE_COMMAND} -S ${SOURCE}/samples/consumer -B ${WORK}/consumer -G Ninja
  -DCMAKE_PREFIX_PATH=${WORK}/full -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${WORK}/consumer)
set(bowl ${SOURCE}/samples/bowl.scene.json ${SOURCE}/samples/bowl.session)
run(${WORK}/consumer/press_once)
run(${WORK}/consumer/press_and_export)
run(${WORK}/consumer/throw_and_export ${bowl} ${WORK}/cmake.stl)
run(${WORK}/consumer/check_mesh ${WORK}/cmake.stl)
run(${WORK}/consumer/run_servo)
if(EXISTS ${WORK}/consumer/list_devices)
  run(${WORK}/consumer/list_devices)
endif()

# The same programs without CMake.
if(NOT CXX)
  set(CXX c++)
endif()
file(GLOB_RECURSE pc_files ${WORK}/full/*/claystack-servo.pc)
list(GET pc_files 0 pc_file)
cmake_path(GET pc_file PARENT_PATH pc_folder)
set(ENV{PKG_CONFIG_PATH} ${pc_folder})
file(MAKE_DIRECTORY ${WORK}/pkgconfig)
set(packages_of_press_once claystack-engine)
set(packages_of_throw_and_export claystack-files claystack-export)
set(packages_of_check_mesh claystack-export)
set(packages_of_run_servo claystack-servo)
foreach(program press_once throw_and_export check_mesh run_servo)
  execute_process(COMMAND pkg-config --static --cflags --libs ${packages_of_${program}}
    OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  run(${CXX} -std=c++20 ${SOURCE}/samples/consumer/${program}.cpp -o ${WORK}/pkgconfig/${program}
    ${flags})
endforeach()
run(${WORK}/pkgconfig/press_once)
run(${WORK}/pkgconfig/throw_and_export ${bowl} ${WORK}/pkgconfig.stl)
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
file(GLOB docs RELATIVE ${WORK}/engine/share/doc ${WORK}/engine/share/doc/*)
if(NOT docs STREQUAL "libclaystack-dev")
  message(FATAL_ERROR "expected the documents of libclaystack-dev alone, found: ${docs}")
endif()

execute_process(COMMAND ldd ${WORK}/engine-consumer/press_once
  OUTPUT_VARIABLE libraries COMMAND_ERROR_IS_FATAL ANY)
message(STATUS "libraries of the engine alone:\n${libraries}")
if(libraries MATCHES "CGAL|gmp|mpfr|usb|hidapi|ftdi|libGL|libEGL|OpenMesh|draco|meshoptimizer")
  message(FATAL_ERROR "the engine links libraries that it does not need")
endif()
if(NOT libraries MATCHES "libstdc")
  message(FATAL_ERROR "expected libstdc++ in the output of ldd")
endif()
