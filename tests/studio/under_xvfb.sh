#!/bin/sh
# under_xvfb.sh PROGRAM FOLDER: the window on a screen of its own, with real events. Waits on the
# program's log, never on time alone. Prints the log.
set -u
program=$1
folder=$2
export XDG_CONFIG_HOME="$folder/config" XDG_STATE_HOME="$folder/state"
unset WAYLAND_DISPLAY
log=$folder/log
: >"$log"

fail() {
  echo "under_xvfb: $1" >&2
  cat "$log" >&2
  exit 1
}
# until_line TEXT [COUNT]: so many lines of the log have it.
until_line() {
  for _ in $(seq 600); do
    [ "$(grep -c -- "$1" "$log")" -ge "${2:-1}" ] && return 0
    kill -0 "$studio" 2>/dev/null || break
    sleep 0.1
  done
  [ "$(grep -c -- "$1" "$log")" -ge "${2:-1}" ] || fail "expected a line with: $1"
}

# The server picks a number that is free, and tells it when it is ready.
Xvfb -displayfd 3 -screen 0 1280x800x24 -nolisten tcp -noreset 3>"$folder/display" 2>/dev/null &
server=$!
studio=
trap 'kill $studio $server 2>/dev/null' EXIT
for _ in $(seq 300); do
  [ -s "$folder/display" ] && break
  sleep 0.1
done
[ -s "$folder/display" ] || fail "Xvfb did not start"
DISPLAY=:$(cat "$folder/display")
export DISPLAY

"$program" studio --log --size 1280x800 >"$log" 2>&1 &
studio=$!
until_line "window open"
window=$(xdotool search --sync --onlyvisible --name Claystack | head -1)
xdotool windowfocus --sync "$window"
# The first card of the gallery is the bowl.
xdotool mousemove --window "$window" 370 360 click 1
until_line "work begun: bowl"
# From beside the lump into it.
xdotool mousemove --window "$window" 930 420 mousedown 1
until_line "stroke begun"
for x in 900 880 860 850 845 840; do xdotool mousemove --window "$window" $x 420; done
xdotool mouseup 1
until_line "stroke ended"
# Ten short taps are ten undos and redos: none is lost.
for i in 1 2 3 4 5; do
  xdotool key --window "$window" --delay 0 ctrl+z
  xdotool key --window "$window" --delay 0 ctrl+shift+z
done
until_line "action: edit.redo" 5
[ "$(grep -c "action: edit.undo" "$log")" -eq 5 ] || fail "expected 5 undos"
xdotool key --window "$window" ctrl+q
until_line "prompt: quit"
xdotool key --window "$window" Escape
until_line "action: wheel.zero_force"
# The window's own way out asks again.
xdotool key --window "$window" ctrl+q
until_line "prompt: quit" 2
xdotool key --window "$window" ctrl+d
until_line "window closed"
wait "$studio" || fail "expected exit status 0"
cat "$log"
