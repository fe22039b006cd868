#!/bin/sh
# declined_under_xvfb.sh PROGRAM FOLDER: the journal of a killed window is not recovered. If it is
# ignored, it stays and is offered again; its button, and the answer to a question, delete
# it.
set -u
. "$(dirname "$0")/under_xvfb_start.sh"
journals() { ls "$folder/state/claystack/recovery"; }
close_window() {
  xdotool key --window "$window" ctrl+q
  until_line "window closed"
  until_ended
}

throw_the_bowl
kill -9 "$studio"
wait "$studio" 2>/dev/null
left=$(journals)
[ "$(echo "$left" | wc -l)" -eq 1 ] || fail "expected one journal, found: $left"
cp "$folder/state/claystack/recovery/$left" "$folder/before"

# Another work leaves the journal unchanged.
start_window "$folder/lump.scene.json"
grep -q "recovery offered: 1" "$log" || fail "expected an offer to recover"
close_window
[ "$(journals)" = "$left" ] || fail "expected $left alone, found: $(journals)"
cmp "$folder/state/claystack/recovery/$left" "$folder/before" || fail "expected $left unchanged"

start_window
grep -q "recovery offered: 1" "$log" || fail "expected the offer again"
xdotool mousemove --window "$window" 848 228 sleep 0.2 click 1
until_line "prompt: discard"
[ "$(journals)" = "$left" ] || fail "expected a question before $left is deleted"
xdotool key --window "$window" ctrl+shift+d
until_line "discarded: .*$left"
[ -z "$(journals)" ] || fail "expected no journal, found: $(journals)"
close_window

start_window
close_window
grep -q "recovery offered" "$log" && fail "expected no offer of a discarded work"
exit 0
