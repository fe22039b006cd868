#!/bin/sh
# packages.sh [BUILD]: makes the Debian packages of a finished build (default build/release),
# examines them with lintian and the validators, and installs, uses and removes them in a fresh
# Debian 12 below BUILD/clean (debootstrap, root). With DEV=1 also builds the consumer programs there
# against libclaystack-dev. Takes some minutes.
set -eu
cd "$(dirname "$0")/.."
build=$(realpath "${1:-build/release}")
clean=$build/clean
. tests/clean_debian.sh
sh samples/install_packages.sh lintian appstream desktop-file-utils debootstrap shared-mime-info mandoc \
  libxml2-utils

# Afterwards `cmake --install` must not write into /usr, unless it did before.
prefix=$(sed -n 's/^CMAKE_INSTALL_PREFIX:PATH=//p' "$build/CMakeCache.txt")
finish() {
  umount "$clean/proc" 2>/dev/null || true
  cmake -B "$build" -DCMAKE_INSTALL_PREFIX="$prefix" >/dev/null
}
trap finish EXIT
cmake -B "$build" -DCMAKE_INSTALL_PREFIX=/usr >/dev/null
cmake --build "$build" --target claystack claystack-studio manual
rm -rf "$build/packages"
(cd "$build" && cpack -B packages >/dev/null)
packages=$(find "$build/packages" -maxdepth 1 -name '*.deb' | sort)
echo "$packages"

echo "== examine"
desktop-file-validate app/desktop/*.desktop
appstreamcli validate --no-net "$build"/share/*.metainfo.xml
xmllint --noout app/desktop/*.mime.xml
for page in "$build"/share/*.1; do mandoc -T lint -W warning "$page"; done
# shellcheck disable=SC2086  # a list of names
lintian --allow-root --fail-on error,warning $packages

echo "== a clean Debian 12"
rm -rf "$clean"
clean_debian bookworm "$clean" "$build/debootstrap.log"
mount -t proc proc "$clean/proc"
inside "$clean" apt-get update -qq
find "$clean" -xdev | sed "s|^$clean||" | sort >"$build/before.txt"
# shellcheck disable=SC2086
cp $packages "$clean/opt/"

echo "== install"
inside "$clean" sh -c 'apt-get install -y -qq --no-install-recommends /opt/claystack_*.deb /opt/claystack-studio_*.deb >/dev/null'
echo "== the README's commands and those of every --help"
cat >"$clean/opt/use.sh" <<'USE'
set -eu
mkdir /opt/work
cd /opt/work
cp -r /usr/share/claystack/samples .
mkdir out
claystack throw samples/vase.scene.json -o out/vase.pot.json
claystack export out/vase.pot.json out/vase.3mf out/vase.stl
claystack check out/vase.stl
claystack import samples/drawings/jug.svg -o out/jug.pot.json
claystack render out/vase.pot.json -o out/vase.png --section
claystack studio out/vase.pot.json --script samples/window/throw.script --screenshot out/window.png
claystack throw -q samples/bowl.scene.json -o bowl.pot.json
claystack export -q bowl.pot.json bowl.stl bowl.obj bowl.drc
claystack check -q bowl.stl
claystack plan -q samples/bowl.scene.json
claystack strokes -q samples/cylinder.scene.json samples/strokes/cylinder.strokes.json -o c.session
echo '{"id": "a", "run": ["check", "bowl.stl"]}' | claystack batch - -q
claystack devices -q
claystack doctor || test $? -eq 1
claystack --version
# What a file manager calls.
sed -n 's/^Exec=//p' /usr/share/thumbnailers/claystack.thumbnailer |
  sed 's|%s|128|g; s|%o|out/thumb.png|; s|%i|out/vase.pot.json|' | sh
test -s out/thumb.png
test -s /usr/share/man/man1/claystack-export.1.gz
test -s /usr/share/bash-completion/completions/claystack
test -s /usr/lib/udev/rules.d/60-claystack.rules
USE
inside "$clean" sh /opt/use.sh
cp "$clean/opt/work/out/vase.stl" "$build/clean-vase.stl"
"$build/app/claystack" throw -q samples/vase.scene.json -o "$build/vase.pot.json"
"$build/app/claystack" export -q "$build/vase.pot.json" "$build/vase.stl"
cmp "$build/vase.stl" "$build/clean-vase.stl"

if [ "${DEV:-0}" = 1 ]; then
  echo "== libclaystack-dev"
  inside "$clean" sh -c 'apt-get install -y -qq --no-install-recommends /opt/libclaystack-dev_*.deb cmake ninja-build g++ pkg-config >/dev/null
    cmake -S /usr/share/doc/libclaystack-dev/examples -B /opt/consumer -G Ninja >/dev/null
    cmake --build /opt/consumer >/dev/null
    /opt/consumer/press_once && /opt/consumer/press_and_export
    apt-get purge -y -qq libclaystack-dev >/dev/null'
fi

echo "== remove"
inside "$clean" sh -c 'apt-get purge -y -qq claystack claystack-studio >/dev/null && apt-get autoremove -y -qq >/dev/null; rm -rf /opt/*'
find "$clean" -xdev | sed "s|^$clean||" | sort >"$build/after.txt"
left=$(comm -13 "$build/before.txt" "$build/after.txt" | grep -i claystack |
  grep -v -e '^/var/lib/dpkg' -e '^/var/cache' -e '^/var/log' || true)
[ -z "$left" ] || { echo "left after removal:"; echo "$left"; exit 1; }
umount "$clean/proc"
rm -rf "$clean"
echo "packages: built, valid, installed, used and removed"
