# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced by the scripts that use the package as its users do: each consumer is tried, whatever became of
# those before it, and what came out is a line of a table. Before: $work, a folder, and $kind, of which
# kind the libraries are.
table=${table:-$work/table}
failed=0

# consumer NAME COMMAND ...: in a shell of its own, which ends at the first command that fails.
consumer() {
  local name=$1 start=$SECONDS result=passed log=$work/consumer.log
  shift
  set +e
  (set -e; "$@") >"$log" 2>&1 </dev/null
  [ $? = 0 ] || result=FAILED
  set -e
  printf '%s\t%s\t%s\n' "$name" "$kind" "$result" >>"$table"
  printf '%-7s %-56s %s in %d s\n' "$kind" "$name" "$result" $((SECONDS - start))
  if [ $result = FAILED ]; then
    failed=1
    tail -n 40 "$log"
  fi
}

# matrix: the table, a line a consumer and a column a kind, in the order of their first lines.
matrix() {
  awk -F '\t' '
    !($1 in row) { row[$1] = ++rows; name[rows] = $1 }
    !($2 in column) { column[$2] = ++columns; kind[columns] = $2 }
    { result[row[$1], column[$2]] = $3 }
    END {
      printf "%-56s", "consumer"
      for (c = 1; c <= columns; ++c) printf " %-8s", kind[c]
      print ""
      for (r = 1; r <= rows; ++r) {
        printf "%-56s", name[r]
        for (c = 1; c <= columns; ++c) printf " %-8s", (r, c) in result ? result[r, c] : "-"
        print ""
      }
    }' "$table"
}
