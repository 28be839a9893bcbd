# SPDX-License-Identifier: GPL-3.0-or-later
# Error against time, of what bench_speed_accuracy writes:
#   awk -f picture.awk methods.csv | gnuplot >error-against-time.svg
# A panel for each of two families where they were measured.
BEGIN {
  FS = ","
  title["class2"] = "class2: aspect to 5, size ratio to 3"
  title["class3"] = "class3: aspect and size ratio to 1000"
  least_error = 1e-17  # an error of 0 has no place on a logarithmic scale
  # The option whose label stands below its point: two others' are above and beside.
  below = "certified"
  # Joined ones by a line, in the order of the rows; labels stand so many characters from the point.
  series("gap_lanes", "cold", "#7fa8d9", 1, "left offset 0.8,0")
  series("gap_lanes", "following", "#8cc7a1", 1, "right offset -0.6,-0.5")
  series("signed_gaps", "", "#1f4e8c", 0, "left offset 0.6,0.6", "left offset -0.5,-0.8")
  series("follow_gaps", "", "#2e7d4f", 0, "right offset -0.6,0.6", "right offset 0.5,-1.6")
  series("signed_gap", "", "#111111", 0, "center offset 0,0.9")
  series("follow_gap", "", "#8a6d00", 0, "center offset 0,-0.9")
  series("start alone", "", "#d9730d", 1, "left offset 0.6,0.5")
  series("perram_wertheim_gap", "", "#b3261e", 0, "right offset -0.6,0.7")
  series("trace_contact", "", "#c2185b", 0, "right offset -0.6,0.7")
  series("midpoint_potential_gap", "", "#6a3d9a", 0, "right offset -0.6,-0.7")
}
/^#/ { next }
!in_rows { for (i = 1; i <= NF; ++i) column[$i] = i; in_rows = 1; next }
{
  at = $column["level"]
  if (at != "single" && !(at in seen)) { seen[at] = 1; level[++levels] = at }
  error = $column["gap_error_largest"]
  if (error == "" || error ~ /[in]/ || !($column["family"] in title)) next
  ++rows
  family[rows] = $column["family"]; method[rows] = $column["method"]; option[rows] = $column["option"]
  at_level[rows] = at; ns[rows] = $column["ns"]
  gap_error[rows] = error < least_error ? least_error : error
  label[rows] = option[rows]
  sub(/^within /, "", label[rows])
  if ($column["steps"] != "") label[rows] = $column["steps"]
  if (!(family[rows] in panel_of)) { panel_of[family[rows]] = 1; panel[++panels] = family[rows] }
}
END {
  if (panels == 0) exit 1
  symbols = "squares: one pair at a time"
  if (levels > 0) symbols = symbols "; discs: " level[1]
  if (levels > 1) symbols = symbols "; circles: " level[2]
  print "set terminal svg size 1000," 600 * panels " fixed enhanced font 'Helvetica,14' background '#ffffff'"
  print "set encoding utf8\nset termoption noenhanced"
  print "set border 3 linewidth 1 linecolor '#555555'"
  print "set tics nomirror out scale 0.5 textcolor '#222222'"
  print "set grid linewidth 0.5 linetype 1 linecolor '#dddddd'"
  print "set logscale xy\nset format x '%g'\nset format y '1e%T'\nset xrange [2:200000]\nset ytics 100"
  print "set xlabel 'ns a pair  (" symbols ")'"
  print "set ylabel 'largest error of the gap / smallest semi-axis'\nset bmargin 8"
  print "set key below center vertical maxrows 4 samplen 1.5 font ',13' textcolor '#222222'"
  print "set multiplot layout " panels ",1"
  for (p = 1; p <= panels; ++p) draw_panel(panel[p])
  print "unset multiplot"
}

function series(name, only, rgb, is_joined, place, place_below) {
  ++kinds
  s_method[kinds] = name; s_option[kinds] = only; colour[kinds] = rgb; joined[kinds] = is_joined
  labels[kinds] = place; labels_below[kinds] = place_below
}
function draw_panel(of,   k) {
  plots = ""; least = 1e300; largest = 0
  for (k = 1; k <= kinds; ++k) {
    plot(of, k, "single", 5, 1)
    if (levels > 0) plot(of, k, level[1], 7, 1)
    if (levels > 1 && !joined[k]) plot(of, k, level[2], 6, 0)
  }
  print "set yrange [" least / 300 ":" largest * 10 "]\nset title '" title[of] "'\nplot " plots
}
# symbol, of gnuplot: 7 filled circle, 6 open circle, 5 filled square.
function plot(of, k, where, symbol, named,   i, n) {
  count = 0
  for (i = 1; i <= rows; ++i) {
    if (family[i] != of || method[i] != s_method[k] || at_level[i] != where ||
        (s_option[k] != "" && option[i] != s_option[k])) continue
    x[++count] = ns[i]; y[count] = gap_error[i]; text[count] = label[i]
    if (y[count] < least) least = y[count]
    if (y[count] > largest) largest = y[count]
  }
  if (count == 0) return
  if (joined[k]) keep_improving_labels()
  merge_labels(labels[k] ~ /^right/)
  add(block(0) " using 1:2 with " \
      (joined[k] ? "linespoints pointsize 0.55" : "points pointsize 0.95") " pointtype " symbol \
      " linewidth 1.4 linecolor rgb '" colour[k] "' " \
      (named ? "title '" s_method[k] (s_option[k] == "" ? "" : ", " s_option[k]) "'" : "notitle"))
  if (!named) return
  add_labels(k, labels[k], 1)
  add_labels(k, labels_below[k], 2)
}
function add(what) { plots = plots (plots == "" ? "" : ", \\\n  ") what }
function log10(z) { return log(z) / log(10) }
function distance(a, b) { return a < b ? log10(b / a) : log10(a / b) }
# The steps after which nothing improves any more need no number.
function keep_improving_labels(   i, best) {
  best = y[1]
  for (i = 2; i <= count; ++i) if (y[i] < best) best = y[i]
  for (i = 1; i <= count; ++i) if (y[i] < 100 * best) text[i] = ""
}
# Points too near each other for two labels get one: at the one next to where labels stand.
function merge_labels(labels_are_left,   i, j, at_point, all) {
  for (i = 1; i <= count; ++i) {
    if (text[i] == "" || text[i] == below) continue
    at_point = i
    all = text[i]
    for (j = i + 1; j <= count; ++j) {
      if (text[j] == "" || text[j] == below || distance(x[i], x[j]) >= 0.1 ||
          distance(y[i], y[j]) >= 0.8) continue
      all = all ", " text[j]
      text[j] = ""
      if ((x[j] < x[at_point]) == labels_are_left) at_point = j
    }
    text[i] = ""
    text[at_point] = all
  }
}
# The points as data of gnuplot. which 0: all; 1: those with a label; 2: those with the one below.
function block(which,   name, i) {
  name = "$p" blocks++
  print name " << EOD"
  for (i = 1; i <= count; ++i) {
    if (which == 0 || (text[i] != "" && (text[i] == below) == (which == 2)))
      print x[i], y[i], "\"" text[i] "\""
  }
  print "EOD"
  return name
}
function add_labels(k, place, which,   i, any) {
  for (i = 1; i <= count; ++i) if (text[i] != "" && (text[i] == below) == (which == 2)) any = 1
  if (any) add(block(which) " using 1:2:3 with labels " place " font ',12' textcolor rgb '" \
               colour[k] "' notitle")
}
