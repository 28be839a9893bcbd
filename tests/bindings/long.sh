#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: long.sh BUILD
# What of the bindings needs large packages: the types of the Python package, a true data frame, pictures, the
# page of Octave, and a wheel that builds its library itself.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$(cd "$1" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cmake --build "$build" --target tangency_python tangency_tool tangency_dem_tool

(cd "$root/geometry/bindings/python" && mypy --strict --cache-dir "$scratch/mypy" tangency)
# A misuse that types have to show.
printf 'import tangency\nfound: int = tangency.contacts([], []).gap\n' > "$scratch/misuse.py"
if (cd "$scratch" && MYPYPATH="$root/geometry/bindings/python" mypy --strict --cache-dir "$scratch/mypy" misuse.py); then
  echo "mypy has no objection to an array that is taken for an int" && exit 1
fi

PYTHONDONTWRITEBYTECODE=1 TANGENCY_C_LIBRARY="$build/python/libtangency_c.so" \
  PYTHONPATH="$root/geometry/bindings/python" /usr/bin/python3 "$root/tests/bindings/pandas_check.py"
# Of the page of one's own grains what draws, too.
TANGENCY_DEM="$build/dem/tool/tangency-dem" PYTHONDONTWRITEBYTECODE=1 TANGENCY_C_LIBRARY="$build/python/libtangency_c.so" \
  PYTHONPATH="$root/geometry/bindings/python" /usr/bin/python3 "$root/tests/bindings/page.py" \
  "$root/docs/guide/own-grains.md" python,matplotlib "$scratch/own-grains" /usr/bin/python3
# Octave without its graphical packages complains at its end, on standard error, of nothing that is used here.
PATH="$build/geometry/tool:$PATH" /usr/bin/python3 "$root/tests/bindings/page.py" "$root/docs/octave.md" octave \
  "$scratch/octave" bash -c 'octave-cli --norc {source} 2> /dev/null'

env -u TANGENCY_C_LIBRARY /usr/bin/python3 -m pip wheel --quiet --no-build-isolation --no-deps --no-index \
  --disable-pip-version-check --wheel-dir "$scratch/wheel" "$root/geometry/bindings/python"
ls "$scratch"/wheel/tangency-*-py3-none-*.whl
