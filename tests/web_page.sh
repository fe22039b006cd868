#!/bin/sh
# The page in headless Chromium: tests/web/page.mjs. Needs build/web/site (samples/web_page.sh) and
# build/release. Pictures: out/web.
set -eu
cd "$(dirname "$0")/.."
sh samples/install_packages.sh chromium
tools=${XDG_CACHE_HOME:-$HOME/.cache}/claystack-web-tests
mkdir -p "$tools"
[ -d "$tools/node_modules/puppeteer-core" ] ||
  npm install --prefix "$tools" --no-audit --no-fund puppeteer-core@23.11.1 >/dev/null
rm -rf "$tools/tests" && cp -r tests/web "$tools/tests"   # node looks for modules above the file
node "$tools/tests/page.mjs" build/web/site "${1:-build/release/app/claystack}" out/web
