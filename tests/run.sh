#!/bin/sh
# Installs the programs that the checks use. Then runs clang-tidy, compiles the window with Clang, and
# runs the tests of the Debug build and all tests of the Release build. CONTRIBUTING.md lists them.
set -eu
cd "$(dirname "$0")/.."
sh samples/install_packages.sh clang clang-tidy-14 clang-format-14 admesh draco prusa-slicer openscad \
  librsvg2-bin libbenchmark-dev libxml2-utils imagemagick umockdev libumockdev-dev xvfb xdotool \
  assimp-utils python3-savitar python3-dev pybind11-dev python3-numpy
sh tests/tidy.sh
sh tests/clang_app.sh
cmake --preset debug -DCLAYSTACK_BENCH=OFF
cmake --build --preset debug --target debug_tests
ctest --preset debug -L debug
# The Python package is for the interpreter of Debian, whose NumPy it uses.
cmake --preset release -DCLAYSTACK_BENCH=ON -DCLAYSTACK_PYTHON=ON -DPython3_EXECUTABLE=/usr/bin/python3
cmake --build --preset release
ctest --preset release -j 2
