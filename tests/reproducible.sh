#!/bin/sh
# reproducible.sh [TARGETS ...]: builds the engine (or the targets of the preset release that are
# named) in two folders of different names, without ccache, and compares every library and program.
set -eu
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
preset=engine-only
[ $# -eq 0 ] || preset=release
for copy in first second/of/another/length; do
  mkdir -p "$scratch/$copy"
  git archive HEAD | tar -x -C "$scratch/$copy"
  (cd "$scratch/$copy" && cmake --preset $preset -DCLAYSTACK_CCACHE= >/dev/null &&
    cmake --build --preset $preset ${1:+--target "$@"} >/dev/null)
done
(cd "$scratch/first/build/$preset" &&
  find . -type f \( -name '*.a' -o -perm -u+x ! -name '*.sh' ! -name '*.bin' ! -name '*.out' \) |
  grep -v CMakeFiles | sort | xargs sha256sum) >"$scratch/sums"
cat "$scratch/sums"
[ -s "$scratch/sums" ] || { echo "reproducible.sh: nothing was built"; exit 1; }
(cd "$scratch/second/of/another/length/build/$preset" && sha256sum --quiet -c "$scratch/sums")
echo "two builds in different folders: the same bytes"
