#!/bin/sh
# debian13.sh [BUILD]: builds the last commit in a Debian 13 below BUILD/debian13 (default
# build/release; debootstrap, root), runs the tests of core, engine, export and import there,
# and compares pots and exports of the samples with those of BUILD, byte for byte. The system and
# its ccache stay for the next run. The first run takes as long as a build from scratch.
set -eu
cd "$(dirname "$0")/.."
build=$(realpath "${1:-build/release}")
root=$build/debian13
suites="core_tests engine_tests engine_files_tests export_tests mesh_format_tests import_tests"
. tests/clean_debian.sh
sh samples/install_packages.sh debootstrap
[ -e "$root/etc/debian_version" ] || clean_debian trixie "$root" "$build/debootstrap13.log"
mounts="proc dev/shm dev"
unmount() { for folder in $mounts; do umount "$root/$folder" 2>/dev/null || true; done; }
trap unmount EXIT
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
mount -t tmpfs tmpfs "$root/dev/shm"

echo "== sources of the last commit"
# The time of extraction (-m), not of the commit: ninja builds all files again, mostly from ccache.
mkdir -p "$root/opt/claystack"
git archive HEAD | tar -x -m -C "$root/opt/claystack"
echo "== README: packages, build, first pot"
inside "$root" sh -c 'cd /opt/claystack && sh samples/first_pot.sh'
echo "== tests"
# shellcheck disable=SC2086  # a list of words
inside "$root" sh -c "cd /opt/claystack &&
  sh samples/install_packages.sh libxml2-utils admesh draco librsvg2-bin &&
  cmake --build --preset release --target $(echo $suites) &&
  cd build/release && for suite in $suites; do ./tests/*/\$suite --gtest_brief=1 || exit 1; done"

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
inside "$root" sh -c 'cd /opt/claystack && sh pots.sh build/release/app/claystack /opt/pots'
sh "$root/opt/claystack/pots.sh" "$build/app/claystack" "$build/pots12"
different=0
for file in "$build"/pots12/*; do
  cmp -s "$file" "$root/opt/pots/$(basename "$file")" ||
    { echo "different: $(basename "$file")"; different=1; }
done
[ "$different" = 0 ] && echo "$(ls "$build/pots12" | wc -l) files are equal to those of $build"
exit $different
