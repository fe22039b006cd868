#!/bin/sh
# Reports the files that clang-format 14 would change. `tests/format.sh --fix` changes them, and
# leaves the others alone: a new time of a file makes the next build compile it again.
set -eu
cd "$(dirname "$0")/.."
# Not --dry-run: version 14 wrongly reports the end of every `namespace a::inline b`.
find core engine export falcon app samples tests \( -name '*.cpp' -o -name '*.hpp' \) -print0 |
  FIX=${1-} xargs -0 -n 50 -P 2 bash -c '
  cmp -s <(cat "$@") <(clang-format-14 "$@") && exit
  status=0
  for file; do
    clang-format-14 "$file" | cmp -s - "$file" && continue
    if [ "$FIX" = --fix ]; then
      clang-format-14 -i "$file"
    else
      echo "$file: not formatted" >&2
      status=1
    fi
  done
  exit "$status"' bash
