#!/bin/sh
# Libraries for WebAssembly, of the same versions as in the native build: those of Debian 12. Runs in
# the system that samples/web_page.sh prepares: `sysroot.sh FOLDER`. Does nothing if the folder is
# complete for this script.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
top=$1
root=$top/sysroot
stamp=$(cat "$0" "$here"/libraries/* "$here"/packages/* "$here"/include/*/* | sha256sum)
[ "$(cat "$root/stamp" 2>/dev/null || true)" != "$stamp" ] || exit 0

# Headers of libraries that consist of headers, and the sources of those that have to be compiled.
headers="libglm-dev libexpected-dev nlohmann-json3-dev libcli11-dev libfmt-dev libcgal-dev
  libboost1.74-dev libxxhash-dev libstb-dev libglfw3-dev libdraco-dev
  libfast-float-dev libsvgpp-dev fonts-inter"
sources="imgui openmesh draco zlib libzip libxml2"

mkdir -p "$top/apt/lists/partial" "$top/debs" "$top/sources"
: >"$top/apt/status"
sed -n 's/trixie/bookworm/; /^deb /p; s/^deb /deb-src /p' /etc/apt/sources.list >"$top/apt/sources.list"
apt12() {
  apt-get -qq -o Dir::Etc::sourcelist="$top/apt/sources.list" -o Dir::Etc::sourceparts=- \
    -o Dir::State::lists="$top/apt/lists" -o Dir::State::status="$top/apt/status" \
    -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache= -o APT::Sandbox::User=root "$@"
}
fetched=$(echo "$headers $sources" | sha256sum)
if [ "$(cat "$top/fetched" 2>/dev/null || true)" != "$fetched" ]; then
  apt12 update
  # shellcheck disable=SC2086  # lists of words
  (cd "$top/debs" && rm -f ./* && apt12 download $headers)
  # shellcheck disable=SC2086
  (cd "$top/sources" && rm -rf ./* && apt12 source $sources)
  echo "$fetched" >"$top/fetched"
fi

rm -rf "$root" "$top/unpacked"
mkdir -p "$root/lib/cmake" "$root/lib/pkgconfig" "$root/share"
for package in "$top"/debs/*.deb; do dpkg-deb -x "$package" "$top/unpacked"; done
cp -a "$top/unpacked/usr/include" "$root/include"
cp -a "$top/unpacked"/usr/include/x86_64-linux-gnu/* "$root/include" 2>/dev/null || true
mkdir "$root/share/fonts"
cp -a "$top"/unpacked/usr/share/fonts/opentype/inter/Inter-Medium.otf \
   "$top"/unpacked/usr/share/fonts/opentype/inter/Inter-SemiBold.otf "$root/share/fonts"
cp -a "$here"/include/* "$root/include"
# Clang 19 rejects this conversion, which nothing uses.
sed -i 's/return (! (this->base() == nullptr)) ?/return true ?/' "$root/include/CGAL/boost/graph/iterator.h"
for package in "$here"/packages/*; do
  case $package in
    *.pc) sed "s|@ROOT@|$root|" "$package" >"$root/lib/pkgconfig/$(basename "$package")" ;;
    *) name=$(basename "$package" .cmake)
       name=${name%Version} && name=${name%Config}
       mkdir -p "$root/lib/cmake/$name"
       cp -a "$package" "$root/lib/cmake/$name" ;;
  esac
done

# The copyright notices of all parts of the page.
for notice in "$top"/unpacked/usr/share/doc/*/copyright "$top"/sources/*/debian/copyright \
    /usr/share/doc/emscripten/copyright /usr/share/doc/libc++-18-dev/copyright; do
  [ -f "$notice" ] || continue
  name=${notice%/debian/copyright}
  printf '\n==== %s\n\n' "$(basename "${name%/copyright}")"
  cat "$notice"
done >"$root/licences.txt"

cmake -C "$here/libraries/checks.cmake" -G Ninja -S "$here/libraries" -B "$top/libraries" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_TOOLCHAIN_FILE="$here/toolchain.cmake" -DSYSROOT="$root" -DSOURCES="$top/sources" \
  -DCMAKE_INSTALL_PREFIX="$root"
cmake --build "$top/libraries" -j "${JOBS:-2}"
cmake --install "$top/libraries"
echo "$stamp" >"$root/stamp"
