#!/bin/sh
# sh samples/window/pictures.sh PROGRAM FOLDER [NAME...]: renders the panels and dialogs of the window
# in both themes, in a small, a normal, a large and a double-scale size, as FOLDER/NAME-THEME-SIZE-SCALE.png; all
# pictures, or those named. With ImageMagick, FOLDER/sheet-THEME-SIZE-SCALE-NUMBER.png shows twelve of
# them beside each other. They are for inspection by eye; no test compares them. THEMES and LOOKS
# choose: THEMES=dark LOOKS="800x600x1" draws one of each. Exit status 1 if a script fails.
set -eu
[ $# -ge 2 ] || { sed -n '2,7s/^# //p' "$0" >&2; exit 2; }
themes=${THEMES:-dark light} looks=${LOOKS:-800x600x1 1280x800x1 2560x1440x1 2560x1440x2}
program=$(realpath "$1")
mkdir -p "$2"
out=$(realpath "$2")
shift 2
wanted=" $* "
failed=0
cd "$(dirname "$0")/../.."
pots=$out/pots
mkdir -p "$pots"

for sample in bowl vase bottle cylinder collapse; do
  [ -e "$pots/$sample.pot.json" ] ||
    "$program" throw -q "samples/$sample.scene.json" -o "$pots/$sample.pot.json"
done
# The finest rings: a lump of 100 000.
sed -e 's/"rings": [0-9]*/"rings": 100000/' -e 's/"ring_height_mm": [0-9.]*/"ring_height_mm": 0.001/' \
  -e 's/"max_rings": [0-9]*/"max_rings": 0/' samples/vase.scene.json >"$pots/fine.scene.json"
# One ring, as flat as a plate.
sed -e 's/"rings": [0-9]*/"rings": 1/' -e 's/"ring_height_mm": [0-9.]*/"ring_height_mm": 4/' \
  -e 's/"outer_radius_mm": [0-9.]*/"outer_radius_mm": 120/' samples/vase.scene.json >"$pots/plate.scene.json"

# The scripts name files below samples; their exports stay in FOLDER.
ln -sfn "$PWD/samples" "$out/samples"
cd "$out"

# picture NAME SCRIPT [FILE]
picture() {
  [ "$wanted" = "  " ] || case $wanted in *" $1 "*) ;; *) return 0 ;; esac
  for theme in $themes; do
    for look in $looks; do
      size=${look%x*} scale=${look##*x}
      # Files of the picture before: the window would ask whether to replace them.
      rm -f "$out"/*.3mf "$out"/*.work
      # The scripts use window coordinates at scale 1.
      awk -v s="$scale" '$1 == "move" { $2 *= s; $3 *= s } 1' "samples/window/$2.script" >"$out/script"
      "$program" studio ${3:+"$3"} --script "$out/script" --screenshot "$out/$1-$theme-$size-$scale.png" \
        --theme "$theme" --size "$size" --scale "$scale" && continue
      echo "$1-$theme-$size: failed" >&2
      failed=1
    done
  done
  rm -f "$out/script"
}

picture gallery gallery
picture hint hint samples/bowl.scene.json
picture lesson lesson
picture path path
picture diagnostics diagnostics "$pots/vase.pot.json"
picture paused paused "$pots/vase.pot.json"
picture throw throw "$pots/vase.pot.json"
picture pinch pinch "$pots/cylinder.pot.json"
picture trim trim "$pots/bowl.pot.json"
picture walls walls "$pots/vase.pot.json"
picture limit limit "$pots/vase.pot.json"
picture goal goal "$pots/vase.pot.json"
picture account account "$pots/vase.pot.json"
picture branches branches "$pots/vase.pot.json"
picture export export "$pots/bowl.pot.json"
picture exported exported "$pots/vase.pot.json"
picture picture picture "$pots/vase.pot.json"
picture turntable turntable "$pots/vase.pot.json"
picture marks marks "$pots/vase.pot.json"
picture import import
picture settings settings "$pots/bowl.pot.json"
picture quit quit "$pots/vase.pot.json"
picture shortcuts shortcuts "$pots/bowl.pot.json"
picture open open "$pots/bowl.pot.json"
picture works works "$pots/bowl.pot.json"
picture menu_file menu_file "$pots/bowl.pot.json"
picture menu_view menu_view "$pots/bowl.pot.json"
picture fault fault "$pots/bowl.pot.json"
picture falling falling samples/collapse.scene.json
picture fallen fallen samples/collapse.scene.json
picture quarter quarter "$pots/bottle.pot.json"
picture top top "$pots/bowl.pot.json"
picture front front "$pots/cylinder.pot.json"
picture sizing sizing "$pots/vase.pot.json"
picture fine throw "$pots/fine.scene.json"
picture plate plain "$pots/plate.scene.json"
picture lump plain samples/bottle.scene.json

# sheet THEME SIZE SCALE: contact sheets, each picture 640 px wide.
sheet() {
  set -- "$1-$2-$3" "$out"/*-"$1-$2-$3.png"
  [ -e "$2" ] || return 0
  name=$1
  shift
  montage "$@" -resize 640x -tile 3x4 -geometry +6+6 "$out/sheet-$name-%02d.png"
}
if command -v montage >/dev/null; then
  rm -f "$out"/sheet-*.png
  for theme in $themes; do
    for look in $looks; do sheet "$theme" "${look%x*}" "${look##*x}"; done
  done
fi
exit $failed
