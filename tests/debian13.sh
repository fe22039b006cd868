#!/bin/sh
# debian13.sh [BUILD]: builds the last commit in a Debian 13 below BUILD/debian13 (default
# build/release; debootstrap, root), with its GCC and its Clang, and runs the tests there: with GCC
# all but those that need a screen or an emulated device, with Clang those of engine, export and
# import. Compares pots and exports of the samples with those of BUILD, byte for byte. The system
# and its ccache stay for the next run. The first run takes as long as two builds from scratch.
set -eu
cd "$(dirname "$0")/.."
build=$(realpath "${1:-build/release}")
root=$build/debian13
suites="core_tests engine_tests engine_files_tests export_tests mesh_format_tests import_tests"
. tests/clean_debian.sh
sh samples/install_packages.sh debootstrap
[ -e "$root/etc/debian_version" ] || clean_debian trixie "$root" "$build/debootstrap13.log"
mounts="proc dev/shm dev/pts dev"
unmount() { for folder in $mounts; do umount "$root/$folder" 2>/dev/null || true; done; }
trap unmount EXIT
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
mount --bind /dev/pts "$root/dev/pts"
mount -t tmpfs tmpfs "$root/dev/shm"

echo "== sources of the last commit"
# The time of extraction (-m), not of the commit: ninja builds all files again, mostly from ccache.
mkdir -p "$root/opt/claystack"
git archive HEAD | tar -x -m -C "$root/opt/claystack"
echo "== README: packages, build, first pot"
inside "$root" sh -c 'cd /opt/claystack && sh samples/first_pot.sh'
echo "== tests"
inside "$root" sh -c 'cd /opt/claystack &&
  sh samples/install_packages.sh libxml2-utils admesh draco librsvg2-bin imagemagick prusa-slicer openscad \
    assimp-utils unzip clang &&
  cmake --build --preset release &&
  ctest --preset release -j 2 -LE "slow|screen|rig" \
    -E "^(docs|format)$|HelpNamesTheKindOfEveryValue|MatchesTheReferencePictures"'
echo "== Clang"
# shellcheck disable=SC2086  # a list of words
inside "$root" sh -c "cd /opt/claystack &&
  cmake --preset clang -DCLAYSTACK_FAST_BUILD=ON -DCLAYSTACK_BENCH=OFF &&
  cmake --build --preset clang --target claystack $(echo $suites) &&
  cd build/clang && for suite in $suites; do ./tests/*/\$suite --gtest_brief=1 || exit 1; done"

echo "== the same bytes"
cat >"$root/opt/claystack/pots.sh" <<'POTS'
set -eu
claystack=$1
rm -rf "$2"
mkdir -p "$2"
for scene in samples/*.scene.json; do
  name=$(basename "$scene" .scene.json)
  pot=$2/$name.pot.json
  $claystack throw -q "$scene" -o "$pot"
  case $name in collapse) endings="stl obj" ;; *) endings="stl obj drc 3mf ply glb step svg dxf" ;; esac
  for ending in $endings; do $claystack export -q "$pot" "$2/$name.$ending"; done
done
for drawing in samples/drawings/*; do
  $claystack import -q "$drawing" -o "$2/$(basename "$drawing").pot.json"
done
POTS
inside "$root" sh -c 'cd /opt/claystack && for by in release clang; do
  sh pots.sh build/$by/app/claystack /opt/pots-$by; done'
sh "$root/opt/claystack/pots.sh" "$build/app/claystack" "$build/pots12"
different=0
for by in release clang; do
  for file in "$build"/pots12/*; do
    cmp -s "$file" "$root/opt/pots-$by/$(basename "$file")" ||
      { echo "different ($by): $(basename "$file")"; different=1; }
  done
done
[ "$different" = 0 ] && echo "$(ls "$build/pots12" | wc -l) files of GCC and of Clang are equal to those of $build"
exit $different
