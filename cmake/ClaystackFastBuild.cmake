# Shorter builds: a small file spends most of its compile time in headers. CGAL has no precompiled
# header, because GCC takes longer to load one of that size than to compile a small file.
option(CLAYSTACK_FAST_BUILD "Precompiled headers for tests, several files at once in the programs" ON)

# The headers of most tests. claystack_use_test_headers(TARGET) uses them; compiler options that
# change code must be the same in both.
function(claystack_precompile_test_headers)
  if(NOT CLAYSTACK_FAST_BUILD)
    return()
  endif()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/test_headers.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "" @ONLY)
  add_library(claystack_test_headers OBJECT ${source})
  claystack_compile_options(claystack_test_headers)
  claystack_optimise_little(claystack_test_headers)
  target_link_libraries(claystack_test_headers PRIVATE GTest::gtest rapidcheck rapidcheck_gtest)
  target_precompile_headers(claystack_test_headers PRIVATE
    <algorithm> <cmath> <string> <vector> <gtest/gtest.h> <rapidcheck/gtest.h>)
endfunction()

function(claystack_use_test_headers target)
  if(CLAYSTACK_FAST_BUILD)
    target_precompile_headers(${target} REUSE_FROM claystack_test_headers)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      target_compile_options(${target} PRIVATE -fpch-preprocess)  # or ccache keeps nothing
    endif()
  endif()
endfunction()

# Files of a target, several at once: for targets whose files include the same large headers.
function(claystack_compile_together target)
  set_target_properties(${target} PROPERTIES
    UNITY_BUILD ${CLAYSTACK_FAST_BUILD} UNITY_BUILD_BATCH_SIZE 8)
endfunction()
