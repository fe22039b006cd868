#!/bin/sh
# sh tests/bench/window_soak.sh PROGRAM [CYCLES]: checks that the window neither grows nor slows down.
# Repeats a scripted throw on a new lump CYCLES times (default 400, some minutes): two strokes,
# undo, redo, trimming, a save. Samples the resident memory and the processor time of a cycle after
# each save. Fails if the median memory of the last quarter is more than 5 % above that of the second;
# if, of 400 cycles or more, a cycle takes 25 % more processor time; if the clay's volume has an error;
# or if the program ends before its script. PROGRAM is claystack-studio; no screen is needed.
set -eu
[ $# -ge 1 ] || { sed -n '2,7s/^# //p' "$0" >&2; exit 2; }
program=$(realpath "$1") cycles=${2:-400}
scene=$(realpath "$(dirname "$0")/../../samples/bowl.scene.json")
[ "$cycles" -ge 8 ] || { echo "$0: expected at least 8 cycles, found $cycles" >&2; exit 2; }
scratch=$(mktemp -d)
studio=
trap '[ -z "$studio" ] || kill "$studio" 2>/dev/null || true; rm -rf "$scratch"' EXIT
stroke() { printf 'point %s\npress left\npoint %s over 0.3\nrelease left\nwait 0.1\n' "$1" "$2"; }
for cycle in $(seq "$cycles"); do
  printf 'open "%s"\nwait 0.1\ndo tool.press\n' "$scene"
  stroke "62 20" "44 20"
  stroke "62 35" "46 35"
  printf 'do edit.undo\ndo edit.redo\ndo tool.trim\n'
  stroke "62 28" "48 28"
  printf 'expect volume_error 0\nexpect strokes 3\nsave "%s/%s.work"\n' "$scratch" "$cycle"
done >"$scratch/soak.script"
XDG_CONFIG_HOME=$scratch/config XDG_STATE_HOME=$scratch/state "$program" --log \
  --script "$scratch/soak.script" >"$scratch/log" 2>&1 &
studio=$!
: >"$scratch/kib"
: >"$scratch/ticks"
saved=0 used=0
while kill -0 "$studio" 2>/dev/null; do
  now=$(grep -c '^saved: ' "$scratch/log" || true)
  if [ "$now" -gt "$saved" ] && [ -r "/proc/$studio/stat" ]; then
    ticks=$(awk '{ print $14 + $15 }' "/proc/$studio/stat" 2>/dev/null || echo "$used")
    [ "$saved" -eq 0 ] || echo $((1000 * (ticks - used) / (now - saved))) >>"$scratch/ticks"
    saved=$now used=$ticks
    awk '/^VmRSS/ { print $2 }' "/proc/$studio/status" >>"$scratch/kib" 2>/dev/null || true
  fi
  sleep 0.2
done
status=0
wait "$studio" || status=$?
studio=
[ "$status" -eq 0 ] || { tail -3 "$scratch/log" >&2; echo "the window ended with status $status" >&2; exit 1; }
# median FILE FIRST LAST: of the samples in this range.
median() { sed -n "$2,$3p" "$1" | sort -n | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }
# early FILE, late FILE: the median of the second quarter, and of the last.
early() { median "$1" $(($(wc -l <"$1") / 4)) $(($(wc -l <"$1") / 2)); }
late() { median "$1" $(($(wc -l <"$1") * 3 / 4)) "$(wc -l <"$1")"; }
count=$(wc -l <"$scratch/kib")
[ "$count" -ge 8 ] || { echo "expected at least 8 samples, found $count" >&2; exit 1; }
kib=$(early "$scratch/kib") kib_late=$(late "$scratch/kib")
us=$((10 * $(early "$scratch/ticks"))) us_late=$((10 * $(late "$scratch/ticks")))
echo "$cycles cycles, $count samples, second and last quarter: $((kib / 1024)) and $((kib_late / 1024)) MiB," \
  "$((us / 1000)) and $((us_late / 1000)) ms of a processor for each cycle"
[ $((kib_late * 100)) -le $((kib * 105)) ] || { echo "the memory grows" >&2; exit 1; }
[ "$cycles" -lt 400 ] || [ $((us_late * 100)) -le $((us * 125)) ] || { echo "a cycle takes longer and longer" >&2; exit 1; }
