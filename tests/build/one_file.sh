#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: one_file.sh SOURCE WORK, as root
# The grader as one static file, by the presets grade and verify: below 8 MB, the same bytes of two builds
# in two folders, no path of either in it, and at work in a root that has nothing else. Prints the
# processor time of each build, which no cache shortens.
set -euo pipefail
source=$1 work=$(mkdir -p "$2" && cd "$2" && pwd)
fail() { echo "$*"; exit 1; }
unset CMAKE_CXX_COMPILER_LAUNCHER
TIMEFORMAT='%U s of processor time'

# build PRESET FOLDER, of a copy of the sources
build() {
  rm -rf "${work:?}/$2"
  mkdir -p "$work/$2"
  (cd "$source" && tar cf - --exclude=./build --exclude=./.git .) | tar xf - -C "$work/$2"
  cd "$work/$2"
  cmake --preset "$1" >configured || { cat configured; exit 1; }
  echo "preset $1, in $2:"
  time cmake --build --preset "$1" >built || { tail -n 30 built; exit 1; }
  cd "$work"
}
file() { echo "$work/$2/build/$1/verify/tool/tangency-verify"; }

for preset in grade verify; do
  build "$preset" "$preset-a"
  one=$(file "$preset" "$preset-a")
  [ "$(stat -c %s "$one")" -lt 8000000 ] || fail "$one is not below 8 MB"
  ! grep -q -a -F "$work" "$one" || fail "$one holds the path $work"
  ! readelf -d "$one" | grep -q NEEDED || fail "$one needs shared libraries"
  root=$work/root
  rm -rf "$root"
  mkdir "$root"
  cp "$one" "$root/tangency-verify"
  # The truth itself is an answer: its columns row and type.
  sed '/^#/d' "$source/verify/corpora/quadrics.truth.csv" >"$root/answers.csv"
  chroot "$root" /tangency-verify grade --answers answers.csv --corpus quadrics --html page.html >"$work/said" ||
    { cat "$work/said"; fail "the grade fails in an empty root"; }
  tail -n 1 "$work/said"
  [ -s "$root/page.html" ] || fail "no page is written in an empty root"
  status=0
  chroot "$root" /tangency-verify grade --tool x --corpus near 2>"$work/said" >&2 || status=$?
  [ "$status" = 2 ] && grep -q 'there is no /bin/sh here' "$work/said" || { cat "$work/said"; fail "a tool is asked without a shell"; }
done
chroot "$root" /tangency-verify generate quadrics --out made
cmp "$root/made/quadrics.csv" "$source/verify/corpora/quadrics.csv"
cmp "$root/made/quadrics.truth.csv" "$source/verify/corpora/quadrics.truth.csv"
build grade "a longer name of a folder"
cmp "$(file grade grade-a)" "$(file grade "a longer name of a folder")"
echo "one file: the same bytes in two folders"
