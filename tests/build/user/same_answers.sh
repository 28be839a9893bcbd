#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: same_answers.sh FEATURE PROGRAM OTHER [layout]
# Two programs that differ in what their parts are compiled for print the same, however often: where
# memory lies changes from run to run. FEATURE is what the processor must have, or `any`.
set -euo pipefail
feature=$1 program=$2 other=$3
shift 3
[ "$feature" = any ] || grep -qw "$feature" /proc/cpuinfo || { echo "no $feature here"; exit 77; }
answers=$("$program" "$@")
[ "$(wc -l <<< "$answers")" -gt 5 ] || { echo "few answers: this test cannot fail"; exit 1; }
for ((run = 1; run <= 20; ++run)); do
  found=$("$other" "$@") || { echo "run $run ended with status $?"; exit 1; }
  diff <(echo "$answers") <(echo "$found") || { echo "in run $run"; exit 1; }
done
[ "$*" = layout ] || exit 0

# No public type may need more alignment than a double: what does is laid out by the processor.
awk '$NF > 8 { print "alignment:", $0; found = 1 } END { exit found }' <<< "$answers"
