#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: baseline_symbols.sh LIBRARY
# Whatever a linker could keep for the whole program (weak and global symbols, every section that
# is shared between objects) uses nothing beyond the baseline x86-64, though some functions of the
# library are compiled for AVX2 and AVX-512: an inline function that was compiled along with those
# could otherwise be the one copy that all others use.
set -euo pipefail
library=$1
[ "$(uname -m)" = x86_64 ] || { echo "not an x86-64: nothing to see"; exit 0; }

# By function: does it use the registers or the encodings of AVX?
wide=$(objdump -d --no-show-raw-insn "$library" | awk '
  /^[0-9a-f]+ <.*>:$/ { name = $2; gsub(/[<>:]/, "", name); next }
  /%[yz]mm|\tv[a-z0-9]+ / { if (!(name in seen)) { seen[name]; print name } }' | sort -u)
[ -n "$wide" ] || { echo "no function for AVX found: this test cannot fail"; exit 1; }

shared=$(nm --defined-only "$library" 2>/dev/null | awk '$2 ~ /^[TWVuBDR]$/ { print $3 }' | sort -u)
[ -n "$shared" ] || { echo "no shared symbol found: this test cannot fail"; exit 1; }

both=$(comm -12 <(echo "$wide") <(echo "$shared"))
if [ -n "$both" ]; then
  echo "shared symbols with instructions beyond the baseline:"
  echo "$both" | c++filt
  exit 1
fi
echo "$(echo "$wide" | wc -l) functions for AVX, none of them shared"
