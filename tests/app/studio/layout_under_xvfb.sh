#!/bin/sh
# layout_under_xvfb.sh PROGRAM FOLDER: a German keyboard, where Z and Y have changed places, ? is at
# the American -, and + at ]. Prints the log.
set -u
. "$(dirname "$0")/under_xvfb_start.sh"

setxkbmap de || fail "expected setxkbmap (x11-xkb-utils)"
throw_the_bowl
# xdotool finds the key that has the sign.
xdotool key ctrl+z
until_line "action: edit.undo"
xdotool key ctrl+y
until_line "action: edit.redo"
xdotool key question
until_line "action: help.keys"
xdotool key Escape
until_line "action: wheel.zero_force"
xdotool key ctrl+plus
until_line "action: view.larger"
xdotool key ctrl+minus
until_line "action: view.smaller"
xdotool key ctrl+q
until_line "prompt: quit"
xdotool key ctrl+d
until_line "window closed"
until_ended
cat "$log"
