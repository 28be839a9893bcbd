#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: embedding.sh SOURCE WORK
# A project that has Tangency in its own build and installs a library that links it: it can be generated,
# its own files are compiled as it says, and the kernel's as the kernel needs, with and without a build type;
# and cpack makes its packages.
set -euo pipefail
source=$1 work=$2
rm -rf "$work"
unset CXXFLAGS  # what it looks at is what CMake gives by itself

commands() { grep '"command"' "$work/compile_commands.json" | grep -- "-c $1"; }
for type in "" Debug; do
  cmake -G Ninja -S "$source/tests/consumer/embedding" -B "$work" -DTANGENCY_SOURCE="$source" \
        -DCMAKE_BUILD_TYPE="$type" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null
  own=$(commands "$source/tests/consumer/embedding/contacts.cpp" | head -n 1)
  kernel=$(commands "$source/geometry/gap.cpp")
  [ -n "$own" ] && [ -n "$kernel" ] || { echo "no commands: this test cannot fail"; exit 1; }

  expected="-fPIC -std=gnu++20"
  [ -z "$type" ] || expected="-g $expected"
  found=$(grep -oE -- ' -[A-Za-z][^ ]*' <<< "$own" | grep -vE -- '^ -(D|I|isystem|o|c)' | xargs)
  [ "$found" = "$expected" ] || { echo "type '$type': its own file has $found, not $expected"; exit 1; }
  for flag in -O2 -fPIC -ffp-contract=off -fno-math-errno; do
    grep -qF -- " $flag " <<< "$kernel" || { echo "type '$type': the kernel lacks $flag"; exit 1; }
  done
  for entry in "CMAKE_BUILD_TYPE:STRING=$type" CMAKE_CXX_FLAGS:STRING=; do
    grep -qxF "$entry" "$work/CMakeCache.txt" || { echo "type '$type': not $entry"; exit 1; }
  done
  for entry in 'CPACK_PACKAGE_NAME "embedding"' 'CPACK_GENERATOR "STGZ;TGZ;TZ"'; do
    grep -qxF "set($entry)" "$work/CPackConfig.cmake" ||
      { echo "type '$type': not $entry:"; grep -E 'PACKAGE_NAME|GENERATOR' "$work/CPackConfig.cmake"; exit 1; }
  done
done
