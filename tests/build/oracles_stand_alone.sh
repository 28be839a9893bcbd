#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: oracles_stand_alone.sh LIBRARY SOURCE...
# What says the truth neither includes a header of the kernel (geometry/tables is none)
# nor leaves one of its symbols to be linked.
set -euo pipefail
library=$1
shift
if grep -rnE '#include.*tangency/(geometry/([^t]|t[^a])|dem)' "$@"; then
  echo "an oracle includes the kernel"
  exit 1
fi
symbols=$(nm --demangle --undefined-only "$library" 2>/dev/null)
grep -qE 'gmp|std::' <<<"$symbols" || { echo "no symbols read: this test cannot fail"; exit 1; }
if grep 'tangency::' <<<"$symbols" | grep -v 'tangency::v0::verify::'; then
  echo "an oracle leaves a symbol of the kernel to be linked"
  exit 1
fi
