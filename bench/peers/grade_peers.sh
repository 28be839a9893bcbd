#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: grade_peers.sh GRADER PEER_ANSWERS TANGENCY PAGE
# Grades other codes and `tangency contact` on every corpus of pairs, each by its own definition of
# depth, and writes the tables between the two marks of PAGE. No time is among them.
set -euo pipefail
grader=$1 peers=$2 tangency=$3 page=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# grade NAME DEFINITION COMMAND: one line a corpus to $work/rows: corpus, NAME, DEFINITION, the counts
# of pairs that failed, ended the program or hung, and the numbers of the tables.
grade() {
  local name=$1 definition=$2 status=0
  "$grader" grade --tool "$3" --definition "$definition" --time-limit 600 \
            --json "$work/grade.json" >"$work/grade.txt" || status=$?
  [ "$status" -le 1 ] || { echo "$name could not be graded" >&2; exit 1; }
  # Of what a code says last, the three counts.
  sed -nE 's/^([a-z]+): the tool ended.*; its last words: ([0-9]+) pairs failed, ([0-9]+) ended the program, ([0-9]+) hung$/\1\t\2 \/ \3 \/ \4/p' \
      "$work/grade.txt" >"$work/ended"
  sed -nE 's/^\{"name":"([a-z]+)\/all\/([^"]*)".*"value":([^}]*)\},?$/\1\t\2\t\3/p' \
      "$work/grade.json" >"$work/values"
  awk -F'\t' -v name="$name" -v definition="$definition" '
    function count(what) { return what in v ? v[what] : "-" }
    function error(what) {
      if (!(what in v)) return "-"
      return v[what] > 1.79e308 ? "inf" : v[what] == 0 ? "0" : sprintf("%.1e", v[what])
    }
    function row() {
      if (corpus == "") return
      printf "%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\n", corpus, name,
        "rows without a gap" in v ? definition : "-", count("wrong relations"), count("overlaps on an external touch"),
        corpus in ended ? ended[corpus] : "0 / 0 / 0", count("rows without a gap"),
        error("gap error, median"), error("gap error, 99 %"), error("gap error, largest"),
        count("reversed normals"), error("normal error, median"), error("normal error, 99 %")
    }
    FILENAME ~ /ended$/ { ended[$1] = $2; next }
    $1 != corpus { row(); split("", v); corpus = $1 }
    { v[$2] = $3 }
    END { row() }' "$work/ended" "$work/values" >>"$work/rows"
  sed -nE 's/^([a-z]+)\tpairs\t([0-9]+)$/\1\t\2/p' "$work/values" >"$work/sizes"
}

version=$("$tangency" --version | awk '{ print $2 }')
for method in common-normal perram-wertheim midpoint-potential; do
  grade "Tangency $version \`contact --method $method\`" "$method" "'$tangency' contact --method $method"
done
"$peers" --list >"$work/list"
while IFS=$'\t' read -r key library number call options definition; do
  [ "$number" = - ] && number= || number=" $number"
  grade "$library$number \`$call\`, $options" "$definition" "'$peers' $key"
done <"$work/list"

while IFS=$'\t' read -r corpus pairs; do
  printf '\n### %s, %s pairs\n\n' "$corpus" "$pairs"
  echo '| code | definition | wrong | touches | failed / ended / hung | without a gap | gap error, median | 99 % | largest | reversed | normal error, median | 99 % |'
  echo '|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|'
  awk -F'\t' -v corpus="$corpus" '
    $1 == corpus { line = "|"; for (i = 2; i <= NF; ++i) line = line " " $i " |"; print line }' "$work/rows"
done <"$work/sizes" >"$work/tables"

awk -v tables="$work/tables" '
  /^<!-- end of the tables -->$/ { inside = 0; ++marks }
  !inside { print }
  /^<!-- tables made by / { inside = 1; ++marks; while ((getline line < tables) > 0) print line; print "" }
  END { exit marks != 2 }' "$page" >"$work/page" || { echo "$page lacks the two marks" >&2; exit 1; }
cat "$work/page" >"$page"
