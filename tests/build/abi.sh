#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: abi.sh --check|--write BUILD
# The binary interface of libtangency_c that preset debian has made in BUILD: its functions, and the layout of
# the structs of tangency.h. --check compares with tests/build/abi/c.abi and fails where a program that was
# linked then may not run now; --write makes the file again. Of the C++ libraries public_symbols has the
# functions: a dump of the kernel, even of its public headers alone, takes 16 MB.
set -euo pipefail
how=$1 build=$(cd "$2" && pwd)
kept=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/abi/c.abi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for component in c{,-runtime}; do
  cmake --install "$build" --prefix "$work/prefix" --component "$component" >/dev/null
done
library=$(find "$work/prefix" -name libtangency_c.so)
[ -n "$library" ] || { echo "libtangency_c: not built as a shared library"; exit 1; }

# No place of the build in it, which would be another one each time.
# abidiff knows its files by their first line.
abidw --no-corpus-path --no-comp-dir-path --no-show-locs --exported-interfaces-only --drop-private-types \
      --headers-dir "$work/prefix/include" "$library" |
  sed -e "s|path='\(\.\./\)*|path='|" -e '1a <!-- SPDX-License-Identifier: GPL-3.0-or-later -->' >"$work/c.abi"
for needed in "<function-decl name='tangency_contacts'" "<class-decl name='tangency_contact_columns'"; do
  grep -qF "$needed" "$work/c.abi" || { echo "no $needed in the dump: this test cannot fail"; exit 1; }
done
case $how in
  --write)
    mkdir -p "$(dirname "$kept")"
    cp "$work/c.abi" "$kept"
    ls -l "$kept" ;;
  --check)
    machine=$(sed -n "s/.* architecture='\([^']*\)'.*/\1/p" "$kept")
    [ -n "$machine" ] || { echo "tests/build/abi/c.abi is no dump: abi.sh --write makes it"; exit 1; }
    grep -qF "architecture='$machine'" "$work/c.abi" ||
      { echo "not compared: tests/build/abi/c.abi is of $machine"; exit 0; }
    # 4: something has changed, 8: in a way that breaks programs; 1 and 2: the comparison failed. Of a file
    # that it cannot read to the end it complains, and compares what it has read.
    result=0
    abidiff --no-added-syms "$kept" "$work/c.abi" >"$work/report" 2>"$work/complaints" || result=$?
    if [ $result -ne 0 ] || [ -s "$work/complaints" ]; then
      echo "the interface of libtangency_c is not that of tests/build/abi/c.abi (abidiff: status $result):"
      cat "$work/complaints" "$work/report"
      exit 1
    fi
    echo "programs that were linked when tests/build/abi/c.abi was made run" ;;
  *) sed -n 3p "$0" >&2; exit 2 ;;
esac
