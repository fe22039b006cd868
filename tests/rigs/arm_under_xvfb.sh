#!/bin/sh
# arm_under_xvfb.sh PROGRAM FOLDER: the window with an arm that comes, throws, is unplugged in
# mid-stroke and comes back, and the mouse meanwhile. FOLDER has
# bowl.scene.json; what is asked of the arm, and its answers, are files there. Leaves the journal.
set -u
. "$(dirname "$0")/../app/studio/under_xvfb_start.sh"
device=auto

# until_file NAME
has_file_or_ended() { [ -e "$folder/$1" ] || ended; }
until_file() {
  wait_until "the arm to say: $1" has_file_or_ended "$1"
  [ -e "$folder/$1" ] || fail "the window ended before the arm said: $1"
}
ask() { : >"$folder/$1"; }
# press_by_mouse: from beside the lump into it, and holds there.
press_by_mouse() {
  xdotool mousemove --window "$window" 930 420 mousedown 1
  until_line "stroke started" "$1"
  # The tool goes no faster than a hand: a drag that is over at once has not got to the clay.
  for x in 900 880 860 840 820 800; do
    xdotool mousemove --window "$window" $x 420 sleep 0.2
  done
}

cd "$folder" || exit 1
start_window bowl.scene.json
ask plug
until_line "device: Novint Falcon"
until_line "force: ramping"
ask press
until_file felt

ask pull
until_line "stroke ended"
until_line "error: usb:1-1: unplugged; plug it in again; the mouse is in use now"
press_by_mouse 1
xdotool mouseup 1
until_line "stroke ended" 2

# It comes back while the mouse has the clay, with its grip where the clay is.
press_by_mouse 2
ask again
until_file opened
xdotool mousemove --window "$window" 798 420
[ "$(grep -c "device: Novint Falcon" "$log")" -eq 1 ] || fail "expected the mouse to keep the clay"
xdotool mouseup 1
until_line "stroke ended" 3
until_line "device: Novint Falcon" 2
until_file held
ask away
until_file felt_again

# A signal that asks to stop leaves the journal.
kill -TERM "$studio"
until_ended
cp "$folder"/state/claystack/recovery/* "$folder/journal.work" || fail "expected one journal"
cat "$log"
