# SPDX-License-Identifier: GPL-3.0-or-later
# The short tables of docs/speed-accuracy.md, of what bench_speed_accuracy writes:
#   awk -f tables.awk methods.csv [yes-no-first.csv]
# Shown are the options of one family, of limited steps those up to where nothing improves.
BEGIN { FS = ","; shown = "class2"; most_steps = 3 }
/^#/ { next }
FILENAME != file { file = FILENAME; ++files; for (i = 1; i <= NF; ++i) column[files, $i] = i; next }
files == 1 {
  ++rows
  for (name in column) {
    split(name, part, SUBSEP)
    if (part[1] == 1) cell[rows, part[2]] = $column[name]
  }
  row_of[key(rows, value("method"), value("option"), value("level"))] = rows
  if (value("level") != "single" && !(value("level") in seen)) {
    seen[value("level")] = 1
    level[++levels] = value("level")
  }
  inverse += value("ns") / value("inverses")
  next
}
{
  way = "`" ahead("method") "`, " ahead("level") " | " ahead("family")
  if (!(way in ratios)) ways[++ahead_ways] = way
  if (way == ways[1]) shares = shares " " ahead("touching_percent") " % |"
  ratios[way] = ratios[way] sprintf(" %.2f |", ahead("ratio"))
}
END {
  if (rows == 0) exit
  printf "### Calls and options, %s\n\nErrors in the smallest semi-axis of the pair; ns a pair, in " \
         "brackets over those of Eigen's 3x3 inverse (%.2f ns). Of %d pairs.\n\n",
         shown, inverse / rows, cell[1, "pairs"]
  options()
  print "\n### Families\n\nns a pair; of the batch calls at the best instruction set.\n"
  families()
  if ((1, "left") in column) leaving_lanes()
  if (ahead_ways > 0) yes_or_no_first()
}

function value(name) { return cell[rows, name] }
function ahead(name) { return $column[2, name] }
function key(row, method, option, at) {
  return cell[row, "family"] "|" method "|" option "|" cell[row, "steps"] "|" at
}
function error(x) { return x == "" || x ~ /[in]/ ? x : sprintf("%.1e", x) }
function time(row) {
  return sprintf(cell[row, "ns"] < 1000 ? "%.1f (%.1f)" : "%.0f (%.1f)", cell[row, "ns"],
                 cell[row, "inverses"])
}
function name_of(row,   name, steps) {
  name = "`" cell[row, "method"] "`"
  if (cell[row, "option"] != "") name = name ", " cell[row, "option"]
  steps = cell[row, "steps"]
  return steps == "" ? name : name ", " steps (steps == 1 ? " step" : " steps")
}
function rule(first, count,   text) {
  text = "|" first
  for (i = 1; i <= count; ++i) text = text "---:|"
  return text
}
function options(   row, single, there, text, k) {
  text = "| call | gap: median | largest | proven | normal, rad | point | single |"
  for (k = 1; k <= levels; ++k) text = text " " level[k] " |"
  print text "\n" rule("---|", 6 + levels)
  for (row = 1; row <= rows; ++row) {
    single = cell[row, "level"] == "single"
    if (cell[row, "family"] != shown || cell[row, "steps"] > most_steps ||
        !(single || cell[row, "level"] == level[1])) continue
    text = "| " name_of(row) " | " error(cell[row, "gap_error_median"]) " | " \
           error(cell[row, "gap_error_largest"]) " | " error(cell[row, "proven_largest"]) " | " \
           error(cell[row, "normal_error_largest"]) " | " error(cell[row, "point_error_largest"]) \
           " | " (single ? time(row) : "") " |"
    for (k = 1; k <= levels; ++k) {
      there = key(row, cell[row, "method"], cell[row, "option"], level[k])
      text = text " " (!single && there in row_of ? time(row_of[there]) : "") " |"
    }
    print text
  }
}
# Time and largest error of a batch option at the best level.
function batch(row, option,   there) {
  there = key(row, "signed_gaps", option, level[1])
  if (!(there in row_of)) return " | |"
  return sprintf(" %.0f | %s |", cell[row_of[there], "ns"],
                 error(cell[row_of[there], "gap_error_largest"]))
}
function families(   row, there) {
  print "| family | `overlaps` | `signed_gap` | largest error | `local` | `signed_gaps`, standard | " \
        "largest error | fast | largest error |\n" rule("---|", 8)
  for (row = 1; row <= rows; ++row) {
    if (cell[row, "method"] != "signed_gap") continue
    there = key(row, "overlaps", "", "single")
    printf "| %s | %s | %.0f | %s | %d |%s%s\n", cell[row, "family"],
           there in row_of ? sprintf("%.0f", cell[row_of[there], "ns"]) : "", cell[row, "ns"],
           error(cell[row, "gap_error_largest"]), cell[row, "local"], batch(row, "standard"),
           batch(row, "fast")
  }
}
# Of pairs answered by a batch at the best level: how many no lane proves, and how many of them are
# deep.
function left_of(method,   there) {
  there = key(row, method, "standard", level[1])
  if (!(there in row_of)) return " | |"
  return sprintf(" %d | %d |", cell[row_of[there], "left"], cell[row_of[there], "left_deep"])
}
function leaving_lanes() {
  print "\n### What leaves the lanes\n\nPairs of a batch, `standard`, that no lane proves, and those of them that overlap " \
        "deeper than rho, where no normal alone is a proof.\n"
  print "| family | pairs | `signed_gaps`: left | deep | `follow_gaps`: left | deep |\n" rule("---|", 5)
  for (row = 1; row <= rows; ++row) {
    if (cell[row, "method"] != "signed_gap") continue
    print "| " cell[row, "family"] " | " cell[row, "pairs"] " |" left_of("signed_gaps") left_of("follow_gaps")
  }
}
function yes_or_no_first(   k) {
  print "\n### Yes or no first\n\nTime of `overlaps` for all listed pairs and the contact of those " \
        "that overlap, over that of the contact for all pairs, by the share of pairs that touch.\n"
  print "| contact by | family |" shares "\n" rule("---|---|", split(shares, parts, "|") - 1)
  for (k = 1; k <= ahead_ways; ++k) print "| " ways[k] " |" ratios[ways[k]]
}
