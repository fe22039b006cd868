#!/bin/sh
# samples/web_page.sh [TARGET...]: builds the web page, the folder build/web/site, which any web
# server can serve, and further targets of app/web. Installs the toolchain first, a Debian 13 system
# with Emscripten in a separate folder (3.5 GB): by default
# ${XDG_CACHE_HOME:-~/.cache}/claystack-web, otherwise the folder CLAYSTACK_WEB_SYSTEM. Needs root
# (or sudo) for chroot and mounts; the mounts end with the command.
set -eu
cd "$(dirname "$0")/.."

fail() { echo "claystack: $1" >&2; exit 3; }
as_root=""
[ "$(id -u)" -eq 0 ] || as_root=sudo
[ -z "$as_root" ] || command -v sudo >/dev/null ||
  fail "expected root or sudo, for chroot and mounts"
system=${CLAYSTACK_WEB_SYSTEM:-${XDG_CACHE_HOME:-$HOME/.cache}/claystack-web}
compiler=3.1.69  # of Emscripten: the page's bits depend on its mathematical functions
case "$system" in
  "$PWD"|"$PWD"/*) echo "claystack: expected a folder outside of the sources, found $system" >&2; exit 2 ;;
  /|[!/]*) echo "claystack: expected the whole path of a folder in CLAYSTACK_WEB_SYSTEM, found $system" >&2; exit 2 ;;
esac

if [ ! -x "$system/usr/bin/apt-get" ]; then
  sh samples/install_packages.sh debootstrap || fail "expected debootstrap, could not install it"
  # The folder appears when the system is complete: an interrupted run leaves nothing that the next
  # one would use.
  $as_root rm -rf "$system.part"
  $as_root debootstrap --variant=minbase trixie "$system.part" ||
    fail "could not install Debian 13 into $system; debootstrap names the reason above"
  $as_root mv "$system.part" "$system"
fi
$as_root unshare --mount true || fail "expected the right to mount, which containers often lack"
# A mount namespace: nothing stays mounted, even if this command fails.
# $1: a command for the shell of that system, in the sources.
inside() {
  $as_root unshare --mount sh -c '
    system=$1; mkdir -p "$system/claystack"
    mount --bind "$PWD" "$system/claystack" && mount -t proc proc "$system/proc"
    exec chroot "$system" env DEBIAN_FRONTEND=noninteractive PKG_CONFIG_ALLOW_SYSTEM_CFLAGS=1 \
      CCACHE_DISABLE=1 EM_CONFIG=/opt/claystack-web/emscripten \
      EM_CACHE=/usr/share/emscripten/cache CLAYSTACK_WEB_ROOT=/opt/claystack-web/sysroot \
      JOBS="$3" sh -euc "cd /claystack; $2"' sh "$system" "$1" "${JOBS:-2}"
}
# ccache would start em++ twice for each file: CCACHE_DISABLE. The libraries of Emscripten for
# exceptions are not in its cache: it may add them (FROZEN_CACHE).
inside "
  dpkg -s emscripten cmake ninja-build pkgconf dpkg-dev brotli >/dev/null 2>&1 || {
    apt-get update -qq &&
      apt-get install -y -qq --no-install-recommends emscripten cmake ninja-build pkgconf dpkg-dev brotli
  } || {
    echo 'claystack: could not install Emscripten into $system; apt-get names the reason above' >&2
    exit 3
  }
  mkdir -p /opt/claystack-web
  sed 's/^FROZEN_CACHE = True/FROZEN_CACHE = False/' /usr/share/emscripten/.emscripten >/opt/claystack-web/emscripten
  em++ --version | grep -q ' $compiler ' || {
    echo 'claystack: expected Emscripten $compiler, found another version' >&2
    exit 3
  }
  sh cmake/web/sysroot.sh /opt/claystack-web
  cmake --preset web
  cmake --build --preset web --target site $* -j \$JOBS
"
sh tests/web_sizes.sh build/web/site
echo "serve it: python3 -m http.server -d build/web/site"
