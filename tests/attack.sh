#!/bin/bash
# attack.sh PROGRAM: runs every command under hostile conditions: closed and full standard streams,
# as the user nobody, without HOME, with a decimal comma, with limits of memory, files and file
# sizes, and under signals. A fault is a crash, a hang, a status above 4, a failure without a
# message, a file left behind or one that differs from that of an undisturbed run.
# Run it as root, or the part as nobody is left out. Prints one line per fault; exit status 1.
set -u
program=$(realpath "$1")
samples=$(realpath "$(dirname "$0")/../samples")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
chmod 755 "$scratch"
faults=0
runs=0

# The locale with a decimal comma, if the machine can make it.
if localedef -i de_DE -f UTF-8 "$scratch/de_DE.UTF-8" >/dev/null 2>&1; then
  export LOCPATH="$scratch"
else
  echo "left out: de_DE.UTF-8 (install the package locales)"
fi

# NAME|OUTPUTS|ARGUMENTS; outputs are made in the current folder.
commands="
throw|a.pot.json|throw $samples/cylinder.scene.json -o a.pot.json
trace|b.pot.json t.csv|throw $samples/cylinder.scene.json -o b.pot.json --trace t.csv
json|c.pot.json|throw $samples/cylinder.scene.json -o c.pot.json --json
live||throw $samples/cylinder.scene.json --device simulated --seconds 0.3 --record l.session -o l.pot.json
studio|w.png|studio in.pot.json --script $samples/window/plain.script --screenshot w.png --size 320x240
strokes|d.session|strokes $samples/cylinder.scene.json $samples/strokes/cylinder.strokes.json -o d.session
plan||plan $samples/bowl.scene.json
export|e.stl e.stl.certificate.json|export in.pot.json e.stl --certificate
many|e.obj e.drc e.ply e.3mf e.glb e.svg e.csv|export in.pot.json e.obj e.drc e.ply e.3mf e.glb e.svg e.csv --min-wall 1
copy|e.pot.cbor|export in.pot.json e.pot.cbor
check||check in.stl --min-wall 1 --certificate in.stl.certificate.json
check_3mf||check in.3mf --json
check_glb||check in.glb
check_ply||check in.ply
check_drc||check in.drc
check_pot||check in.pot.json --process earthenware
repair|r.stl|check in.obj --max-triangles 2000 -o r.stl
import|i.pot.json|import $samples/drawings/jug.svg -o i.pot.json
import_mesh|j.pot.cbor|import in.stl -o j.pot.cbor
render|p.png|render in.pot.json -o p.png --size 200x150
devices||devices
doctor||doctor --json
batch|k.jsonl|batch jobs.jsonl -q -j 2 -o k.jsonl
manual||manual export
help||--help
absent||export absent.pot.json x.stl
wrong||check jobs.jsonl
usage||throw --nothing
"

# fault TEXT: reports a fault. $name and $condition are set by the caller.
fault() {
  faults=$((faults + 1))
  echo "fault: $name, $condition: $1"
}

# folder NAME: a new one with the inputs.
fresh() {
  rm -rf "$scratch/run"
  mkdir "$scratch/run"
  cp "$scratch"/in.* "$scratch/jobs.jsonl" "$scratch/run" 2>/dev/null
  chmod 777 "$scratch/run"
  cd "$scratch/run" || exit 3
}

# Checks the status and the remaining files. $1: status; $2: signal that may have ended it, or 0.
judge() {
  runs=$((runs + 1))
  if [ "$1" -eq 124 ] || [ "$1" -eq 137 ]; then
    fault "takes longer than 60 s"
  elif [ "$1" -gt 4 ] && [ "$1" -ne $((128 + $2)) ]; then
    fault "status $1: $(head -c 200 "$scratch/err")"
  elif [ "$1" -ge 2 ] && [ "$1" -le 4 ] && [ "$messages" = yes ] && [ ! -s "$scratch/err" ]; then
    fault "status $1 without a message"
  fi
  litter=$(find . -name '.*claystack-*' | head -1)
  [ -z "$litter" ] || fault "left $litter"
  for output in $outputs; do
    [ "$name" != batch ] || continue
    # Without memory for OpenGL, a 3MF has no picture in it.
    case $condition in
    ulimit\ -v* | --memory*) [ "$output" != e.3mf ] || continue ;;
    esac
    [ ! -e "$output" ] || cmp -s "$output" "$scratch/good/$name/$output" ||
      fault "$output differs from that of an undisturbed run"
  done
}

