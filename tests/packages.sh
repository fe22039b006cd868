#!/bin/sh
# packages.sh [BUILD]: makes the Debian packages of a finished build (default build/release),
# examines them with lintian and the validators, and installs, uses and removes them in a fresh
# Debian 12 below BUILD/clean (debootstrap, root): the programs, the types of files of the desktop,
# the Python package, and the consumer programs against libclaystack-dev. Takes some minutes.
set -eu
cd "$(dirname "$0")/.."
build=$(realpath "${1:-build/release}")
clean=$build/clean
. tests/clean_debian.sh
sh samples/install_packages.sh lintian appstream desktop-file-utils debootstrap shared-mime-info mandoc \
  libxml2-utils python3-dev pybind11-dev python3-numpy

# Afterwards `cmake --install` must not write into /usr, unless it did before.
cached() { sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt"; }
prefix=$(cached CMAKE_INSTALL_PREFIX) python=$(cached CLAYSTACK_PYTHON)
finish() {
  umount "$clean/proc" 2>/dev/null || true
  cmake -B "$build" -DCMAKE_INSTALL_PREFIX="$prefix" -DCLAYSTACK_PYTHON="$python" >/dev/null
}
trap finish EXIT
cmake -B "$build" -DCMAKE_INSTALL_PREFIX=/usr -DCLAYSTACK_PYTHON=ON \
  -DPython3_EXECUTABLE=/usr/bin/python3 >/dev/null
cmake --build "$build" --target claystack claystack-studio manual python_package
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
# The command that a file manager runs.
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

echo "== the desktop"
cat >"$clean/opt/desktop.sh" <<'DESKTOP'
set -eu
apt-get install -y -qq --no-install-recommends shared-mime-info desktop-file-utils libglib2.0-bin >/dev/null
cd /opt/work
claystack export -q out/vase.pot.json out/vase.pot.cbor
cp samples/mouse.work samples/vase.scene.json out/
for file in vase.pot.json:pot+json vase.pot.cbor:pot+cbor vase.scene.json:scene+json mouse.work:work; do
  type=application/x-claystack-${file#*:}
  gio info -a standard::content-type "out/${file%:*}" | grep -qF " $type" ||
    { echo "${file%:*}: expected the type $type"; exit 1; }
  gio mime "$type" | grep -q org.claystack.Claystack.desktop ||
    { echo "$type: expected Claystack to open it"; exit 1; }
done
DESKTOP
inside "$clean" sh /opt/desktop.sh

echo "== python3-claystack"
cp tests/app/python/claystack_test.py "$clean/opt/"
inside "$clean" sh -c 'set -e
  apt-get install -y -qq --no-install-recommends /opt/python3-claystack_*.deb >/dev/null
  python3 /opt/claystack_test.py /usr/bin/claystack /usr/share/claystack/samples 2>&1 | tail -3
  python3 /usr/share/claystack/samples/python/sweep.py /opt/sweep.csv /opt/sweep.svg'

echo "== libclaystack-dev"
inside "$clean" sh -c 'set -e
  apt-get install -y -qq --no-install-recommends /opt/libclaystack-dev_*.deb cmake ninja-build g++ pkg-config >/dev/null
  cmake -S /usr/share/doc/libclaystack-dev/examples -B /opt/consumer -G Ninja >/dev/null
  cmake --build /opt/consumer >/dev/null
  /opt/consumer/press_once && /opt/consumer/press_and_export'

echo "== remove"
inside "$clean" sh -c 'set -e
  apt-get purge -y -qq claystack claystack-studio python3-claystack libclaystack-dev >/dev/null
  rm -rf /opt/*'
find "$clean" -xdev | sed "s|^$clean||" | sort >"$build/after.txt"
left=$(comm -13 "$build/before.txt" "$build/after.txt" | grep -i claystack |
  grep -v -e '^/var/lib/dpkg' -e '^/var/cache' -e '^/var/log' || true)
[ -z "$left" ] || { echo "left after removal:"; echo "$left"; exit 1; }
umount "$clean/proc"
rm -rf "$clean"
echo "packages: built, valid, installed, used and removed"
