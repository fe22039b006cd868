if(NOT TARGET draco::draco)
  add_library(draco::draco INTERFACE IMPORTED)
  set_target_properties(draco::draco PROPERTIES INTERFACE_SYSTEM_INCLUDE_DIRECTORIES ${CMAKE_CURRENT_LIST_DIR}/../../../include INTERFACE_INCLUDE_DIRECTORIES ${CMAKE_CURRENT_LIST_DIR}/../../../include
    INTERFACE_LINK_LIBRARIES ${CMAKE_CURRENT_LIST_DIR}/../../libdraco.a)
endif()
