#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: adopts.sh SOURCE TANGENCY_VERIFY WORK [built]
# A project that knows nothing of this one adopts the grader by the lines of docs/grading.md alone, in its
# CTest and in its workflow. It has a fault: both go red, and say why; the fault is mended: both go
# green. With `built` the step has no TANGENCY_VERIFY and builds the grader, as in the documented workflow.
set -euo pipefail
source=$1 verify=$2 work=$3
of_the_step=$verify
[ "${4:-}" != built ] || of_the_step=
page=$source/docs/grading.md
fail() { echo "$*"; exit 1; }
rm -rf "$work"
cp -R "$source/tests/adopter/project" "$work"
cd "$work"

# The block of this kind under this head.
block() { awk -v head="## $1" -v kind="\`\`\`$2" '/^## / { on = $0 == head } on && $0 == kind { in_it = 1; next }
                                                 in_it && /^```/ { exit } in_it' "$page"; }
block "In CMake" cmake >cmake_lines
[ -s cmake_lines ] || fail "docs/grading.md has no block of CMake"
cat cmake_lines >>CMakeLists.txt
block "In GitHub Actions" yaml >yaml_lines
diff yaml_lines <(sed 1d .github/workflows/contact-accuracy.yml) ||
  fail "the workflow of tests/adopter/project is not that of docs/grading.md"
input() { sed -n "s/^          $1: //p" .github/workflows/contact-accuracy.yml; }

ctest_is() {
  local status=0
  cmake -S . -B build -D TANGENCY_VERIFY="$verify" >configured 2>&1 || { cat configured; exit 1; }
  cmake --build build >built 2>&1 || { cat built; exit 1; }
  ctest --test-dir build --output-on-failure >tested 2>&1 || status=$?
  case $1:$status in
    green:0) ;;
    green:*) cat tested; fail "CTest fails, and the fault is mended" ;;
    red:0) fail "CTest passes in spite of the fault" ;;
    red:*) grep -q "FAILED [1-9][0-9]* wrong answers are more than 0; the first: " tested || { cat tested; fail "CTest does not say what is wrong"; } ;;
  esac
}
# What the step of the workflow runs, as .github/actions/grade/action.yml calls it.
step_is() {
  local status=0
  rm -rf contact-grade summary
  env GITHUB_ACTIONS=true GITHUB_STEP_SUMMARY="$work/summary" GRADE_BINARY="$of_the_step" \
      GRADE_TOOL="$(input tool)" GRADE_OPTIONS="$(input options)" \
      "$source/.github/actions/grade/grade.sh" >graded 2>&1 || status=$?
  [ "$status" = "$2" ] || { tail -n 20 graded; fail "the step ends with $status, not $2"; }
  tail -n 1 graded | grep -q "^$1" || { tail -n 20 graded; fail "the last line does not say $1"; }
  for file in html xml sarif json; do
    [ -s "contact-grade/grade.$file" ] || fail "the step has written no grade.$file"
  done
  grep -q . summary || fail "the step has written no summary"
}
ctest_is red
step_is FAILED: 1
grep -q '^::error ' graded || fail "the step has no annotation"
sed -i 's/w = -q\[0\]/w = q[0]/' my_contact.cpp
ctest_is green
step_is passed: 0
! grep -q '^::error ' graded || fail "the step that passes has an annotation"
# A step that is refused shows nothing of the grade before it.
status=0
rm -f summary
env GITHUB_STEP_SUMMARY="$work/summary" GRADE_BINARY="$of_the_step" GRADE_TOOL="$(input tool)" GRADE_OPTIONS="--corpus nowhere" \
    "$source/.github/actions/grade/grade.sh" >refused 2>&1 || status=$?
[ "$status" = 2 ] || { cat refused; fail "a corpus that is not there ends the step with $status, not 2"; }
[ ! -s summary ] && [ -z "$(ls contact-grade)" ] || fail "a step that is refused shows an earlier grade"

# Every name that the action's step reads is an input, every input is read, and each goes to the variable of its name.
action=$source/.github/actions/grade/action.yml
declared=$(awk '/^inputs:/ { on = 1; next } /^[a-z]/ { on = 0 } on && /^  [a-z]+:$/ { sub(":", ""); print $1 }' "$action" | sort)
read=$(grep -o 'inputs\.[a-z]*' "$action" | sed 's/inputs\.//' | sort -u)
[ "$declared" = "$read" ] || fail "inputs declared: $declared; read: $read"
while read -r variable input; do
  [ "$variable" = "GRADE_${input^^}" ] || fail "$variable is the input $input"
done < <(sed -n 's/^ *\(GRADE_[A-Z]*\): \${{ inputs\.\([a-z]*\) }}$/\1 \2/p' "$action")
for variable in $(grep -o 'GRADE_[A-Z]*' "$action" | sort -u); do
  grep -q "$variable" "$source/.github/actions/grade/grade.sh" || fail "$variable is read by nothing"
done
echo "red and green, in CTest and in the workflow's step"
