#!/bin/sh
# From a fresh Debian 12 to a printable file: installs what the build needs, builds, throws the
# sample bowl from its recorded session and exports it. Needs neither a Falcon nor a screen.
set -eu
cd "$(dirname "$0")/.."

packages="g++ cmake ninja-build ccache libglm-dev libexpected-dev nlohmann-json3-dev libcli11-dev
  libfmt-dev libcgal-dev libopenmesh-dev libdraco-dev libmeshoptimizer-dev libxxhash-dev libgtest-dev
  libgmock-dev librapidcheck-dev libsvgpp-dev libxml2-dev libzip-dev libcairo2-dev pkg-config libftdi1-dev
  libusb-1.0-0-dev libhidapi-dev libepoxy-dev libegl-dev libstb-dev zlib1g-dev libgif-dev libgl1-mesa-dri
  libglfw3-dev libimgui-dev fonts-inter"
# shellcheck disable=SC2086  # a list of words
sh samples/install_packages.sh $packages

cmake --preset release -DCLAYSTACK_BENCH=OFF   # tests/run.sh builds the benchmarks
cmake --build --preset release --target claystack claystack-studio

claystack=build/release/app/claystack
mkdir -p out
$claystack throw samples/bowl.scene.json -o out/bowl.pot.json
$claystack export out/bowl.pot.json out/bowl.stl out/bowl.obj out/bowl.drc out/bowl.svg
$claystack render out/bowl.pot.json -o out/bowl.png
for file in out/bowl.stl out/bowl.obj out/bowl.drc; do
  $claystack check "$file"
done
