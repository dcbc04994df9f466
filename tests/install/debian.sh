#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tests/install/debian.sh BUILD WORK [MIRROR]: makes the Debian packages of a build folder, installs them in a fresh
# Debian 12 made with debootstrap, and goes there from `tunica plugin new` to a calibrated result, for every kind. Needs
# root and a network; apt's own configuration and mirror are used, unless MIRROR names another. By hand.
set -euo pipefail
(($# >= 2)) || { sed -n 's/^# //p' "$0" | head -4 >&2; exit 2; }
build=$(readlink -f "$1")
mkdir -p "$2"
work=$(readlink -f "$2")
mirror=${3:-$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' | grep -v security | head -1)}
root=$work/root

say() { printf '\n== %s\n' "$*"; }

say "packages"
rm -rf "$work"/*.deb "$work/cpack"
(cd "$build" && cpack -G DEB -B "$work/cpack" >/dev/null)
cp "$work"/cpack/*.deb "$work"
for package in "$work"/*.deb; do
  dpkg-deb --info "$package" | grep -E '^ (Package|Version|Depends|Installed-Size|Description)'
done

say "a fresh Debian 12 from $mirror"
rm -rf "$root"
debootstrap --variant=minbase bookworm "$root" "$mirror" >"$work/debootstrap.log" 2>&1
cp -r /etc/apt/. "$root/etc/apt/"
cp /etc/resolv.conf "$root/etc/resolv.conf"
cp "$work"/*.deb "$root/tmp/"
mount -t proc proc "$root/proc"  # where a program finds its own place, and so its plugins
trap 'umount "$root/proc"' EXIT

say "the program alone, without a compiler"
chroot "$root" bash -euc 'export DEBIAN_FRONTEND=noninteractive
  apt-get -q update >/dev/null
  apt-get -q install -y --no-install-recommends /tmp/tunica_*.deb >/tmp/apt.log 2>&1 || { cat /tmp/apt.log; exit 1; }
  tunica --version; tunica list models'

say "with tunica-dev: five commands a kind"
chroot "$root" bash -euc 'export DEBIAN_FRONTEND=noninteractive
  apt-get -q install -y --no-install-recommends /tmp/tunica-dev_*.deb make >/tmp/apt.log 2>&1 || { cat /tmp/apt.log; exit 1; }
  mkdir /root/try && cd /root/try
  for kind in model test optimizer mechanism; do
    verb=run; [[ $kind == mechanism ]] && verb=diagnose
    tunica plugin new "$kind" "my_$kind" >/dev/null
    cmake -S "my_$kind" -B "my_$kind/build" >/dev/null
    cmake --build "my_$kind/build" >/dev/null
    tunica plugin check "my_$kind/build/my_$kind.so" | tail -2
    tunica --plugin-path "my_$kind/build/my_$kind.so" "$verb" "my_$kind/experiment.json" -o "out_$kind" >/dev/null
    ctest --test-dir "my_$kind/build" --no-tests=error | tail -3
    ls "out_$kind/result.json"
  done'
say "with python3-tunica"
chroot "$root" bash -euc 'export DEBIAN_FRONTEND=noninteractive
  apt-get -q install -y --no-install-recommends /tmp/python3-tunica_*.deb >/tmp/apt.log 2>&1 || { cat /tmp/apt.log; exit 1; }
  cd /root/try && python3 -c "
import tunica
print(tunica.__version__, len(tunica.names()[\"models\"]), \"models\", tunica.Material(\"neo_hooke\", mu=10.0))"'
say "done"
