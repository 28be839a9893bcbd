#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: package.sh SOURCE WORK [static|shared ...]
# The package in all its kinds: libraries static and shared, users that are built for debugging and for
# speed, each header alone, the kernel embedded in a project that installs itself, and that project's user.
set -euo pipefail
source=$1 work=$2
shift 2
[ $# -gt 0 ] || set -- static shared
mkdir -p "$work"
work=$(cd "$work" && pwd)

says() { printf '%4d s  %s\n' "$SECONDS" "$*"; }

# each_header PREFIX: every header compiles with nothing before it.
each_header() {
  local eigen
  eigen=$(pkg-config --cflags-only-I eigen3 | sed 's/-I/-isystem /g')
  (cd "$1/include" && find tangency -name '*.hpp') | xargs -P "$(nproc)" -I '{}' sh -c \
    'echo "#include <$1>" | "${CXX:-c++}" -std=c++20 -fsyntax-only -Wall -Wextra -Werror $2 -I"$3" -x c++ - ||
       { echo "$1 does not stand alone"; exit 255; }' - '{}' "$eigen" "$1/include"
}

for kind in "$@"; do
  here=$work/$kind
  rm -rf "$here"
  shared=OFF
  [ "$kind" = static ] || shared=ON
  says "$kind: build"
  cmake -G Ninja -S "$source" -B "$here/build" -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=$shared \
        -DTANGENCY_BUILD_TESTS=OFF -DTANGENCY_BUILD_BENCH=OFF >/dev/null
  cmake --build "$here/build"

  says "$kind: a user for speed, each component, pkg-config, another dialect"
  "$source/tests/build/consumer.sh" "$here/build" "$source" "$here/consumer"
  prefix=$here/consumer/prefix
  if [ $shared = ON ]; then
    for library in geometry micromechanics dem; do
      readelf -d "$(find "$prefix" -name "libtangency_$library.so")" |
        grep -qE 'SONAME.*libtangency_'$library'\.so\.[0-9]+\.[0-9]+\]' || { echo "$library: soname"; exit 1; }
    done
  fi

  says "$kind: each header alone"
  each_header "$prefix"

  says "$kind: a user for debugging"
  cmake -G Ninja -S "$source/tests/consumer" -B "$here/debug" -DCMAKE_PREFIX_PATH="$prefix" \
        -DCMAKE_BUILD_TYPE=Debug >/dev/null
  cmake --build "$here/debug"
  for program in consumer fabric simulate oracle; do "$here/debug/$program"; done

  says "$kind: the kernel's files alone"
  cmake --install "$here/build" --prefix "$here/alone" --component geometry >/dev/null
  cmake -G Ninja -S "$source/docs/example" -B "$here/example" -DCMAKE_PREFIX_PATH="$here/alone" >/dev/null
  cmake --build "$here/example"
  "$here/example/first_contact" | grep -qx separate

  says "$kind: an embedding project and its user"
  cmake -G Ninja -S "$source/tests/consumer/embedding" -B "$here/embedding" -DTANGENCY_SOURCE="$source" \
        -DCMAKE_BUILD_TYPE=Debug -DBUILD_SHARED_LIBS=$shared >/dev/null
  cmake --build "$here/embedding"
  "$here/embedding/embedding"
  cmake --install "$here/embedding" --prefix "$here/made" >/dev/null
  mv "$here/made" "$here/embedded_prefix"
  cmake -G Ninja -S "$source/tests/consumer/embedded" -B "$here/embedded" \
        -DCMAKE_PREFIX_PATH="$here/embedded_prefix" >/dev/null
  cmake --build "$here/embedded"
  "$here/embedded/embedded"
done
says "done"
