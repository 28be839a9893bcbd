# SPDX-License-Identifier: MIT
# A sentence on how far the computed overlaps of profiles.csv are from the expected, for -v motion=.
BEGIN { FS = "," }
NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
$column["motion"] == motion {
  contact = $column["contact"]
  if (!(contact in seen)) { seen[contact] = 1; order[++contacts] = contact }
  s = abs($column["displacement"])
  if (s > range) range = s
  n = ++samples[contact]
  at[contact, n] = s
  difference[contact, n] = abs($column["overlap"] - $column["expected"])
}
END {
  # Room for the rounding of a displacement.
  whole = half = quarter = 0
  for (k = 1; k <= contacts; ++k) {
    whole = max(whole, largest(order[k], 1.001 * range))
    quarter = max(quarter, largest(order[k], 0.2501 * range))
  }
  unit = motion == "rotation" ? " rad" : " b"
  if (motion == "normal") {
    print "Largest difference between computed and expected: " scientific(whole) " b, which is rounding."
    exit
  }
  print "Largest difference between computed and expected: " scientific(quarter) \
    " b for up to " 0.25 * range unit ", " scientific(whole) " b over the range shown."
  print "It falls with the power"
  for (k = 1; k <= contacts; ++k) {
    power = log(largest(order[k], 0.501 * range) / largest(order[k], 0.2501 * range)) / log(2)
    printf "%s %.2f (%s)", k == 1 ? "" : k == contacts ? " and" : ",", power, order[k]
  }
  print " of the motion: that of the first term left out, the fourth where the contact is" \
    " symmetric and the third where not."
}

function abs(x) { return x < 0 ? -x : x + 0 }
function max(x, y) { return x > y ? x : y }
function largest(contact, range,   n, x) {
  x = 0
  for (n = 1; n <= samples[contact]; ++n)
    if (at[contact, n] <= range) x = max(x, difference[contact, n])
  return x
}
function scientific(x,   parts) {
  split(sprintf("%.1e", x), parts, "e")
  sub(/-/, "−", parts[2]); sub(/^\+/, "", parts[2])
  sub(/0/, "", parts[2])
  return parts[1] "&nbsp;×&nbsp;10<sup>" parts[2] "</sup>"
}
