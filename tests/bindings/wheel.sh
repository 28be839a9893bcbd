#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: wheel.sh PYTHON LIBRARY PACKAGE SCRATCH
# pip makes a wheel for every Python 3, which is unpacked elsewhere and answers with the library in it. The
# tree keeps nothing of what was made on the way.
set -euo pipefail
python=$1 library=$2 package=$3 scratch=$4
rm -rf "$scratch"
mkdir -p "$scratch"
before=$(find "$package" | sort)
TANGENCY_C_LIBRARY=$library "$python" -m pip wheel --quiet --no-build-isolation --no-deps --no-index \
  --disable-pip-version-check --wheel-dir "$scratch" "$package"
[ "$before" = "$(find "$package" | sort)" ] || { echo "the tree has other files than before"; exit 1; }
ls "$scratch"/tangency-*-py3-none-*.whl
"$python" -m zipfile -e "$scratch"/tangency-*.whl "$scratch/installed"
cd "$scratch"
env -u TANGENCY_C_LIBRARY PYTHONPATH="$scratch/installed" "$python" -c '
import tangency
print(tangency.__file__, tangency.version())
assert tangency.__file__.startswith("'"$scratch/installed"'")
assert tangency.contact([0, 0, 0, 1, 1, 1, 1, 0, 0, 0], [3, 0, 0, 1, 1, 1, 1, 0, 0, 0]).gap == 1
'
