#!/bin/sh
# Sizes of the files of the page [bytes], raw and by brotli: tests/web_sizes.sh build/web/site
# Exit status 1 if a browser loads more than 2.5 MB up to the first picture.
set -eu
command -v brotli >/dev/null || sh "$(dirname "$0")/../samples/install_packages.sh" brotli
cd "$1"
printf '%-22s %10s %10s\n' file raw brotli
first=0
all=0
for file in *; do
  raw=$(wc -c <"$file")
  packed=$(brotli -c -q 11 "$file" | wc -c)
  printf '%-22s %10d %10d\n' "$file" "$raw" "$packed"
  all=$((all + packed))
  # The worker's module loads after the first picture.
  case $file in claystack.*|worker.js|offline.js|licences.txt) ;; *) first=$((first + packed)) ;; esac
done
printf '%-22s %10s %10d\n' 'up to the picture' '' "$first"
printf '%-22s %10s %10d\n' all '' "$all"
[ "$first" -le 2500000 ] || { echo "expected at most 2500000 bytes up to the picture" >&2; exit 1; }
