#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: finding.sh FUZZ RUN
# A finding ends the run, is named, and its input shows the same again; counts go on where they were, and
# the table of tests/fuzz/run has them and the findings.
set -euo pipefail
fuzz=$1
run=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "$1" >&2; cat "$folder/said" >&2; exit 1; }

"$fuzz" planted --runs 100000 --findings "$folder" >"$folder/said" 2>&1 && fail "the planted fault was not found"
grep -q '^planted: a fault$' "$folder/said" || fail "the fault is not named"
grep -q "^the input is in $folder/planted-finding$" "$folder/said" || fail "the input is not named"
"$fuzz" planted --input "$folder/planted-finding" --findings "$folder" >"$folder/said" 2>&1 &&
  fail "the kept input breaks nothing"
grep -q '^planted: a fault$' "$folder/said" || fail "the kept input shows something else"

# The folder is made.
for _ in 1 2; do "$fuzz" history --runs 10 --inputs "$folder" --counts "$folder/counts" >"$folder/said"; done
grep -q ' runs 24$\|runs 24,' "$folder/said" || fail "a second run adds nothing to the counts of the first"
# Where counts cannot be kept nothing is run, and nothing that was counted is lost.
cp "$folder/counts/history" "$folder/before"
mkdir "$folder/counts/history.part"
refused() { # OPTION DIR WORDS: it is refused with these
  local status=0
  "$fuzz" history --runs 10 --inputs "$folder" "$1" "$2" >"$folder/said" 2>&1 || status=$?
  [ $status -eq 2 ] && grep -qF -- "$3" "$folder/said" && ! grep -q '^history:' "$folder/said" ||
    fail "$1 $2 is not refused before anything is run: $status"
}
refused --counts "$folder/counts" "--counts: $folder/counts/history cannot be written"
cmp -s "$folder/before" "$folder/counts/history" || fail "the counts of earlier runs are lost"
rmdir "$folder/counts/history.part"
refused --counts "$folder/before" "--counts $folder/before: must be a folder"
refused --findings "$folder/before/within" "--findings $folder/before/within: must be a folder"
"$fuzz" nothing >"$folder/said" 2>&1 && fail "a target that is none is taken"
grep -q 'nothing is no target' "$folder/said" || fail "a target that is none is not named"

mkdir "$folder/findings"
table() { "$run" --seconds 0 --state "$folder" --program "$fuzz" history state >"$folder/said" 2>&1; }
table || fail "a table without findings is not passed"
grep -Eq '^history +24 ' "$folder/said" || fail "the table has other counts"
grep -q '^24 runs, 24 of them of readers, 0 findings$' "$folder/said" || fail "the table has another sum"
touch "$folder/findings/state-finding" "$folder/findings/state-changes-finding"
table && fail "a table with a finding is passed"
grep -Eq '^state .* 1$' "$folder/said" || fail "a finding is not counted at its target alone"
