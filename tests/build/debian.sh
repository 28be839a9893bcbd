#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: debian.sh SOURCE BUILD WORK
# The Debian packages of BUILD, which preset debian has made: what they are called and need, unpacked into
# a prefix and used there, and, where this is root, installed with apt-get in a fresh Debian 12 whose C++
# project and command line use them.
set -euo pipefail
source=$(cd "$1" && pwd) build=$(cd "$2" && pwd)
rm -rf "$3"
mkdir -p "$3"
work=$(cd "$3" && pwd)
says() { printf '%4d s  %s\n' "$SECONDS" "$*"; }

says "packages"
(cd "$build" && cpack -G DEB -B "$work/packages")
cd "$work/packages"
rm -rf _CPack_Packages
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")
soversion=${version%.*}
needs() {  # PACKAGE NAME ...
  local package=$1 depends
  shift
  depends=$(dpkg-deb -f "$package"_"$version"_*.deb Depends)
  for name in "$@"; do
    grep -qE "(^|, )$name( |,|\$)" <<< "$depends" || { echo "$package does not need $name: $depends"; exit 1; }
  done
}
needs "libtangency-geometry$soversion" libgmp10 libc6 libstdc++6
needs "libtangency-dem$soversion" "libtangency-geometry$soversion" libtbb12
needs libtangency-dev "libtangency-geometry$soversion" "libtangency-dem$soversion" libeigen3-dev
needs libtangency-verify-dev libtangency-dev libboost-dev libgsl-dev libmpfr-dev
needs python3-tangency python3-numpy "libtangency-geometry$soversion"
needs tangency "libtangency-geometry$soversion" "libtangency-dem$soversion"
for package in *.deb; do
  dpkg-deb -I "$package" | sed -n 's/^ \(Package\|Installed-Size\|Depends\|Description\)/\1/p'
  ! dpkg-deb -c "$package" | awk '{ print $6 }' | grep -vE '^\./(usr/.*)?$' || { echo "$package: outside /usr"; exit 1; }
  dpkg-deb -c "$package" | grep -q '/copyright$' || { echo "$package: no copyright"; exit 1; }
done

says "unpacked into a prefix, and used there"
for package in *.deb; do dpkg-deb -x "$package" "$work/root"; done
for library in "$work"/root/usr/lib/*/libtangency_*.so.*; do
  [ -h "$library" ] || ! readelf -S "$library" | grep -q '\.debug_info' || { echo "$library: not stripped"; exit 1; }
done
cmake -G Ninja -S "$source/tests/consumer" -B "$work/consumer" -DCMAKE_PREFIX_PATH="$work/root/usr" \
      -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build "$work/consumer"
for program in consumer fabric simulate oracle "loader $work/consumer/plugin.so"; do
  # shellcheck disable=SC2086  # a program and its argument
  "$work/consumer"/$program
done

[ "$(id -u)" = 0 ] && command -v mmdebstrap >/dev/null ||
  { says "done, without a fresh Debian: that needs root and mmdebstrap"; exit; }
says "installed in a fresh Debian 12"
"$source/tests/build/fresh_root.sh" "$(dpkg --print-architecture)" "$work/fresh" g++ cmake ninja-build
mkdir "$work/fresh/packages"
cp ./*.deb "$work/fresh/packages"
cat >"$work/fresh/use" <<'USE'
set -e
apt-get -qq update
apt-get -qq install -y --no-install-recommends /packages/*.deb
tangency --version
tangency-dem --version
printf 'a.x,a.y,a.z,a.r1,a.r2,a.r3,b.x,b.y,b.z,b.r1,b.r2,b.r3\n0,0,0,1,1,1,3,0,0,2,2,2\n' | tangency overlap
tangency-verify grade --tool "tangency contact" --corpus touching
cmake -G Ninja -S /usr/share/doc/tangency/example -B /first
cmake --build /first
/first/first_contact
python3 -c 'import tangency
print(tangency.contact([0, 0, 0, 1, 1, 1, 1, 0, 0, 0], [2.5, 0, 0, 2, 1, 1, 1, 0, 0, 0]).gap)' | grep -qx -- -0.5
apt-get -qq remove -y 'libtangency*' tangency 'python3-tangency*'
! find /usr -name '*tangency*' | grep .
USE
chroot "$work/fresh" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 sh /use | tee "$work/used"
grep -qx 'separate' "$work/used"
grep -q 'external_touch' "$work/used"
grep -q "^passed: " "$work/used"
rm -rf --one-file-system "$work/fresh"
says "done"
