#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: own_symbols.sh LIBRARY ...
# What a linker would merge with an equal name elsewhere in a program bears a name of the library's
# own, and what a library takes from elsewhere is no template of Eigen: docs/decisions/0010-own-symbols.md.
set -euo pipefail
status=0
for library in "$@"; do
  suffix=.$(basename "$library" .a | sed 's/^lib//')
  # Type descriptions and what ends a program hold no arithmetic; tangency::exact and
  # tangency::detail are in no public header.
  shared=$(nm --defined-only "$library" 2>/dev/null | awk '$2 ~ /^[WVun]$/ { print $3 }' | sort -u |
           grep -vE '^_ZT|^DW\.ref\.|^__clang_call_terminate$|^_ZNK?8tangency2v0(5exact|6detail)')
  own=$(grep -cF "$suffix" <<< "$shared" || true)
  left=$(grep -vF "$suffix" <<< "$shared" || true)
  taken=$(nm --undefined-only "$library" 2>/dev/null | awk '{ print $NF }' | grep '^_ZNK\?5Eigen' |
          grep -vF "$suffix" || true)
  if [ -n "$left$taken" ]; then
    echo "$library shares with its users:"
    echo "$left$taken" | c++filt
    status=1
  fi
  [ "$own" -gt 0 ] || { echo "$library: no symbol of its own: this test cannot fail"; status=1; }
  echo "$library: $own symbols of its own"
done
exit $status
