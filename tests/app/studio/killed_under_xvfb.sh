#!/bin/sh
# killed_under_xvfb.sh PROGRAM FOLDER: kills the window during a stroke; the next window offers to
# recover its journal. Leaves a copy of it (before.work) and the recovered tree (tree.json).
set -u
. "$(dirname "$0")/under_xvfb_start.sh"

throw_the_bowl
# A stroke that is not completed.
journal=$(ls "$folder"/state/claystack/recovery/*)
size() { wc -c <"$journal"; }
begun=$(size)
grew() { [ "$(size)" -gt $((begun + 2000)) ]; }
xdotool mousemove --window "$window" 833 420 mousedown 1
until_line "stroke started" 2
for x in 803 783 763 753 748 743 738 733; do
  xdotool mousemove --window "$window" $x 420 sleep 0.1
done
wait_until "the journal to contain part of the unfinished stroke" grew
cp "$journal" "$folder/before.work"
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
# The journal is a work file, so the command lists its contents.
journal=$(sed -n 's/^recovered: //p' "$log")
"$program" throw "$journal" --list --json >"$folder/tree.json" || fail "expected a work: $journal"
xdotool key --window "$window" ctrl+q
until_line "prompt: quit"
xdotool key --window "$window" ctrl+d
until_line "window closed"
until_ended
[ ! -e "$journal" ] || fail "expected no journal after a clean end"
