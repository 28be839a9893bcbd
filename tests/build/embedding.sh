#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: embedding.sh SOURCE WORK
# A Debug project that has Tangency in its own build and installs a library that links it: it can be
# generated, its own files are compiled as it says, and the kernel's as the kernel needs.
set -euo pipefail
source=$1 work=$2
rm -rf "$work"
cmake -G Ninja -S "$source/tests/consumer/embedding" -B "$work" -DTANGENCY_SOURCE="$source" \
      -DCMAKE_BUILD_TYPE=Debug -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null

commands() { grep '"command"' "$work/compile_commands.json" | grep -- "-c $1"; }
its_own=$(commands "$source/tests/consumer/embedding/contacts.cpp" | head -n 1)
kernel=$(commands "$source/geometry/gap.cpp")
[ -n "$its_own" ] && [ -n "$kernel" ] || { echo "no commands: this test cannot fail"; exit 1; }
expected=$(echo -g -fPIC -std=gnu++20)
found=$(grep -oE -- ' -[A-Za-z][^ ]*' <<< "$its_own" | grep -vE -- '^ -(D|I|isystem|o|c)' | xargs)
[ "$found" = "$expected" ] || { echo "its own file has $found, not $expected"; exit 1; }
for flag in -O2 -fPIC -ffp-contract=off -fno-math-errno; do
  grep -qF -- " $flag " <<< "$kernel" || { echo "the kernel lacks $flag: $kernel"; exit 1; }
done

# Nothing of its cache is set by Tangency but Tangency's own and what was looked for.
for variable in CMAKE_BUILD_TYPE:STRING=Debug CMAKE_CXX_FLAGS:STRING= BUILD_TESTING; do
  case $variable in
    *=*) grep -qxF "$variable" "$work/CMakeCache.txt" || { echo "not $variable"; exit 1; } ;;
    *) ! grep -q "^$variable:" "$work/CMakeCache.txt" || { echo "$variable is set"; exit 1; } ;;
  esac
done
