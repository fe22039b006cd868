#!/bin/sh
# arm_under_xvfb.sh PROGRAM FOLDER: the window with an arm that is connected, throws, is unplugged
# during a stroke and reconnected; the mouse throws in between. FOLDER contains bowl.scene.json.
# Requests to the arm and its answers are files in FOLDER. Leaves the journal.
set -u
. "$(dirname "$0")/../app/studio/under_xvfb_start.sh"
device=auto

# until_file NAME
has_file_or_ended() { [ -e "$folder/$1" ] || ended; }
until_file() {
  wait_until "the answer of the arm: $1" has_file_or_ended "$1"
  [ -e "$folder/$1" ] || fail "the window ended before the answer of the arm: $1"
}
request() { : >"$folder/$1"; }
# press_by_mouse N SHIFT: the stroke N moves from beside the lump into it, SHIFT pixels deeper than
# x = 703, and stays there.
press_by_mouse() {
  xdotool mousemove --window "$window" 833 420 mousedown 1
  until_line "stroke started" "$1"
  # The speed of the tool is limited, so the drag must last until it reaches the clay.
  for x in 803 783 763 743 723 $((703 - $2)); do
    xdotool mousemove --window "$window" $x 420 sleep 0.2
  done
}

cd "$folder" || exit 1
start_window bowl.scene.json
request plug
until_line "device: Novint Falcon"
until_line "force: ramping"
request press
until_file force_displayed

request pull
until_line "stroke ended"
until_line "error: usb:1-1: unplugged; plug it in again; the mouse is in use now"
press_by_mouse 1 0
xdotool mouseup 1
until_line "stroke ended" 2

# The arm is reconnected during a stroke of the mouse, with its grip inside the clay.
press_by_mouse 2 40
request reconnect
until_file opened
xdotool mousemove --window "$window" 661 420
[ "$(grep -c "device: Novint Falcon" "$log")" -eq 1 ] || fail "expected the mouse to keep the clay"
xdotool mouseup 1
until_line "stroke ended" 3
until_line "device: Novint Falcon" 2
until_file no_force
request retract
until_file force_displayed_again

# SIGTERM must leave the journal.
kill -TERM "$studio"
until_ended
cp "$folder"/state/claystack/recovery/* "$folder/journal.work" || fail "expected one journal"
cat "$log"
