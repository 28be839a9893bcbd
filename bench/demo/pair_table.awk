# SPDX-License-Identifier: MIT
# The contacts as a table, with the comment above a pair as its title. Reads pairs.csv, then
# contacts.csv. -v format=text: for a terminal; -v format=html: the rows of the page's table.
BEGIN { FS = ","; if (format == "text") line("pair", "relation", "gap", "normal", "status") }
{ sub(/\r$/, "") }
FILENAME != previous { previous = FILENAME; ++file; in_header = 1 }
/^#/ { comment = substr($0, 2); sub(/^ */, "", comment); next }
/^ *$/ { next }
in_header { in_header = 0; for (i = 1; i <= NF; ++i) column[file, $i] = i; next }
file == 1 { title[pairs++] = comment; next }
{
  row = cell("row")
  relation = cell("relation")
  if (cell("inner") != "") relation = relation " (" cell("inner") " inside)"
  gap = cell("gap") == "" ? "" : fixed(cell("gap"))
  normal = cell("gap") == "" ? "" : \
    short(cell("nx")) ", " short(cell("ny")) ", " short(cell("nz"))
  if (format == "text") line(title[row], relation, gap, normal, cell("status"))
  else html()
}

function cell(name) { return $column[file, name] }
# Six decimals, unless they would hide what the gap is.
function fixed(x) { return sprintf(x != 0 && x < 1e-5 && x > -1e-5 ? "%.2e" : "%.6f", x) }
function short(x) { x = sprintf("%.3f", x); return x == "-0.000" ? "0.000" : x }
function line(name, relation, gap, normal, status) {
  printf "  %-40s %-25s %9s  %-22s  %s\n", name, relation, gap, normal, status
}
function middle(i) { return short((cell("pa." i) + cell("pb." i)) / 2) }
function html(   picture, error, point) {
  # POV-Ray pads the numbers of an animation's frames to the width of the last.
  picture = row + 1
  while (length(picture) < length(pairs "")) picture = "0" picture
  error = cell("gap_error") == "" ? "" : sprintf("<br><small>± %.1e</small>", cell("gap_error"))
  point = gap == "" ? "" : middle("x") ", " middle("y") ", " middle("z")
  gsub(/-/, "−", gap); gsub(/-/, "−", normal); gsub(/-/, "−", point)
  print "<tr><td class=\"picture\">"
  print "@image pair-" picture ".png " title[row]
  print "</td><th scope=\"row\">" title[row] "</th><td>" relation "</td><td class=\"number\">" gap \
    error "</td><td class=\"vector\">" normal "</td><td class=\"vector\">" point "</td><td>" \
    cell("status") "</td></tr>"
}
