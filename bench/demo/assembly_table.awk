# SPDX-License-Identifier: MIT
# The figures of the assemblies, a column a summary.json, as an HTML table's head and body. Reads the
# summaries (one "name": value a line, as tangency-dem writes them) in the order of -v sizes=.
FNR == 1 { ++runs }
match($0, /"[a-z_]+": */) {
  name = substr($0, RSTART + 1, RLENGTH - 1)
  sub(/": *$/, "", name)
  text = substr($0, RSTART + RLENGTH)
  gsub(/[",]/, "", text)
  value[runs, name] = text
}
END {
  n = split(sizes, size, " ")
  printf "<thead><tr><th scope=\"col\">particles</th>"
  for (k = 1; k <= n; ++k) printf "<th scope=\"col\" class=\"number\">%s</th>", size[k]
  print "</tr></thead>\n<tbody>"
  row("coordination number", "coordination_number", 1, "%.3f")
  row("&emsp;its standard deviation over particles", "coordination_std", 1, "%.3f")
  row("contacts", "contacts", 1, "%d")
  row("particles with fewer than two contacts", "rattlers", 1, "%d")
  row("porosity", "porosity", 1, "%.4f")
  row("mean normal force, GN", "mean_normal_force", 1e-9, "%.3f")
  row("mean overlap, m", "mean_overlap", 1, "%.4f")
  row("mean stress, MPa", "mean_stress", 1e-6, "%.3f")
  row("&emsp;σ<sub>xx</sub>, MPa", "s_xx", 1e-6, "%.3f")
  row("&emsp;σ<sub>yy</sub>, MPa", "s_yy", 1e-6, "%.3f")
  row("&emsp;σ<sub>zz</sub>, MPa", "s_zz", 1e-6, "%.3f")
  row("inertial fraction", "inertial_fraction", 1, "%.1e")
  row("cycles", "cycles", 1, "%d")
  row("wall time, s", "wall_seconds", 1, "%.1f")
  print "</tbody>"
}

function row(label, name, scale, format,   k, text) {
  printf "<tr><th scope=\"row\">%s</th>", label
  for (k = 1; k <= n; ++k) {
    text = (k, name) in value ? sprintf(format, scale * value[k, name]) : ""
    if (match(text, /e[-+]0*/))
      text = substr(text, 1, RSTART - 1) "&nbsp;×&nbsp;10<sup>" \
        (substr(text, RSTART + 1, 1) == "-" ? "−" : "") substr(text, RSTART + RLENGTH) "</sup>"
    sub(/^-/, "−", text)
    printf "<td class=\"number\">%s</td>", text
  }
  print "</tr>"
}
