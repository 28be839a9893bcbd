#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: replay.sh FAILING_PROPERTY
# A property that fails says, on a line `RC_PARAMS="..."`, what to set in front of the test program to
# see the same counterexample again, with the shrinks that led to it, at once.
set -euo pipefail
counterexample() { sed -n '/shrinks\?$/,/^\[ /p' <<< "$1" | tail -n +2 | grep -v '^\['; }

first=$(RC_PARAMS='seed=20261122 max_success=1000' "$1" 2>&1) && { echo "it did not fail"; exit 1; }
replay=$(sed -nE 's/^RC_PARAMS="(.*)"$/\1/p' <<< "$first")
[ -n "$replay" ] || { echo "no RC_PARAMS in: $first"; exit 1; }
again=$(RC_PARAMS=$replay "$1" 2>&1) && { echo "the replay did not fail"; exit 1; }
grep -q 'after 1 test' <<< "$again" || { echo "not at once: $again"; exit 1; }
[ -n "$(counterexample "$first")" ]
diff <(counterexample "$first") <(counterexample "$again")
