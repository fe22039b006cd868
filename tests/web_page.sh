#!/bin/sh
# tests/web_page.sh [NATIVE [chromium|firefox]]: the page in a browser, tests/web/page.mjs. Needs
# build/web/site (samples/web_page.sh) and build/release. Pictures: out/web.
set -eu
cd "$(dirname "$0")/.."
browser=${2:-chromium}
case $browser in
  chromium) sh samples/install_packages.sh chromium admesh prusa-slicer; screen="" ;;
  # Without a screen Firefox has no WebGL.
  firefox) sh samples/install_packages.sh firefox-esr xvfb xauth admesh prusa-slicer; screen="xvfb-run -a" ;;
  *) echo "claystack: expected chromium or firefox, found $browser" >&2; exit 2 ;;
esac
tools=${XDG_CACHE_HOME:-$HOME/.cache}/claystack-web-tests
mkdir -p "$tools"
[ -d "$tools/node_modules/puppeteer-core" ] ||
  npm install --prefix "$tools" --no-audit --no-fund puppeteer-core@23.11.1 >/dev/null
rm -rf "$tools/tests" && cp -r tests/web "$tools/tests"   # node looks for modules above the file
$screen node "$tools/tests/page.mjs" build/web/site "${1:-build/release/app/claystack}" out/web "$browser"
