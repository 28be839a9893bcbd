#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: oracles_stand_alone.sh LIBRARY SOURCE_FOLDER
# The oracles neither include a header of the kernel nor leave one of its symbols to be linked.
set -euo pipefail
library=$1 folder=$2
if grep -rn '#include.*tangency/\(geometry\|dem\)' "$folder"; then
  echo "an oracle includes the kernel"
  exit 1
fi
symbols=$(nm --demangle --undefined-only "$library")
grep -q 'gmp' <<<"$symbols" || { echo "no symbols read: this test cannot fail"; exit 1; }
if grep 'tangency::' <<<"$symbols" | grep -v 'tangency::verify::'; then
  echo "an oracle leaves a symbol of the kernel to be linked"
  exit 1
fi
