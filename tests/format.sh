#!/bin/sh
# Reports the files that clang-format 14 would change. `tests/format.sh --fix` changes them.
set -eu
cd "$(dirname "$0")/.."
if [ "${1-}" = --fix ]; then
  options=-i
else
  options="--dry-run -Werror"
fi
# shellcheck disable=SC2086  # a list of words
find core engine export falcon app samples tests \( -name '*.cpp' -o -name '*.hpp' \) -print0 |
  xargs -0 clang-format-14 $options
