#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: ilp32.sh SOURCE WORK BUILD
# The kernel where a long and a size have 32 bits: a Debian 12 of the architecture i386 builds it, runs the
# tests of tests/build/ilp32, and answers the corpora: graded by the 64-bit tangency-verify of BUILD, and
# what is exact in them is that of its tangency. Other numbers may differ in the last bits, as they do
# between instruction sets. Needs root, and an amd64 that runs programs for i386.
set -euo pipefail
source=$1 work=$2 build=$3
mkdir -p "$work"
work=$(cd "$work" && pwd) build=$(cd "$build" && pwd)
root=$work/root
says() { printf '%4d s  %s\n' "$SECONDS" "$*"; }

says "a Debian 12 for i386"
kernel=$(awk '$1 == "library" { print $2 }' "$source/.ci/packages")
# shellcheck disable=SC2086  # packages, one a word
"$source/tests/build/fresh_root.sh" i386 "$root" $kernel libcli11-dev libgtest-dev librapidcheck-dev

says "the kernel, its tool and tests"
# The arithmetic of SSE2, as on every 64-bit x86: the x87's rounds to 64 bits, and the headers refuse it.
inside() { chroot "$root" env LC_ALL=C.UTF-8 "$@"; }
inside cmake -G Ninja -S /tangency/tests/build/ilp32 -B /build -DTANGENCY_SOURCE=/tangency \
       -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O2 \
       -DCMAKE_CXX_FLAGS="-msse2 -mfpmath=sse" >/dev/null
inside cmake --build /build
file -L "$root/build/tests_ilp32" 2>/dev/null | grep -q '64-bit' && { echo "that is no 32-bit program"; exit 1; }
says "tests"
inside env RC_PARAMS="seed=20261122 max_success=1000" /build/tests_ilp32 --gtest_brief=1

says "corpora"
tool=/build/tangency/geometry/tool/tangency
status=0
for corpus in "$source"/verify/corpora/*.truth.csv; do
  name=$(basename "$corpus" .truth.csv)
  case $name in
    ellipses) command=ellipse exact=1-3 ;;
    quadrics) command=classify exact=1-5 ;;
    *) command=contact exact=1,2 ;;
  esac
  "$build/verify/tool/tangency-verify" grade --corpus "$name" --tool "chroot $root $tool $command" | tail -n 1 |
    sed "s/^/$name: /" || status=1
  "$build/geometry/tool/tangency" $command "$source/verify/corpora/$name.csv" | cut -d , -f $exact >"$work/wide"
  inside $tool $command <"$source/verify/corpora/$name.csv" | cut -d , -f $exact >"$work/narrow"
  [ "$(wc -l <"$work/wide")" -gt 1 ] || { echo "$name: no answer: this test cannot fail"; exit 1; }
  cmp "$work/wide" "$work/narrow" || { echo "$name: other answers"; status=1; }
done
[ $status -ne 0 ] || rm -rf --one-file-system "$root"
says "done"
exit $status
