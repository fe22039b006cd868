#!/bin/sh
# Compiles the window, and the rooms of the app that it uses, with Clang; a warning is an error.
# tests/tidy.sh does so for core, engine and falcon. The rest would take too long for CI:
# cmake --workflow --preset clang compiles everything.
set -eu
cd "$(dirname "$0")/.."
cmake --preset clang-debug -B build/clang-app -DCMAKE_CXX_FLAGS_DEBUG=-O0 -DCLAYSTACK_TESTS=OFF \
  -DCLAYSTACK_BENCH=OFF -DCMAKE_OPTIMIZE_DEPENDENCIES=ON \
  -DCGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE=TRUE >/dev/null
cmake --build build/clang-app --target claystack_chart claystack_console claystack_history \
  claystack_import claystack_render claystack_report claystack_servo claystack_strokes \
  claystack_studio
