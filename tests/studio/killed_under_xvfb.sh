#!/bin/sh
# killed_under_xvfb.sh PROGRAM FOLDER: the window is killed in mid-stroke, and what was thrown until
# then is offered to the next one. Prints how long the stroke lasted at least, and how much of it
# was recovered [ms].
set -u
. "$(dirname "$0")/under_xvfb_start.sh"
now_ms() { echo $(($(date +%s%N) / 1000000)); }

throw_the_bowl
# One that does not end.
xdotool mousemove --window "$window" 930 420 mousedown 1
until_line "stroke begun" 2
begun=$(now_ms)
for x in 900 880 860 850 845 840 835 830; do
  xdotool mousemove --window "$window" $x 420 sleep 0.1
done
killed=$(now_ms)
kill -9 "$studio"
wait "$studio" 2>/dev/null
xdotool mouseup 1

start_window
grep -q "recovery offered: 1" "$log" || fail "expected an offer to recover"
xdotool key --window "$window" ctrl+r
until_line "recovered: "
cat "$log" >"$folder/log_of_recovery"
xdotool key --window "$window" ctrl+z
until_line "action: edit.undo"
xdotool key --window "$window" ctrl+shift+z
until_line "action: edit.redo"
# The journal is a work file: what is in it is told by the command.
journal=$(sed -n 's/^recovered: //p' "$log")
"$program" throw "$journal" --list --json >"$folder/tree.json" || fail "expected a work: $journal"
xdotool key --window "$window" ctrl+q
until_line "prompt: quit"
xdotool key --window "$window" ctrl+d
until_line "window closed"
wait "$studio" || fail "expected exit status 0"
[ ! -e "$journal" ] || fail "expected no journal after a clean end"
echo "lasted_ms $((killed - begun))"
