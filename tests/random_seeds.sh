#!/bin/sh
# tests/random_seeds.sh [RUNS [CASES [BUILD]]]: runs every test of random inputs RUNS times (10), each
# time with another seed and with CASES inputs (1000), from the programs in BUILD (build/release).
# Prints the seeds that fail, and the commands to repeat them. Exit status 1 if a test fails.
set -u
cd "$(dirname "$0")/.."
runs=${1:-10} cases=${2:-1000} build=${3:-build/release}
# GoogleTest lists a test by its suite and its name; the sources show the tests that are random.
tests=$(grep -rhoE 'RC_GTEST_(FIXTURE_)?PROP\([A-Za-z]+, *[A-Za-z0-9]+' tests |
  sed -E 's/.*\(([A-Za-z]+), *([A-Za-z0-9]+)/\1.\2/' | paste -sd:)
failed=0
for run in $(seq "$runs"); do
  seed=$(od -An -N4 -tu4 /dev/urandom | tr -d ' ')
  for program in $(find "$build/tests" -name '*_tests' -type f -perm -u+x | sort); do
    output=$(RC_PARAMS="seed=$seed max_success=$cases" "$program" --gtest_brief=1 --gtest_filter="$tests" 2>&1) || {
      failed=1
      echo "$program: repeat with RC_PARAMS='seed=$seed max_success=$cases'"
      echo "$output" | grep -A3 'FAILED\|Falsifiable'
    }
  done
done
exit $failed
