#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: house.sh SOURCE
# Every text file names its licence, every [Key and year] that is cited stands in the bibliography, and
# no two decisions have one number.
set -euo pipefail
cd "$1"
status=0
folders=(bench check demo dem docs geometry tests verify CMakeLists.txt CHANGELOG.md CITATION.cff
         CONTRIBUTING.md LICENSE README.md SECURITY.md .ci .github)

while read -r file; do
  case $file in *.bin | *.png | *.json | *.xz) continue ;; esac  # none of them has comments
  grep -q 'SPDX-License-Identifier' "$file" || { echo "$file names no licence"; status=1; }
done < <(find "${folders[@]}" -type f)

cited=$(grep -rhoE '\[[A-Z][A-Za-z]+(19|20)[0-9]{2}' "${folders[@]}" | tr -d '[' | sort -u)
[ -n "$cited" ] || { echo "no citation found: this test cannot fail"; exit 1; }
for key in $cited; do
  grep -q "{$key," docs/bibliography.bib || { echo "[$key] is not in docs/bibliography.bib"; status=1; }
done
for number in $(basename -a docs/decisions/*.md | cut -c1-4 | uniq -d); do
  echo "docs/decisions: $number is the number of two"
  status=1
done
exit $status
