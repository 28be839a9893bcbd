#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: no_libm.sh LIBRARY LIBM [OBJECT:FUNCTION ...]
# Objects of a static library take no function from LIBM (libm.so.6) but those whose result IEEE 754
# or C fixes to the bit, and those that are named: versions of a libm differ in the last bits of the
# others, and what is computed with them is not the same on every machine.
set -euo pipefail
library=$1 libm=$2
shift 2
exact='sqrt|fm(in|ax|a|od)|remainder|fabs|copysign|frexp|ldexp|scalbl?n|ilogb|logb|modf|nextafter'
exact+='|floor|ceil|trunc|round(even)?|rint|nearbyint|l?l(round|rint)'
of_libm=$(nm -D --defined-only "$libm" | awk '{ sub(/@.*/, "", $NF); print $NF }' | sort -u |
          grep -vE "^($exact)[fl]?$")
grep -qx cbrt <<< "$of_libm" || { echo "$libm is no libm: this test cannot fail"; exit 1; }
taken=$(nm -A --undefined-only "$library" 2>/dev/null |
        awk '{ split($1, at, ":"); object = at[2]; sub(/\.cpp\.o$/, "", object); print object ":" $NF }' |
        sort -u)
[ -n "$taken" ] || { echo "$library takes nothing from elsewhere: this test cannot fail"; exit 1; }
status=0
while IFS=: read -r object function; do
  grep -qxF "$function" <<< "$of_libm" || continue
  case " $* " in *" $object:$function "*) continue ;; esac
  echo "$object takes $function from libm"
  status=1
done <<< "$taken"
for allowed in "$@"; do
  grep -qxF "$allowed" <<< "$taken" || { echo "$allowed is allowed and not taken"; status=1; }
done
exit $status
