#!/bin/sh
# sh tests/bench/killed_at_random.sh PROGRAM [COUNT [SEED]]: measures the work that a crash loses.
# Ends the window with kill -9 at COUNT random moments of a stroke (default 50), and lets the disk
# of the journal fill up at as many random moments. Prints a line for each, and fails if a killed
# stroke lost more than the last 100 ms, if a full disk was not reported, or if the next window did
# not offer the work. Needs xvfb and xdotool; the full disk needs the right to mount a small tmpfs.
set -u
[ $# -ge 1 ] || { sed -n '2,6s/^# //p' "$0" >&2; exit 2; }
program=$(realpath "$1") count=${2:-50} seed=${3:-1}
here=$(cd "$(dirname "$0")/../.." && pwd)
folder=$(mktemp -d)
set -- "$program" "$folder"
. "$here/tests/app/studio/under_xvfb_start.sh"
worst_ms=0 lost=0
# random LOW HIGH: a whole number, from the seed and the round.
random() {
  awk -v seed="$seed$round$1" -v low="$1" -v high="$2" \
    'BEGIN { srand(seed); rand(); printf "%d\n", low + rand() * (high - low) }'
}
# begin_stroke: a stroke into the lump that continues until the button is released.
begin_stroke() {
  xdotool mousemove --window "$window" 833 420 mousedown 1
  until_line "stroke started"
  for x in 803 783 763 753 748; do xdotool mousemove --window "$window" "$x" 420 sleep 0.03; done
}
# offered: opens the next window and reports whether it offers the work.
offered() {
  wait "$studio" 2>/dev/null
  xdotool mouseup 1
  start_window
  has_line "recovery offered: 1" 1
  offer=$?
  kill -9 "$studio"
  wait "$studio" 2>/dev/null
  return $offer
}
killed_round() {
  rm -rf "$folder/state"
  start_window "$here/samples/bowl.scene.json"
  untouched=$(journal_size)
  begin_stroke
  wait_until "the tool to touch the clay" touched
  journal=$(ls "$folder"/state/claystack/recovery/*)
  after_ms=$(random 0 1500)
  sleep "$(printf '%d.%03d' $((after_ms / 1000)) $((after_ms % 1000)))"
  # A stopped window writes no more, so the last line is that of the moment of the kill.
  kill -STOP "$studio"
  stopped=$(date +%s%N)
  written=$(date -r "$journal" +%s%N)
  kill -9 "$studio"
  ms=$(((stopped - written) / 1000000))
  offered && answer=offered || { answer="NOT OFFERED"; lost=$((lost + 1)); }
  [ "$ms" -le "$worst_ms" ] || worst_ms=$ms
  echo "killed $round: $ms ms after the last line; $answer"
}
full_round() {
  rm -rf "$folder/state"
  mkdir -p "$folder/state"
  mount -t tmpfs -o "size=$(random 12 60)k" none "$folder/state" 2>/dev/null || return 1
  start_window "$here/samples/bowl.scene.json"
  begin_stroke
  wait_until "a report of the full disk" has_line "A crash would lose strokes" 1
  kill -9 "$studio"
  offered && answer=offered || { answer="NOT OFFERED"; lost=$((lost + 1)); }
  bytes=$(journal_size)
  umount "$folder/state"
  echo "full $round: reported with $bytes bytes written; $answer"
}
for round in $(seq "$count"); do killed_round; done
full=0
for round in $(seq "$count"); do
  full_round || { echo "full disk: not tested, no right to mount a tmpfs"; break; }
  full=$((full + 1))
done
echo "kill -9 at $count moments, full disk at $full: at most $worst_ms ms after the last line; $lost not offered"
rm -rf "$folder"
[ "$lost" -eq 0 ] && [ "$worst_ms" -le 100 ]
