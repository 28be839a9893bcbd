#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: long.sh SOURCE BUILD FOLDER
# The part `faults` of .ci/long-parts: every kind of fault at many events, two scenes that are checked
# while they run, archives made twice, and a build and a run without a network. docs/trust.md has the
# figures.
set -euo pipefail
source=$1 build=$(cd "$2" && pwd)
mkdir -p "$3"
folder=$(cd "$3" && pwd)
simulator=$build/dem/tool/tangency-dem kernel=$build/geometry/tool/tangency
library=$build/tests/faults/libtangency_faults.so scene=$source/tests/faults/scene.toml
status=0
failed() { echo "FAILED: $1"; status=1; }

runs() { "$source/tests/faults/interrupted_runs.py" "$simulator" "$library" "$scene" "$folder/runs" "$@"; }
runs --cases 500 kill || failed "killed runs"
runs --cases 150 half full once quota input-output || failed "runs with a full disk"
runs --cases 150 memory memory-ends || failed "runs without memory"
"$source/tests/faults/interrupted_commands.py" "$kernel" "$simulator" "$library" "$scene" \
  "$folder/commands" --cases 60 || failed "commands"

on_a_small_disk() {
  unshare --map-root-user --mount "$source/tests/faults/small_disk.py" "$simulator" "$library" "$scene" \
    "$folder/small" "$@"
}
if unshare --map-root-user --mount mount -t tmpfs tmpfs "$folder" 2>/dev/null; then
  on_a_small_disk --cases 100 || failed "runs on a small disk"
else
  echo "small disk: not checked, this system lets nobody mount one"
fi

for name in growth-1000 unload-1000; do
  "$simulator" run "$source/dem/scenes/$name.toml" --out "$folder/$name" --replace --quiet --verify \
    2>&1 | tail -n 1 || failed "$name --verify"
done

for copy in a b; do
  "$source/.ci/packaging/source_archive" "$folder/$copy" >/dev/null
  "$source/.ci/packaging/sbom" >"$folder/$copy/tangency.spdx.json"
done
diff -r "$folder/a" "$folder/b" && echo "archives and bills of materials: equal" || failed "archives"

without_network() { unshare --map-root-user --net "$@"; }
if without_network true 2>/dev/null; then
  others=$(without_network sh -c 'tail -n +3 /proc/self/net/dev | grep -vc "^ *lo:"') || true
  [ "$others" = 0 ] || failed "there is a network"
  without_network cmake -S "$source" --preset library -B "$folder/library" >"$folder/library.log" 2>&1 &&
    without_network cmake --build "$folder/library" >>"$folder/library.log" 2>&1 ||
    failed "the kernel built without a network: $folder/library.log"
  without_network "$simulator" run "$scene" --out "$folder/quiet" --replace --quiet 2>/dev/null ||
    failed "a run without a network"
  [ $status -ne 0 ] || echo "without a network: built and run"
else
  echo "without a network: not checked, this system makes no namespaces"
fi
exit $status
