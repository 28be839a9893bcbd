#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: identities.sh SOURCE
# Every numbered identity of a header, `/// (3) A common scaling ...`, is named above a test that
# asserts it, `// geometry/gap.hpp (3)`, or above a function of a check in Python, `# dem/...`, and
# what is named so is an identity.
set -euo pipefail
cd "$1"
status=0
refuse() { echo "$1"; status=1; }

stated=$(grep -roE --include='*.hpp' '^ */// \([0-9]+\) ' geometry dem |
         sed -E 's,: */// , ,; s, $,,' | sort)
[ -n "$stated" ] || { echo "no identity found: this test cannot fail"; exit 1; }
while read -r twice; do
  [ -z "$twice" ] || refuse "$twice is stated twice"
done < <(uniq -d <<< "$stated")

# FILE HEADER (NUMBER) of each name that stands above a test; a name elsewhere has the file `?`.
named=$(find tests \( -name '*.cpp' -o -name '*.py' \) -exec awk '
  FNR == 1 { count = 0 }
  /^(\/\/| *#) (geometry|dem)\/[a-z0-9_\/]+\.hpp( \([0-9]+\))+$/ {
    for (i = 3; i <= NF; ++i) names[count++] = $2 " " $i
    next
  }
  /^(\/\/| *#)/ { next }
  {
    for (i = 0; i < count; ++i) print (/^(TEST|RC_GTEST| *def )/ ? FILENAME : "?"), names[i]
    count = 0
  }' {} +)
while read -r file name; do
  [ "$file" != '?' ] || refuse "$name is named where no test follows"
  grep -qxF "$name" <<< "$stated" || refuse "$file: $name is no identity"
done <<< "$named"

while read -r identity; do
  grep -qF " $identity" <<< "$named" || refuse "$identity is asserted by no test"
done <<< "$(uniq <<< "$stated")"
exit $status
