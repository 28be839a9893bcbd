#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: abi.sh --check|--write BUILD
# The binary interface of the shared libraries that preset debian has made in BUILD: functions, and the
# layout of the types of public headers that they name. --check compares with tests/build/abi/*.abi.xz and
# fails where a program that was linked then would not run now; --write makes these again, at a release.
set -euo pipefail
how=$1 build=$(cd "$2" && pwd)
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for component in {geometry,micromechanics,dem,c}{,-runtime}; do
  cmake --install "$build" --prefix "$work/prefix" --component $component >/dev/null
done
status=0
for name in geometry micromechanics dem c; do
  library=$(find "$work/prefix" -name "libtangency_$name.so")
  [ -n "$library" ] || { echo "$name: not built as a shared library"; status=1; continue; }
  kept=$here/abi/$name.abi
  headers=$work/prefix/include
  case $how in
    --write)
      mkdir -p "$here/abi"
      abidw --no-corpus-path --no-comp-dir-path --no-show-locs --headers-dir "$headers" --drop-private-types \
            --out-file "$work/$name.abi" "$library"
      xz -9 --stdout "$work/$name.abi" >"$kept.xz"
      ls -l "$kept.xz" ;;
    --check)
      [ -e "$kept.xz" ] || { echo "$name: no dump is committed"; status=1; continue; }
      xz -d --stdout "$kept.xz" >"$work/$name.abi"
      # 4: something has changed, 8: in a way that breaks programs; 1 and 2: the comparison failed.
      result=0
      abidiff --headers-dir2 "$headers" --drop-private-types --no-added-syms \
              "$work/$name.abi" "$library" >"$work/report" || result=$?
      if [ $((result & 15)) -ne 0 ]; then
        echo "$name (abidiff: status $result):"
        cat "$work/report"
        status=1
      else
        echo "$name: programs that were linked when its dump was made run"
      fi ;;
    *) sed -n 3p "$0" >&2; exit 2 ;;
  esac
done
exit $status
