#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: consumer.sh BUILD SOURCE WORK
# Installs BUILD, moves what was installed elsewhere, and uses it there as strangers do: by
# find_package() with each component and with none, by pkg-config, by an old dialect.
set -euo pipefail
build=$1 source=$2 work=$3
consumers=$source/tests/consumer
rm -rf "$work"
mkdir -p "$work"
cmake --install "$build" --prefix "$work/made" >"$work/installed"
mv "$work/made" "$work/prefix"
prefix=$work/prefix

export PKG_CONFIG_PATH
PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name tangency-geometry.pc)")

# No file of it knows where it was made.
for place in "$source" "$build" "$work/made"; do
  if grep -rlF -- "$place" "$prefix"; then echo "these name $place"; exit 1; fi
done

# Its tools run where it lies now, and find the corpora there.
[ "$("$prefix/bin/tangency" --version)" = "tangency $(pkg-config --modversion tangency-geometry)" ]
"$prefix/bin/tangency-verify" grade --tool "$prefix/bin/tangency contact" --corpus touching >/dev/null

# Every header is there with all that it includes. Without its own folder no other copy is found.
(cd "$prefix/include" && find tangency -name '*.hpp' | sort | sed 's/.*/#include <&>/') >"$work/all.cpp"
for header in version geometry/gap dem/simulation dem/micromechanics/fabric verify/oracles/gap; do
  grep -q "<tangency/$header.hpp>" "$work/all.cpp" || { echo "$header.hpp is not installed"; exit 1; }
done
eigen=$(pkg-config --cflags-only-I eigen3 | sed 's/-I/-isystem /g')
# shellcheck disable=SC2086  # options, one a word
"${CXX:-c++}" -std=c++20 -fsyntax-only -Wall -Wextra -Werror $eigen -I"$prefix/include" "$work/all.cpp"

# A user whose flags ask for fused multiply-adds gets them in his own code, and is answered.
flags="-O2 -ffp-contract=fast"
[ "$(uname -m)" != x86_64 ] || flags="$flags -mfma"
cmake -G Ninja -S "$consumers" -B "$work/build" -DCMAKE_PREFIX_PATH="$prefix" \
      -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS="$flags" >/dev/null
cmake --build "$work/build"
if [ "$(uname -m)" != x86_64 ] || grep -qw fma /proc/cpuinfo; then
  "$work/build/consumer" fused
else
  objdump -d "$work/build/CMakeFiles/consumer.dir/multiply_add.cpp.o" | grep -q vfm
fi
"$work/build/fabric"
"$work/build/simulate"
"$work/build/oracle"

# Each component alone, and what is said of those that are not there.
mkdir -p "$work/partial"
cp -r "$prefix/." "$work/partial"
package=$(cd "$work/partial" && find . -name tangencyConfig.cmake -printf '%h')
rm "$work/partial/$package"/tangency-{dem,micromechanics,verify}*.cmake
static=OFF
[ -z "$(find "$prefix" -name libtangency_geometry.a)" ] || static=ON
cmake -G Ninja -S "$consumers/components" -B "$work/components" -DCMAKE_PREFIX_PATH="$prefix" \
      -DPARTIAL="$work/partial/$package" -DSTATIC=$static >/dev/null

# By pkg-config.
pkg-config --exists tangency-dem tangency-micromechanics
# shellcheck disable=SC2046  # options, one a word
"${CXX:-c++}" -std=c++20 "$consumers/embedding/contacts.cpp" "$consumers/embedding/main.cpp" \
  $(pkg-config --cflags --libs tangency-geometry) -o "$work/by_pkg_config"
LD_LIBRARY_PATH=$(dirname "$PKG_CONFIG_PATH") "$work/by_pkg_config"

# In an older dialect the first error says what is wrong.
if "${CXX:-c++}" -std=c++17 -fsyntax-only $(pkg-config --cflags tangency-geometry) \
     "$consumers/embedding/contacts.cpp" 2>"$work/cxx17"; then
  echo "C++17 is enough: this test is out of date"; exit 1
fi
grep -m 1 'error' "$work/cxx17" | grep 'tangency needs C++20' || { head "$work/cxx17"; exit 1; }
