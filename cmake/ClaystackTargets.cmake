# One place for what every target shares.

find_program(CLAYSTACK_CCACHE ccache)
if(CLAYSTACK_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CLAYSTACK_CCACHE})
endif()

function(claystack_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  # A replay must give the same bits on every compiler: no fused multiply-add.
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wconversion -Wshadow -ffp-contract=off
    $<$<BOOL:${CLAYSTACK_WERROR}>:-Werror>)
  # With sanitizers GCC 12 loses track of a variant's members and warns of nothing.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
  endif()
endfunction()

# claystack_library(NAME component SOURCES ...): a static library with the
# alias claystack::NAME, public headers in include/, private ones in src/.
function(claystack_library name)
  cmake_parse_arguments(arg "" "" "SOURCES" ${ARGN})
  add_library(claystack_${name} STATIC ${arg_SOURCES})
  add_library(claystack::${name} ALIAS claystack_${name})
  set_target_properties(claystack_${name} PROPERTIES
    EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(claystack_${name}
    PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  claystack_compile_options(claystack_${name})
endfunction()
