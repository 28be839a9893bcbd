#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: valgrind.sh BUILD FOLDER
# The tools under valgrind: every subcommand of tangency on rows of its corpus, a run of the simulator
# and what reads its results, and a grade. No error, no memory lost. Ends with a line as ctest's.
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$(cd "$1" && pwd)
mkdir -p "$2"
cd "$2"
tangency=$build/geometry/tool/tangency
dem=$build/dem/tool/tangency-dem
verify=$build/verify/tool/tangency-verify
all=0
failed=0

under() {
  all=$((all + 1))
  local status=0
  valgrind --error-exitcode=99 --leak-check=full --errors-for-leak-kinds=definite,indirect,possible \
    "$@" >"$all.out" 2>"$all.err" || status=$?
  # 1: some row is not answered, or a grade has failed.
  if [ $status -le 1 ] && grep -q 'ERROR SUMMARY: 0 errors' "$all.err"; then
    echo "clean: ${*#"$build"/}"
  else
    failed=$((failed + 1))
    echo "status $status: ${*#"$build"/}"
    tail -n 40 "$all.err"
  fi
}

rows() { head -n 24 "$source/verify/corpora/$1.csv" >"$1.csv"; echo "$1.csv"; }

for corpus in near nested matrices; do under "$tangency" contact --threads 2 "$(rows $corpus)"; done
under "$tangency" contact --columns F,mu,clearance,margin,curvature_min,volume "$(rows deep)"
under "$tangency" contact --method trace "$(rows classes)"
under "$tangency" overlap "$(rows extreme)"
under "$tangency" classify "$(rows quadrics)"
under "$tangency" ellipse "$(rows ellipses)"
under "$tangency" point "$(rows points)"
under "$tangency" wall "$(rows walls)"
under "$tangency" ray "$(rows rays)"
under "$tangency" time "$(rows times)"
under "$tangency" neighbours --contacts --periodic 80,16,8 "$(rows neighbours-periodic)"

sed 's/^duration = .*/duration = 40/' "$source/dem/scenes/impact.toml" >impact.toml
under "$dem" run impact.toml --out impact --threads 2 --quiet
under "$dem" report impact
under "$dem" contacts impact/final.state --out contacts.csv
under "$dem" particles impact/final.state --out particles.csv

"$tangency" overlap "$source/verify/corpora/near.csv" >answers.csv
under "$verify" grade --corpus near --answers answers.csv --json grade.json
echo "valgrind, $failed tests failed out of $all"
[ $failed -eq 0 ]
