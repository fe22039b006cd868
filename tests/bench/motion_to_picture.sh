#!/bin/sh
# sh tests/bench/motion_to_picture.sh PROGRAM: measures the delay of the picture of the window
# behind the mouse, and the frame rate while throwing, at 1280x800. Moves the mouse over the sample
# bowl under Xvfb, 60 times a second for 5 s, then throws a stroke of 5 s in the same way, and
# prints the figures of the window. Needs xvfb and xdotool.
set -eu
[ $# -eq 1 ] || { sed -n '2,5s/^# //p' "$0" >&2; exit 2; }
program=$(realpath "$1")
here=$(cd "$(dirname "$0")/../.." && pwd)
folder=$(mktemp -d)
set -- "$program" "$folder"
. "$here/tests/app/studio/under_xvfb_start.sh"
start_window "$here/samples/bowl.scene.json"
# wave FROM TO: 300 motions there and back.
wave() {
  awk -v from="$1" -v to="$2" -v window="$window" 'BEGIN {
    for (i = 0; i < 300; ++i) {
      part = (1 - cos(i * 0.2)) / 2
      printf "mousemove --window %s %d 420 sleep 0.0166\n", window, from + part * (to - from)
    }
  }' | xdotool -
}
wave 850 760
xdotool mousemove --window "$window" 833 420 mousedown 1
until_line "stroke started"
wave 833 740
xdotool mouseup 1
until_line "stroke ended"
xdotool key ctrl+q
until_line "prompt: quit"
xdotool key ctrl+d
until_ended
grep -e "motion to picture" -e "frames while moving" "$log"
rm -rf "$folder"
