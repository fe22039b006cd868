# find_package(Claystack COMPONENTS engine export) for programs that use the libraries.
include(CMakePackageConfigHelpers)

set(claystack_config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Claystack)

install(TARGETS claystack_core claystack_engine EXPORT ClaystackEngine)
if(TARGET claystack_core_json)  # of files and export
  install(TARGETS claystack_core_json EXPORT ClaystackEngine)
endif()
if(NOT CLAYSTACK_FILES)
  set(without_files PATTERN "files.hpp" EXCLUDE)
endif()
install(DIRECTORY core/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
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
  install(FILES falcon/device/60-claystack.rules DESTINATION lib/udev/rules.d)
endif()
if(CLAYSTACK_APP)
  install(TARGETS claystack)
  if(TARGET claystack-studio)
    install(TARGETS claystack-studio)
  endif()
endif()

configure_package_config_file(cmake/ClaystackConfig.cmake.in
  ${PROJECT_BINARY_DIR}/ClaystackConfig.cmake INSTALL_DESTINATION ${claystack_config_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/ClaystackConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/ClaystackConfig.cmake
              ${PROJECT_BINARY_DIR}/ClaystackConfigVersion.cmake
        DESTINATION ${claystack_config_dir})
