#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: package.sh SOURCE WORK [static|shared ...]
# The package in all its kinds and its users, as a table at the end: libraries static and shared, users
# that are built for debugging, for speed and by another compiler, each header alone, the kernel fetched
# and embedded in a project that installs itself, and that project's user. The shared libraries are those
# of the Debian packages, whose user is debian.sh.
set -euo pipefail
source=$(cd "$1" && pwd) work=$2
shift 2
[ $# -gt 0 ] || set -- static shared
mkdir -p "$work"
work=$(cd "$work" && pwd)
rm -rf "$work/headers"
export table=$work/table
: >"$table"
# shellcheck source=tests/build/matrix.sh
. "$source/tests/build/matrix.sh"
consumers=$source/tests/consumer

build() {
  if [ "$kind" = shared ]; then
    (cd "$source" && cmake --preset debian -B "$here/build")
  else
    cmake -G Ninja -S "$source" -B "$here/build" -DCMAKE_BUILD_TYPE=Release \
          -DTANGENCY_BUILD_TESTS=OFF -DTANGENCY_BUILD_BENCH=OFF
  fi
  cmake --build "$here/build"
  touch "$here/built"
}

# Every header compiles with nothing before it. The headers of both kinds are the same, as a rule: then
# they are not compiled twice.
each_header() {
  local eigen
  if [ -d "$work/headers" ] && diff -r "$prefix/include" "$work/headers"; then echo "these have been compiled"; return; fi
  eigen=$(pkg-config --cflags-only-I eigen3 | sed 's/-I/-isystem /g')
  (cd "$prefix/include" && find tangency -name '*.hpp') | xargs -P "$(nproc)" -I '{}' sh -c \
    'echo "#include <$1>" | "${CXX:-c++}" -std=c++20 -fsyntax-only -Wall -Wextra -Werror $2 -I"$3" -x c++ - ||
       { echo "$1 does not stand alone"; exit 255; }' - '{}' "$eigen" "$prefix/include"
  cp -r "$prefix/include" "$work/headers"
}

# all_programs FOLDER OPTION ...: the project tests/consumer, with these options.
all_programs() {
  local folder=$1
  shift
  cmake -G Ninja -S "$consumers" -B "$here/$folder" -DCMAKE_PREFIX_PATH="$prefix" "$@"
  cmake --build "$here/$folder"
  for program in consumer fabric simulate oracle "loader $here/$folder/plugin.so"; do
    # shellcheck disable=SC2086  # a program and its argument
    "$here/$folder"/$program
  done
}

kernel_alone() {
  cmake --install "$here/build" --prefix "$here/alone" --component geometry
  cmake --install "$here/build" --prefix "$here/alone" --component geometry-runtime
  cmake -G Ninja -S "$source/docs/example" -B "$here/example" -DCMAKE_PREFIX_PATH="$here/alone"
  cmake --build "$here/example"
  "$here/example/first_contact" | grep -qx separate
}

embedding() {
  cmake -G Ninja -S "$consumers/embedding" -B "$here/embedding" -DTANGENCY_SOURCE="$source" \
        -DCMAKE_BUILD_TYPE=Debug -DBUILD_SHARED_LIBS=$([ "$kind" = static ] || echo ON)
  cmake --build "$here/embedding"
  "$here/embedding/embedding"
}

embedded() {
  cmake --install "$here/embedding" --prefix "$here/made"
  mv "$here/made" "$here/embedded_prefix"
  cmake -G Ninja -S "$consumers/embedded" -B "$here/embedded" -DCMAKE_PREFIX_PATH="$here/embedded_prefix"
  cmake --build "$here/embedded"
  "$here/embedded/embedded"
}

# What git has at HEAD: a change that is not committed is not fetched.
fetched() {
  git clone --quiet --bare "$source" "$here/repository.git"
  cmake -G Ninja -S "$consumers/fetched" -B "$here/fetched" -DCMAKE_BUILD_TYPE=Release \
        -DTANGENCY_REPOSITORY="file://$here/repository.git" -DTANGENCY_TAG="$(git -C "$source" rev-parse HEAD)"
  cmake --build "$here/fetched"
  "$here/fetched/fetched"
}

for kind in "$@"; do
  here=$work/$kind
  rm -rf "$here"
  mkdir -p "$here"
  prefix=$here/consumer/prefix
  consumer "builds, without tests and benchmarks" build
  # What did not build has no users: each would fail in words of its own.
  [ -e "$here/built" ] || continue
  "$source/tests/build/consumer.sh" "$here/build" "$source" "$here/consumer" || failed=1
  consumer "each header alone" each_header
  consumer "Debug" all_programs debug -DCMAKE_BUILD_TYPE=Debug
  consumer "clang++" all_programs clang -DCMAKE_CXX_COMPILER=clang++-14
  consumer "the kernel's files alone, docs/example" kernel_alone
  if [ "$kind" = shared ]; then
    consumer "programs in C that were linked before" "$source/tests/build/abi.sh" --check "$here/build"
    consumer "Debian packages, unpacked and installed" "$source/tests/build/debian.sh" "$source" "$here/build" "$here/debian"
  fi
  # These build the kernel again.
  consumer "subproject that installs itself" embedding
  consumer "user of what such a project installs" embedded
  if [ "$kind" = static ]; then consumer "FetchContent from a git repository" fetched; fi
done
echo
matrix
exit $failed