# attempt CONDITION COMMAND...: runs the command, which may redirect its streams.
attempt() {
  condition=$1
  signal=0
  [ "$condition" != "output that no one reads" ] || signal=13
  shift
  fresh
  : >"$scratch/err"
  timeout -k 5 60 "$@" >"$scratch/out" 2>"$scratch/err" </dev/null
  judge $? $signal
}

# The inputs, and the files of an undisturbed run.
cd "$scratch" || exit 3
"$program" throw -q "$samples/cylinder.scene.json" -o in.pot.json &&
  "$program" export -q in.pot.json in.stl in.3mf in.glb in.ply in.drc in.obj --certificate --min-wall 1 || exit 3
rm -f in.3mf.certificate.json in.glb.certificate.json
echo '{"id": "a", "run": ["check", "in.stl"]}' >jobs.jsonl
echo '{"id": "b", "run": ["plan", "'"$samples"'/bowl.scene.json"]}' >>jobs.jsonl
echo "$commands" | while IFS='|' read -r name outputs arguments; do
  [ -n "$name" ] || continue
  fresh
  mkdir -p "$scratch/good/$name"
  # shellcheck disable=SC2086  # a list of words
  "$program" $arguments >/dev/null 2>&1 </dev/null
  for output in $outputs; do [ ! -e "$output" ] || cp "$output" "$scratch/good/$name/"; done
done

while IFS='|' read -r name outputs arguments; do
  [ -n "$name" ] || continue
  messages=yes
  # shellcheck disable=SC2086  # a list of words
  set -- "$program" $arguments
  attempt "closed standard input" sh -c 'exec "$@" <&-' sh "$@"
  attempt "closed standard output" sh -c 'exec "$@" >&-' sh "$@"
  attempt "full standard output" sh -c 'exec "$@" >/dev/full' sh "$@"
  attempt "output that no one reads" bash -c '"$@" > >(exec >&-; true)' bash "$@"
  messages=no
  attempt "closed standard error" sh -c 'exec "$@" 2>&-' sh "$@"
  attempt "full standard error" sh -c 'exec "$@" 2>/dev/full' sh "$@"
  attempt "all streams closed" sh -c 'exec "$@" <&- >&- 2>&-' sh "$@"
  messages=yes
  attempt "no HOME" env -u HOME -u XDG_STATE_HOME -u XDG_CONFIG_HOME "$@"
  attempt "no environment" env -i "$@"
  attempt "decimal comma" env LC_ALL=de_DE.UTF-8 "$@"
  attempt "locale that does not exist" env LC_ALL=xx_XX.UTF-8 "$@"
  if [ "$(id -u)" -eq 0 ]; then
    attempt "user nobody" setpriv --reuid=65534 --regid=65534 --clear-groups "$@"
    attempt "user nobody, folder of root" setpriv --reuid=65534 --regid=65534 --clear-groups \
      sh -c 'cd /; exec "$@"' sh "$@"
  fi
  for kib in 100000 160000 300000; do # with less, libraries cannot be loaded
    attempt "ulimit -v $kib" sh -c "ulimit -v $kib; exec \"\$@\"" sh "$@"
  done
  for mib in 8 24 64; do
    case $name in help | usage | manual) ;; *) attempt "--memory ${mib}MiB" "$@" --memory "${mib}MiB" ;; esac
  done
  for files in 4 6 9 16; do
    attempt "ulimit -n $files" sh -c "ulimit -n $files; exec \"\$@\"" sh "$@"
  done
  for blocks in 0 1 16; do
    [ $blocks -ne 0 ] || messages=no # the file of the messages has the same limit
    attempt "ulimit -f $blocks" bash -c "ulimit -f $blocks; exec \"\$@\"" bash "$@"
    messages=yes
  done
  for signal in 1 2 13 15; do
    for delay in 0.01 0.05 0.15; do
      condition="signal $signal after $delay s"
      fresh
      : >"$scratch/err"
      "$@" >"$scratch/out" 2>"$scratch/err" </dev/null &
      process=$!
      sleep $delay
      kill -$signal $process 2>/dev/null
      wait $process 2>/dev/null
      messages=no judge $? $signal
    done
  done
done <<END
$commands
END

echo "$runs runs, $faults faults"
[ "$faults" -eq 0 ]
