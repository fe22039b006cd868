#!/bin/sh
# Installs the programs that judge our files, builds everything, runs every test.
set -eu
cd "$(dirname "$0")/.."
sh samples/install_packages.sh clang clang-format-14 admesh draco prusa-slicer openscad librsvg2-bin \
  libbenchmark-dev libxml2-utils imagemagick umockdev libumockdev-dev xvfb xdotool
cmake --preset release -DCLAYSTACK_BENCH=ON
cmake --build --preset release
ctest --preset release -j 2
