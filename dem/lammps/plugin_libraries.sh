#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Builds GMP and Highway as static libraries that a plugin can hold, so that it needs none of the
# machine that it runs on. Their sources are FOLDER/gmp and FOLDER/highway: plugin_sources.sh.
# Usage: plugin_libraries.sh FOLDER    FOLDER/static is made, for CMAKE_PREFIX_PATH
set -euo pipefail
folder=$(realpath "${1:?the folder of the sources}")
static=$folder/static
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
log=$folder/libraries.log
built() { "$@" >>"$log" 2>&1 || { tail -n 20 "$log" >&2; echo "$1 failed: $log" >&2; exit 1; }; }
: >"$log"
if [ ! -f "$static/lib/libgmpxx.a" ]; then
  mkdir "$work/gmp"
  cd "$work/gmp"
  # Of any processor of its kind: a cluster's nodes may be others than the one that compiles.
  built "$folder/gmp/configure" --prefix="$static" --libdir="$static/lib" --disable-shared \
    --enable-static --with-pic --enable-cxx --enable-fat
  built make -j "${JOBS:-1}"
  built make install
fi
if [ ! -f "$static/lib/libhwy.a" ]; then
  built cmake -S "$folder/highway" -B "$work/highway" -D CMAKE_BUILD_TYPE=Release -D BUILD_SHARED_LIBS=OFF \
    -D CMAKE_POSITION_INDEPENDENT_CODE=ON -D BUILD_TESTING=OFF -D HWY_ENABLE_TESTS=OFF \
    -D HWY_ENABLE_EXAMPLES=OFF -D HWY_ENABLE_CONTRIB=OFF -D CMAKE_INSTALL_PREFIX="$static" -D CMAKE_INSTALL_LIBDIR=lib
  built cmake --build "$work/highway" --target install
fi
