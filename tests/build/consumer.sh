#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: consumer.sh BUILD CONSUMER_SOURCE WORK
set -euo pipefail
build=$1 source=$2 work=$3
rm -rf "$work"
cmake --install "$build" --prefix "$work/prefix" >/dev/null

# On x86-64 the consumer asks for fused multiply-adds and for contraction; other processors have
# fused instructions in their baseline.
flags="-O2 -ffp-contract=fast"
[ "$(uname -m)" != x86_64 ] || flags="$flags -mfma"
cmake -G Ninja -S "$source" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" \
      -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS="$flags" >/dev/null
cmake --build "$work/build"

fused='vfn\?madd\|vfn\?msub\|fmadd\|fmsub\|fmla'
with=$(find "$work/build" -name 'with_tangency.cpp.o') without=$(find "$work/build" -name 'without_tangency.cpp.o')
objdump -d "$without" | grep -q "$fused" ||
  { echo "the control shows no fused multiply-add: this test cannot fail"; exit 1; }
if objdump -d "$with" | grep "$fused"; then
  echo "a consumer of tangency::geometry was compiled with contraction"
  exit 1
fi
"$work/build/consumer"
"$work/build/fabric"
"$work/build/simulate"
