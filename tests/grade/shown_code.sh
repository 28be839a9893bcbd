#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: shown_code.sh TANGENCY_VERIFY TANGENCY CPP C PYTHON
# The programs CPP and C are row 7 of near as `show` printed it; Python runs what it prints now. Each
# says "GAP +- BOUND along NORMAL", in C++ behind the relation, and the true gap is within the bound.
set -eu
verify=$1 tangency=$2 cpp=$3 c=$4 python=$5
true_gap=$("$verify" show near 7 | awk '$1 == "gap" { print $2; exit }')
said=$(
  "$verify" show near 7 --as csv | "$tangency" contact | awk -F, 'NR == 2 { print "csv", $3, $13 }'
  "$cpp" | awk 'NR == 1 && $0 != "separate" { print "cpp", $0 } NR == 2 { print "cpp", $1, $3 }'
  "$c" | awk '{ print "c", $1, $3 }'
  "$verify" show near 7 --as python | "$python" - | awk '{ print "python", $1, $3 }'
)
echo "$said" | awk -v gap="$true_gap" '
  { off = $2 - gap; print $0 ", off by " off }
  !($3 > 0 && $3 < 1e-12 && off <= $3 && -off <= $3) { bad = 1 }
  END { exit bad || NR != 4 || gap == "" }'
