#!/bin/sh
# Installs the programs that judge our files, builds everything and runs every test: first with
# assertions, where the link also compares the definitions of types, then as users run it.
set -eu
cd "$(dirname "$0")/.."
sh samples/install_packages.sh clang clang-format-14 clang-tidy-14 admesh draco prusa-slicer openscad librsvg2-bin \
  libbenchmark-dev libxml2-utils imagemagick umockdev libumockdev-dev xvfb xdotool
cmake --workflow --preset debug
cmake --preset release -DCLAYSTACK_BENCH=ON
cmake --build --preset release
ctest --preset release -j 2
