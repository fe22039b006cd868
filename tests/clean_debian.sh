# Functions for the scripts that use a clean Debian below a folder; needs root and debootstrap.
#   . tests/clean_debian.sh

# clean_debian SUITE FOLDER LOG: makes a minimal system, from the mirror of this one.
clean_debian() {
  [ "$(id -u)" -eq 0 ] || { echo "$0: expected root for debootstrap"; exit 2; }
  mirror=$(sed -n 's/^deb \(\[[^]]*\] \)\{0,1\}\([^ ]*\) bookworm .*/\2/p; s/^URIs: //p' \
    /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null | head -1)
  debootstrap --variant=minbase "$1" "$2" "$mirror" >"$3"
  cp /etc/apt/apt.conf.d/* "$2/etc/apt/apt.conf.d/" 2>/dev/null || true
  cp /etc/resolv.conf "$2/etc/" 2>/dev/null || true
}

# inside FOLDER COMMAND...: runs a command in it, as root and without this user's environment.
inside() {
  folder=$1
  shift
  chroot "$folder" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
    DEBIAN_FRONTEND=noninteractive "$@"
}
