# Sourced by scripts: a screen of its own, and the window on it. Sets folder, log, program; waits on
# the program's log, never on time alone.
program=$1
folder=$2
export XDG_CONFIG_HOME="$folder/config" XDG_STATE_HOME="$folder/state"
unset WAYLAND_DISPLAY
# Where devices are emulated, they are for the program: not for the screen, nor for the hand.
emulation=${LD_PRELOAD:-}
unset LD_PRELOAD
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

# start_window [ARGUMENT...]: in $window, its process in $studio. Looks for no device, but for
# $device.
start_window() {
  : >"$log"
  LD_PRELOAD=$emulation "$program" studio --log --device "${device:-none}" --size 1280x800 "$@" >"$log" 2>&1 &
  studio=$!
  until_line "window open"
  window=$(xdotool search --sync --onlyvisible --name Claystack | head -1)
  xdotool windowfocus --sync "$window"
}

# throw_a_stroke: from beside the lump into it.
throw_a_stroke() {
  strokes=$(grep -c "stroke begun" "$log")
  xdotool mousemove --window "$window" 930 420 mousedown 1
  until_line "stroke begun" $((strokes + 1))
  for x in 900 880 860 850 845 840; do xdotool mousemove --window "$window" $x 420; done
  xdotool mouseup 1
  until_line "stroke ended" $((strokes + 1))
}

# throw_the_bowl: the window on the first card of the gallery, and a stroke.
throw_the_bowl() {
  start_window
  xdotool mousemove --window "$window" 370 360 click 1
  until_line "work begun: bowl"
  throw_a_stroke
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
cd "$folder" || exit 1
