# Sourced by scripts: starts a virtual screen and the window on it. Sets folder, log, program. Waits
# for lines of the log, always with a deadline, never for a fixed time.
program=$1
folder=$2
export XDG_CONFIG_HOME="$folder/config" XDG_STATE_HOME="$folder/state"
unset WAYLAND_DISPLAY
# Emulated devices are for the program only, not for Xvfb and xdotool.
emulation=${LD_PRELOAD:-}
unset LD_PRELOAD
log=$folder/log
: >"$log"

fail() {
  echo "under_xvfb: $1" >&2
  cat "$log" >&2
  exit 1
}
# wait_until WHAT COMMAND...: waits until the command succeeds; fails with WHAT at the deadline.
deadline_s=120
wait_until() {
  what=$1
  shift
  end=$(($(date +%s) + deadline_s))
  until "$@"; do
    [ "$(date +%s)" -le $end ] || fail "waited $deadline_s s for $what"
    sleep 0.05
  done
}
has_line() { [ "$(grep -c -- "$1" "$log")" -ge "$2" ]; }
ended() { ! kill -0 "$studio" 2>/dev/null; }
# until_line TEXT [COUNT]: waits until COUNT lines of the log contain TEXT.
has_line_or_ended() { has_line "$@" || ended; }
until_line() {
  wait_until "a line with: $1" has_line_or_ended "$1" "${2:-1}"
  has_line "$1" "${2:-1}" || fail "the window ended without a line with: $1"
}
# until_ended: waits for the window to end with exit status 0.
until_ended() {
  wait_until "the window's end" ended
  wait "$studio" || fail "expected exit status 0"
}

# start_window [ARGUMENT...]: sets $window and the process $studio. Uses no device but $device.
start_window() {
  : >"$log"
  LD_PRELOAD=$emulation "$program" studio --log --device "${device:-none}" --size 1280x800 "$@" >"$log" 2>&1 &
  studio=$!
  until_line "window open"
  window=$(timeout $deadline_s xdotool search --sync --onlyvisible --name Claystack | head -1)
  [ -n "$window" ] || fail "waited $deadline_s s for the window to be visible"
  timeout $deadline_s xdotool windowfocus --sync "$window" ||
    fail "waited $deadline_s s for the window to have the focus"
}

# throw_a_stroke: moves from beside the lump into it, until the journal holds poses: it has those of
# a stroke from its first contact on.
journal_size() { cat "$folder"/state/claystack/recovery/* | wc -c; }
touched() { [ "$(journal_size)" -gt $((untouched + 2000)) ]; }  # a scene has fewer bytes
throw_a_stroke() {
  strokes=$(grep -c "stroke started" "$log")
  untouched=$(journal_size)
  xdotool mousemove --window "$window" 833 420 mousedown 1
  until_line "stroke started" $((strokes + 1))
  for x in 803 783 763 753 748 743; do xdotool mousemove --window "$window" $x 420; done
  wait_until "the tool to touch the clay" touched
  xdotool mouseup 1
  until_line "stroke ended" $((strokes + 1))
}

# throw_the_bowl: opens the lump of the first card of the gallery and throws a stroke.
throw_the_bowl() {
  start_window
  xdotool mousemove --window "$window" 300 483 click 1
  until_line "work started: bowl"
  throw_a_stroke
}

# The server picks a free display number and writes it when it is ready.
Xvfb -displayfd 3 -screen 0 1280x800x24 -nolisten tcp -noreset 3>"$folder/display" 2>/dev/null &
server=$!
studio=
trap 'kill $studio $server 2>/dev/null' EXIT
trap 'exit 1' TERM
wait_until "the screen of Xvfb" test -s "$folder/display"
DISPLAY=:$(cat "$folder/display")
export DISPLAY
cd "$folder" || exit 1
