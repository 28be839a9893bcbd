#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Grades GRADE_TOOL by tangency-verify, GRADE_BINARY or else built of this tree, with GRADE_OPTIONS, and
# writes what was found to the folder GRADE_RESULTS and to GITHUB_STEP_SUMMARY. Ends as the grade does.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
: "${GRADE_TOOL:?the command to grade, which the input tool names, is missing}"
results=${GRADE_RESULTS:-contact-grade}
binary=${GRADE_BINARY:-}
if [ -z "$binary" ]; then
  "$root/.ci/setup" grade
  (cd "$root" && cmake --preset grade >/dev/null && cmake --build --preset grade)
  binary=$root/build/grade/verify/tool/tangency-verify
fi
mkdir -p "$results"
# What an earlier grade has left is not of this one, which may be refused and write nothing.
rm -f "$results"/grade.{html,xml,sarif,json} "$results"/summary.{json,md}
# As a shell reads them: quotes and all.
eval "options=(${GRADE_OPTIONS:-})"
status=0
"$binary" grade --tool "$GRADE_TOOL" ${options[@]+"${options[@]}"} \
  --html "$results/grade.html" --junit "$results/grade.xml" --sarif "$results/grade.sarif" \
  --json "$results/grade.json" --json-summary "$results/summary.json" \
  --summary-md "$results/summary.md" || status=$?
if [ -n "${GITHUB_STEP_SUMMARY:-}" ] && [ -f "$results/summary.md" ]; then
  cat "$results/summary.md" >>"$GITHUB_STEP_SUMMARY"
fi
exit "$status"
