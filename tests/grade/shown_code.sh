#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: shown_code.sh TANGENCY_VERIFY TANGENCY CPP C PYTHON
# The programs CPP and C are row 7 of near as `show` printed it; Python runs what it prints now. Each
# says first, of C++ on its second line, the gap that `tangency contact` answers for the row.
set -eu
verify=$1 tangency=$2 cpp=$3 c=$4 python=$5
gap=$("$verify" inputs near | "$tangency" contact | awk -F, '$1 == 7 { print $3 }')
"$verify" show near 7 --as csv | "$tangency" contact | awk -F, 'NR == 2 { print "csv", $3 }' > said.txt
"$cpp" | awk 'NR == 1 && $0 != "separate" { print "cpp", $0 } NR == 2 { print "cpp", $1 }' >> said.txt
"$c" | awk '{ print "c", $1 }' >> said.txt
"$verify" show near 7 --as python | "$python" - | awk '{ print "python", $1 }' >> said.txt
cat said.txt
awk -v gap="$gap" 'gap == "" || $2 + 0 != gap + 0 { bad = 1; print $1 " differs from " gap }
                   END { exit bad || NR != 4 }' said.txt
