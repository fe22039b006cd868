#!/bin/sh
# loaded.sh [ARGUMENTS of ctest]: runs the tests of the preset release on a busy machine: three times
# beside four processes that only compute, then twice in random order. Exit status 1 if a test fails.
#   sh tests/loaded.sh -R servo
set -eu
cd "$(dirname "$0")/.."
busy=
for _ in 1 2 3 4; do
  sh -c 'while :; do :; done' &
  busy="$busy $!"
done
# shellcheck disable=SC2086  # a list of processes
trap 'kill $busy 2>/dev/null || true' EXIT
for run in 1 2 3; do
  echo "== run $run beside four busy processes"
  ctest --preset release -j 2 "$@"
done
# shellcheck disable=SC2086
kill $busy
trap - EXIT
for run in 1 2; do
  echo "== run $run in random order"
  ctest --preset release -j 2 --schedule-random "$@"
done
