#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: public_symbols.sh --check|--write LIST HEADERS LIBRARY.a ...
# The functions and data that the libraries' users link: of the static libraries, what geometry/exported.map
# shows of the shared ones and what one of the public headers, the lines of the file HEADERS, names; of
# libtangency_c its C functions; and the constants of tangency.h, which its users have compiled in.
# --check fails where one of the LIST is gone, since programs that were linked with it no longer start, or
# mean something else;
# --write makes the list again, at a release.
set -euo pipefail
how=$1 list=$2 headers=$3
shift 3
export LC_ALL=C

words=$(mktemp)
trap 'rm -f "$words"' EXIT
xargs grep -hoE '[A-Za-z_][A-Za-z_0-9]*' <"$headers" | sort -u >"$words"

constants() {
  sed -nE 's/^ +(TANGENCY_[A-Z_0-9]+ = -?[0-9]+),?$/tangency.h: \1/p' "$(dirname "$0")/../../geometry/bindings/c/tangency.h"
}

symbols() {
  for library in "$@"; do
    local of_library='^_ZN?K?8tangency2v0'
    [ "$(basename "$library")" != libtangency_c.a ] || of_library='^tangency_'
    # Functions and data that have one definition; inline functions come with their users.
    nm --defined-only --extern-only "$library" 2>/dev/null |
      awk -v of_library="$of_library" '$2 ~ /^[TDBR]$/ && $3 ~ of_library { print $3 }' |
      grep -vE '^_ZNK?8tangency2v0(5exact|6detail)' | c++filt |
      awk -v words="$words" -v library="$(basename "$library" .a)" '
        BEGIN { while ((getline word < words) > 0) public[word] = 1 }
        { gsub(/tangency::v0::/, "tangency::"); name = $0; sub(/[(<\[].*/, "", name); sub(/.*[ :~]/, "", name) }
        name ~ /operator|^tangency_/ || name in public { print library ": " $0 }'
  done
}

now=$({ symbols "$@"; constants; } | sort -u)
grep -q '^tangency.h: TANGENCY_OK = 0$' <<< "$now" || { echo "no constant: this test cannot fail"; exit 1; }
[ "$(wc -l <<< "$now")" -gt 100 ] || { echo "hardly any symbol: this test cannot fail"; exit 1; }
case $how in
  --write)
    { echo "# SPDX-License-Identifier: GPL-3.0-or-later"
      echo "# The public symbols at the last release, or since: made by public_symbols.sh --write."
      echo "$now"; } >"$list" ;;
  --check)
    known=$(grep -v '^#' "$list" | sort -u)
    gone=$(comm -23 <(echo "$known") <(echo "$now"))
    if [ -n "$gone" ]; then
      echo "gone since $list was made; users' programs that use them no longer start, or mean something else:"
      echo "$gone"
      exit 1
    fi
    echo "$(wc -l <<< "$known") symbols are there; new ones, which a release adds to the list:" \
         "$(comm -13 <(echo "$known") <(echo "$now") | wc -l)" ;;
  *) sed -n 3p "$0" >&2; exit 2 ;;
esac
