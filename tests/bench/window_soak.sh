#!/bin/sh
# sh tests/bench/window_soak.sh PROGRAM [CYCLES]: checks that the memory of the window does not grow.
# Repeats a scripted throw on a new lump CYCLES times (default 400, some minutes): two strokes,
# undo, redo, trimming, a save. Samples the resident memory after each save, and fails if the median
# of the last quarter is more than 5 % above that of the second, if the clay's volume has an error, or
# if the program ends before its script. PROGRAM is claystack-studio; no screen is needed.
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
saved=0
while kill -0 "$studio" 2>/dev/null; do
  now=$(grep -c '^saved: ' "$scratch/log" || true)
  if [ "$now" -gt "$saved" ]; then
    saved=$now
    awk '/^VmRSS/ { print $2 }' "/proc/$studio/status" >>"$scratch/kib" 2>/dev/null || true
  fi
  sleep 0.2
done
status=0
wait "$studio" || status=$?
studio=
[ "$status" -eq 0 ] || { tail -3 "$scratch/log" >&2; echo "the window ended with status $status" >&2; exit 1; }
# median FIRST LAST: of the samples in this range.
median() { sed -n "$1,$2p" "$scratch/kib" | sort -n | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }
count=$(wc -l <"$scratch/kib")
[ "$count" -ge 8 ] || { echo "expected at least 8 samples of memory, found $count" >&2; exit 1; }
early=$(median $((count / 4)) $((count / 2)))
late=$(median $((count * 3 / 4)) "$count")
echo "$cycles cycles, $count samples: $((early / 1024)) MiB in the second quarter, $((late / 1024)) MiB in the last"
[ $((late * 100)) -le $((early * 105)) ]
