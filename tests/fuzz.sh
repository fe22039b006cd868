#!/bin/sh
# fuzz.sh [SECONDS [READER...]]: builds the libFuzzer programs and runs each for SECONDS (default
# 600), JOBS of them at once (default 2). Inputs that found new code stay in build/fuzz/corpus for
# the next run. Prints one line for each reader; exit status 1 if an input crashes a reader, takes
# it longer than 5 s or more than 512 MiB. Such an input is kept in build/fuzz/findings, and its
# report beside the log.
set -eu
cd "$(dirname "$0")/.."
seconds=${1:-600}
[ $# -eq 0 ] || shift
sh samples/install_packages.sh clang libclang-rt-14-dev
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz -j "${JOBS:-2}"
programs=build/fuzz/tests/fuzz
readers=${*:-$(find $programs -maxdepth 1 -name 'fuzz_*' -type f -executable -printf '%f\n' | sed 's/^fuzz_//' | sort)}
$programs/make_corpus build/fuzz/corpus
mkdir -p build/fuzz/findings build/fuzz/corpus
for format in svg dxf csv; do
  cp samples/drawings/*.$format build/fuzz/corpus/drawing_$format
done

# An input that took more than 5 s on a busy machine, but less processor time, is not a finding.
# shellcheck disable=SC2016  # the inner shell expands these
printf '%s\n' $readers | xargs -P "${JOBS:-2}" -I{} sh -c '
  program=$1/fuzz_{} log=build/fuzz/findings/{}.log end=$(($(date +%s) + $2))
  words=build/fuzz/corpus/{}.dict
  [ -e "$words" ] || words=tests/fuzz/json.dict
  export ASAN_OPTIONS=quarantine_size_mb=16
  : >"$log"
  while left=$((end - $(date +%s))); [ $left -gt 0 ]; do
    "$program" -max_total_time=$left -timeout=5 -rss_limit_mb=512 -print_final_stats=1 \
      -dict="$words" -artifact_prefix=build/fuzz/findings/{}- \
      "build/fuzz/corpus/{}" >>"$log" 2>&1 && break
    slow=$(ls build/fuzz/findings/{}-timeout-* 2>/dev/null | head -n 1)
    if [ -n "$slow" ] && (ulimit -t 5; exec "$program" "$slow") >>"$log" 2>&1
    then rm "$slow"; continue; fi
    echo "{}: FINDING, see $log"
    exit 1
  done
  runs=$(sed -n "s/stat::number_of_executed_units: *//p" "$log" | paste -s -d + - | sed "s/^$/0/")
  echo "{}: $(($runs)) runs, no finding"' sh "$programs" "$seconds"
