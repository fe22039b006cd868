# Functions for the scripts that use a clean Debian below a folder; needs root and debootstrap.
#   . tests/clean_debian.sh

# clean_debian SUITE FOLDER LOG: makes a minimal system, from the mirror of this one. FOLDER appears
# only when the system is complete, so that an interrupted run does not leave half of one there.
clean_debian() {
  [ "$(id -u)" -eq 0 ] || { echo "$0: expected root for debootstrap"; exit 2; }
  mirror=$(sed -n 's/^deb \(\[[^]]*\] \)\{0,1\}\([^ ]*\) bookworm .*/\2/p; s/^URIs: //p' \
    /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null | head -1)
  rm -rf "$2.part"
  debootstrap --variant=minbase "$1" "$2.part" "$mirror" >"$3"
  cp /etc/apt/apt.conf.d/* "$2.part/etc/apt/apt.conf.d/" 2>/dev/null || true
  cp /etc/resolv.conf "$2.part/etc/" 2>/dev/null || true
  echo 'DPkg::Use-Pty "false";' >"$2.part/etc/apt/apt.conf.d/no_terminal"  # /dev/pts is not mounted
  mv "$2.part" "$2"
}

# inside FOLDER COMMAND...: runs a command in it, as root and without this user's environment.
inside() {
  folder=$1
  shift
  chroot "$folder" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
    DEBIAN_FRONTEND=noninteractive "$@"
}
