#!/bin/sh
# Checks sources with clang-tidy 14. The rules are in .clang-tidy; each finding is an error.
# usage: tests/tidy.sh [FOLDER...]    FOLDER: core, engine/tick, ...; default: core engine falcon
set -eu
cd "$(dirname "$0")/.."
[ $# -gt 0 ] || set -- core engine falcon
cmake --preset clang -B build/tidy -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DCLAYSTACK_BENCH=OFF >/dev/null
find "$@" -name '*.cpp' -print0 |
  xargs -0 -n 1 -P 2 clang-tidy-14 -p build/tidy --quiet --warnings-as-errors='*'
