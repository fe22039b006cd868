#!/bin/sh
# sh tests/app/studio/references.sh PROGRAM FOLDER: renders the pictures that window_look_test.cpp
# compares. Use tests/app/studio/references as FOLDER to renew them; then inspect them.
set -eu
program=$(realpath "$1") folder=$(realpath "$2")
cd "$(dirname "$0")/../../.."
pots=$(mktemp -d)
trap 'rm -rf "$pots"' EXIT
for sample in bowl vase; do
  "$program" throw -q "samples/$sample.scene.json" -o "$pots/$sample.pot.json"
done
# picture SCRIPT POT THEME: the view of a half-size window, in few colours to keep it small.
picture() {
  "$program" studio "$2" --script "samples/window/$1.script" \
    --screenshot "$pots/whole.png" --theme "$3" --size 640x400 --scale 0.5
  convert "$pots/whole.png" -crop 480x330+31+13 +repage +dither -colors 64 -strip \
    -define png:compression-level=9 "$folder/$1.png"
}
picture throw "$pots/vase.pot.json" dark
picture walls "$pots/vase.pot.json" light
picture top "$pots/bowl.pot.json" light
picture front "$pots/bowl.pot.json" dark
picture fallen samples/collapse.scene.json dark
