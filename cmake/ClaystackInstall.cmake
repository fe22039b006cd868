# find_package(Claystack COMPONENTS engine export) for programs that use the libraries.
include(CMakePackageConfigHelpers)

# Components, each a package: dev (libraries and headers, the default), program, studio.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME dev)

set(claystack_config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Claystack)

install(TARGETS claystack_core claystack_engine EXPORT ClaystackEngine)
if(TARGET claystack_core_json)  # of files and export
  install(TARGETS claystack_core_json EXPORT ClaystackEngine)
endif()
if(NOT CLAYSTACK_FILES)
  set(without_files PATTERN "files.hpp" EXCLUDE)
endif()
install(DIRECTORY core/include/ ${PROJECT_BINARY_DIR}/core/include/
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY engine/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} ${without_files})
install(EXPORT ClaystackEngine NAMESPACE claystack:: DESTINATION ${claystack_config_dir})

if(CLAYSTACK_FILES)
  install(TARGETS claystack_engine_files EXPORT ClaystackFiles)
  install(EXPORT ClaystackFiles NAMESPACE claystack:: DESTINATION ${claystack_config_dir})
endif()
if(CLAYSTACK_EXPORT)
  install(TARGETS claystack_export EXPORT ClaystackExport)
  install(DIRECTORY export/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT ClaystackExport NAMESPACE claystack:: DESTINATION ${claystack_config_dir})
endif()
if(CLAYSTACK_FALCON)
  install(TARGETS claystack_falcon EXPORT ClaystackFalcon)
  install(DIRECTORY falcon/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT ClaystackFalcon NAMESPACE claystack:: DESTINATION ${claystack_config_dir})
endif()
if(CLAYSTACK_FALCON AND CLAYSTACK_USB)
  install(TARGETS claystack_falcon_usb_core claystack_falcon_usb EXPORT ClaystackFalconUsb)
  install(EXPORT ClaystackFalconUsb NAMESPACE claystack:: DESTINATION ${claystack_config_dir})
  # udev reads this folder below /usr and /usr/local; docs/devices.md describes other prefixes.
  install(FILES falcon/device/60-claystack.rules DESTINATION lib/udev/rules.d COMPONENT program)
endif()
if(TARGET claystack_servo)
  install(TARGETS claystack_servo EXPORT ClaystackServo)
  install(DIRECTORY app/servo/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT ClaystackServo NAMESPACE claystack:: DESTINATION ${claystack_config_dir})
endif()
if(CLAYSTACK_APP)
  install(TARGETS claystack COMPONENT program)
  if(TARGET claystack-studio)
    install(TARGETS claystack-studio COMPONENT studio)
  endif()
  include(cmake/ClaystackShare.cmake)
endif()

# pkg-config --static --cflags --libs claystack-servo, for builds without CMake. The libraries are
# static: those of ours that another one needs are Requires, libraries from outside are private.
file(RELATIVE_PATH pc_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
function(claystack_pkg_config pc_name)
  cmake_parse_arguments(pc "" "DESCRIPTION;REQUIRES;REQUIRES_PRIVATE;CFLAGS;LIBS;LIBS_PRIVATE" "" ${ARGN})
  set(file ${PROJECT_BINARY_DIR}/pkgconfig/claystack-${pc_name}.pc)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/claystack.pc.in ${file} @ONLY)
  install(FILES ${file} DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()

claystack_pkg_config(engine DESCRIPTION "the clay: scene, wheel, stack, pot" REQUIRES glm
  LIBS "-lclaystack_engine -lclaystack_core")
if(CLAYSTACK_FILES)
  claystack_pkg_config(files DESCRIPTION "scene, session, pot and work files"
    REQUIRES claystack-engine LIBS -lclaystack_engine_files LIBS_PRIVATE -lclaystack_core_json)
endif()
if(CLAYSTACK_EXPORT)
  set(draco "")
  set(draco_flag "")
  if(CLAYSTACK_DRACO)
    set(draco draco)
    set(draco_flag -DCLAYSTACK_DRACO=1)
  endif()
  set(meshopt "")
  if(CLAYSTACK_MESHOPT)
    set(meshopt -lmeshoptimizer)
  endif()
  set(openmesh "")
  if(CLAYSTACK_OPENMESH)
    set(openmesh openmesh)
  endif()
  claystack_pkg_config(export DESCRIPTION "certified solids and mesh checks"
    REQUIRES claystack-engine REQUIRES_PRIVATE "${openmesh} gmp mpfr ${draco}" CFLAGS "${draco_flag}"
    LIBS -lclaystack_export LIBS_PRIVATE "-lclaystack_core_json -lzip -lxml2 -lcairo ${meshopt} -pthread")
endif()
if(CLAYSTACK_FALCON)
  claystack_pkg_config(falcon DESCRIPTION "haptic devices and the force guard" REQUIRES glm
    LIBS "-lclaystack_falcon -lclaystack_core")
endif()
if(CLAYSTACK_FALCON AND CLAYSTACK_USB)
  claystack_pkg_config(falcon-usb DESCRIPTION "connected devices" REQUIRES claystack-falcon
    REQUIRES_PRIVATE "libftdi1 libusb-1.0 hidapi-hidraw" LIBS -lclaystack_falcon_usb_core)
endif()
if(TARGET claystack_servo)
  claystack_pkg_config(servo DESCRIPTION "a pot thrown live with a haptic arm"
    REQUIRES "claystack-files claystack-falcon" REQUIRES_PRIVATE fmt
    LIBS -lclaystack_servo LIBS_PRIVATE -pthread)
endif()

# With these names the package is found as Claystack and as claystack.
configure_package_config_file(cmake/claystack-config.cmake.in
  ${PROJECT_BINARY_DIR}/claystack-config.cmake INSTALL_DESTINATION ${claystack_config_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/claystack-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/claystack-config.cmake
              ${PROJECT_BINARY_DIR}/claystack-config-version.cmake
        DESTINATION ${claystack_config_dir})

include(cmake/ClaystackPackages.cmake)
