# One place for what every target shares.
include(cmake/ClaystackFastBuild.cmake)

find_program(CLAYSTACK_CCACHE ccache)
if(CLAYSTACK_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # ccache keeps files that use precompiled headers only with these settings (its manual says why).
  set(CMAKE_CXX_COMPILER_LAUNCHER
    ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
    ${CLAYSTACK_CCACHE})
endif()

# Two types of one name with different members are undefined behaviour that neither compiler nor
# linker sees; GCC's link-time optimisation compares them. The preset `odr` builds the programs so.
option(CLAYSTACK_ODR_CHECK "Compare definitions across files where programs are linked (GCC)" OFF)
if(CLAYSTACK_ODR_CHECK)
  add_compile_options(-flto -fno-fat-lto-objects)
  add_link_options(-flto=2 -Wodr -Werror=odr -Werror=lto-type-mismatch)
endif()

function(claystack_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  # A replay must give the same bits on every compiler: no fused multiply-add.
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wconversion -Wshadow -ffp-contract=off
    $<$<BOOL:${CLAYSTACK_WERROR}>:-Werror>)
  # With sanitizers, GCC 12 gives false warnings about a variant's members.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
  endif()
endfunction()

# For code that runs once in a process, such as reading options: half the time to compile.
function(claystack_optimise_little target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# claystack_component(NAME USES targets ...): claystack::NAME, a static library made of the rooms
# that claystack_room adds. Public headers are in include/; every other header is private and is
# included by its path from the top, "export/walls/edge_tree.hpp", which names its room.
# tests/layering.cmake checks which room may include which.
function(claystack_component name)
  cmake_parse_arguments(arg "" "" "PUBLIC;PRIVATE" ${ARGN})
  add_library(claystack_${name} STATIC)
  add_library(claystack::${name} ALIAS claystack_${name})
  set_target_properties(claystack_${name} PROPERTIES EXPORT_NAME ${name} LINKER_LANGUAGE CXX)
  target_include_directories(claystack_${name} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(claystack_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  claystack_compile_options(claystack_${name})
endfunction()

# claystack_room(COMPONENT ROOM SOURCES ... [LIBRARIES ...]): the objects of one room, as the target
# claystack_COMPONENT_ROOM; LIBRARIES are used by this room only.
function(claystack_room component room)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES" ${ARGN})
  string(REPLACE / _ target claystack_${component}_${room})
  list(TRANSFORM arg_SOURCES PREPEND ${room}/)
  add_library(${target} OBJECT ${arg_SOURCES})
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  claystack_compile_options(${target})
  target_include_directories(${target} PRIVATE
    ${PROJECT_SOURCE_DIR}
    $<TARGET_PROPERTY:claystack_${component},INTERFACE_INCLUDE_DIRECTORIES>)
  target_link_libraries(${target} PRIVATE ${arg_LIBRARIES})
  target_sources(claystack_${component} PRIVATE $<TARGET_OBJECTS:${target}>)
endfunction()

# claystack_leak_rules(PROGRAM): with the address sanitizer, memory that system libraries keep
# does not count as a leak.
function(claystack_leak_rules target)
  if(NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize=address")
    return()
  endif()
  if(NOT TARGET claystack_leak_rule_objects)
    add_library(claystack_leak_rule_objects OBJECT ${PROJECT_SOURCE_DIR}/tests/support/leak_rules.cpp)
  endif()
  target_sources(${target} PRIVATE $<TARGET_OBJECTS:claystack_leak_rule_objects>)
endfunction()
