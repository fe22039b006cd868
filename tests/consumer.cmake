# cmake -DSOURCE=... -DBUILD=... -DWORK=... -P consumer.cmake: installs, then builds a separate
# program with the installed copy; and the engine alone, which must not need heavy libraries.

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Everything, from the build under test.
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/full)
run(${CMAKE_COMMAND} -S ${SOURCE}/samples/consumer -B ${WORK}/consumer -G Ninja
  -DCMAKE_PREFIX_PATH=${WORK}/full -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${WORK}/consumer)
run(${WORK}/consumer/press_once)
run(${WORK}/consumer/export_cup)

# The engine alone.
run(${CMAKE_COMMAND} -S ${SOURCE} --preset engine-only -B ${WORK}/engine-build
  -DCMAKE_DISABLE_FIND_PACKAGE_CGAL=ON -DCMAKE_DISABLE_FIND_PACKAGE_OpenMesh=ON
  -DCMAKE_DISABLE_FIND_PACKAGE_draco=ON -DCMAKE_DISABLE_FIND_PACKAGE_nlohmann_json=ON)
run(${CMAKE_COMMAND} --build ${WORK}/engine-build)
run(${CMAKE_COMMAND} --install ${WORK}/engine-build --prefix ${WORK}/engine)
run(${CMAKE_COMMAND} -S ${SOURCE}/samples/consumer -B ${WORK}/engine-consumer -G Ninja
  -DCMAKE_PREFIX_PATH=${WORK}/engine -DCMAKE_BUILD_TYPE=Release -DCONSUMER_EXPORT=OFF)
run(${CMAKE_COMMAND} --build ${WORK}/engine-consumer)
run(${WORK}/engine-consumer/press_once)

execute_process(COMMAND ldd ${WORK}/engine-consumer/press_once
  OUTPUT_VARIABLE libraries COMMAND_ERROR_IS_FATAL ANY)
message(STATUS "the engine alone links\n${libraries}")
if(libraries MATCHES "CGAL|gmp|mpfr|usb|hidapi|ftdi|libGL|libEGL|OpenMesh|draco")
  message(FATAL_ERROR "the engine brings along what it does not need")
endif()
if(NOT libraries MATCHES "libstdc")
  message(FATAL_ERROR "ldd printed no library at all: this check sees nothing")
endif()
