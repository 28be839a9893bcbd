#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: generated.sh PYTHON BINDINGS
# The header, the module of Fortran, the prototypes and stubs of Python are what the table says.
set -euo pipefail
python=$1 bindings=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
written=$("$python" -B "$bindings/generate.py" "$scratch")
[ -n "$written" ] || { echo "nothing was generated: this test cannot fail"; exit 1; }
for file in $written; do
  cmp "$bindings/$file" "$scratch/$file" || { echo "mend with: geometry/bindings/generate.py"; exit 1; }
done
