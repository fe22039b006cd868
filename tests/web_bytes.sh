#!/bin/sh
# Throws and exports every sample with the program as WebAssembly, under node, and compares the files
# with those of the native program, byte by byte. Needs build/web (samples/web_page.sh) and
# build/release.
set -eu
cd "$(dirname "$0")/.."
native=$(realpath "${1:-build/release/app/claystack}")
module=$PWD/build/web/app/claystack.js
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/native" "$folder/web"
top=$PWD
differ=0
compare() {
  if cmp "$folder/native/$1" "$folder/web/$1"; then echo "same: $1"; else differ=1; fi
}
run() {  # NAME ARGUMENTS: both programs, each in its folder
  (cd "$folder/native" && "$native" "$@" >out.txt 2>&1) || true
  (cd "$folder/web" && node "$top/tests/web/claystack.mjs" "$module" "$@" >out.txt 2>&1) || true
}
for sample in bowl vase bottle cylinder collapse; do
  for side in native web; do cp samples/$sample.scene.json samples/$sample.session "$folder/$side"; done
  run throw $sample.scene.json -o $sample.pot.json
  compare $sample.pot.json
  run throw $sample.scene.json -o $sample.pot.cbor
  compare $sample.pot.cbor
  if [ $sample = collapse ]; then  # no section: meshes only
    run export $sample.pot.json $sample.stl $sample.obj $sample.drc $sample.3mf
    for ending in stl obj drc 3mf; do compare $sample.$ending; done
    continue
  fi
  run export $sample.pot.json $sample.stl $sample.obj $sample.drc $sample.3mf $sample.glb $sample.ply \
    $sample.step $sample.svg $sample.dxf $sample.csv --certificate
  for ending in stl obj drc 3mf glb ply step svg dxf csv stl.certificate.json obj.certificate.json \
      drc.certificate.json; do
    compare $sample.$ending
  done
  run check $sample.stl --json
  compare out.txt
done
exit $differ
