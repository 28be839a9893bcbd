# SPDX-License-Identifier: MIT
# Run by draw_profiles in a folder with profile-MOTION-CONTACT.csv (rows of tangency_profiles) and
# FAMILY-published.txt and FAMILY-cut.txt (depth / rho and median difference, of bench_trace).
set encoding utf8
set minussign
blue = '#1f4e8c'; orange = '#d9730d'; grey = '#8a8a8a'; green = '#2e7d4f'; red = '#b3262e'
array colours[5] = [blue, orange, green, red, grey]
motions = 'normal tangential rotation'
contacts = 'side-side side-end end-end skew'
array across[3] = [100.0, 1.0, 180.0 / pi]
array label[3] = ['along the normal / b, in 10^{-2}', 'tangential / b', 'rotation of B, degrees']
# Axes as the demo's; and none, for the plot that holds a legend alone.
axes = "set border 3 linewidth 1 linecolor '#555555'; \
  set tics nomirror out scale 0.5 textcolor '#222222'; \
  set grid linewidth 0.5 linetype 1 linecolor '#dddddd'; unset key"
legend = "unset border; unset tics; unset grid; unset title; unset xlabel; unset ylabel; \
  set lmargin 0; set rmargin 0; set tmargin 0; set bmargin 0; set origin 0,0; \
  set xrange [0:1]; set yrange [0:1]; \
  set key center center horizontal maxrows 1 samplen 3 width 3"

# Overlap: rows are motions, columns contacts.
set terminal pngcairo size 1680,1290 fontscale 1.35 linewidth 1.3 enhanced font 'Helvetica,13' \
  background '#ffffff'
set output 'profiles.png'
set datafile separator comma
set multiplot layout 3,4 margins 0.07,0.99,0.125,0.955 spacing 0.042,0.095
@axes
do for [m = 1:3] {
  if (m == 1) { set xrange [-3.3:3.3]; set yrange [-1.5:5.5]; set xtics 1; set ytics 1 }
  if (m == 2) { set xrange [-0.32:0.32]; set yrange [-1.5:2.5]; set xtics 0.2; set ytics 1 }
  if (m == 3) { set xrange [-19:19]; set yrange [-5:10]; set xtics 9; set ytics 5 }
  do for [c = 1:4] {
    if (m == 1) { set title word(contacts, c) font ',17' offset 0,-0.4 } else { unset title }
    if (c == 1) { set ylabel 'overlap / b, in 10^{-2}' offset 0,0 } else { unset ylabel }
    set xlabel label[m] offset 0,0.4
    data = 'profile-'.word(motions, m).'-'.word(contacts, c).'.csv'
    plot 0 with lines linewidth 1 linecolor rgb '#999999', \
         data using (across[m] * column('displacement')):(100 * column('published')) with lines \
           linewidth 1.6 dashtype (6,4) linecolor rgb grey, \
         data using (across[m] * column('displacement')):(100 * column('expected')) with lines \
           linewidth 2.2 linecolor rgb orange, \
         data using (across[m] * column('displacement')):(100 * column('trace')) every 8::4 \
           with points pointtype 6 pointsize 2 linewidth 1.6 linecolor rgb green, \
         data using (across[m] * column('displacement')):(100 * column('overlap')) every 4 \
           with points pointtype 7 pointsize 0.9 linecolor rgb blue
  }
}
@legend
set size 1,0.06
plot NaN with lines linewidth 1.6 dashtype (6,4) linecolor rgb grey title 'published formula', \
     NaN with lines linewidth 2.2 linecolor rgb orange title 'expansion at the start', \
     NaN with points pointtype 6 pointsize 2 linewidth 1.6 linecolor rgb green \
       title 'trace scheme', \
     NaN with points pointtype 7 pointsize 0.9 linecolor rgb blue title 'common normal'
unset multiplot
set output

# What the trace scheme and the chord give too much.
reset
set encoding utf8
set minussign
set terminal pngcairo size 1680,560 fontscale 1.35 linewidth 1.3 enhanced font 'Helvetica,13' \
  background '#ffffff'
set output 'profile-differences.png'
set datafile separator comma
set multiplot layout 1,3 margins 0.1,0.99,0.29,0.88 spacing 0.065,0.1
@axes
do for [m = 1:3] {
  if (m == 1) { set xrange [-3.3:3.3]; set xtics 1; set yrange [-0.25:0.05] }
  if (m == 2) { set xrange [-0.32:0.32]; set xtics 0.2; set yrange [-0.12:0.02] }
  if (m == 3) { set xrange [-19:19]; set xtics 9; set yrange [-0.45:0.05] }
  set ytics autofreq
  set title word(motions, m) font ',17' offset 0,-0.4
  if (m == 1) { set ylabel "scheme − common normal,\n% of the overlap" offset -0.5,0 } \
  else { unset ylabel }
  set xlabel label[m] offset 0,0.4
  plot for [c = 1:4] 'profile-'.word(motions, m).'-'.word(contacts, c).'.csv' \
    using (across[m] * column('displacement')): \
      (column('overlap') > 1e-4 ? 100 * (column('trace') / column('overlap') - 1) : NaN) \
    with lines linewidth 2.2 linecolor rgb colours[c], \
  for [c = 1:3] 'profile-'.word(motions, m).'-'.word(contacts, c).'.csv' \
    using (across[m] * column('displacement')): \
      (column('overlap') > 1e-4 ? 100 * (column('chord') / column('overlap') - 1) : NaN) \
    with lines linewidth 2.2 dashtype (6,4) linecolor rgb colours[c]
}
@legend
set size 1,0.12
plot for [c = 1:4] NaN with lines linewidth 2.2 linecolor rgb colours[c] \
       title 'trace, '.word(contacts, c), \
     NaN with lines linewidth 2.2 dashtype (6,4) linecolor rgb '#222222' title 'chord, alike'
unset multiplot
set output

# Depth against the common normal's, by depth.
reset
set encoding utf8
set minussign
set terminal pngcairo size 1150,680 fontscale 1.35 linewidth 1.3 enhanced font 'Helvetica,13' \
  background '#ffffff'
set output 'trace-depth.png'
@axes
set logscale xy
set format xy '10^{%L}'
set xrange [5e-6:2e-1]; set yrange [1e-7:1]
set xlabel 'depth / sum of the least radii of curvature' offset 0,0.2
set ylabel 'median of |depth / true depth − 1|' offset 0.5,0
set rmargin at screen 0.7
set key at screen 0.72,0.55 left center vertical Left reverse samplen 2
families = 'class1 oblate class2 class3 plane'
plot for [c = 1:5] word(families, c).'-published.txt' using 1:2 with linespoints linewidth 2.2 \
       pointtype 7 pointsize 1 linecolor rgb colours[c] title word(families, c).', published', \
     for [c = 1:5] word(families, c).'-cut.txt' using 1:2 with linespoints linewidth 2.2 \
       dashtype (6,4) pointtype 6 pointsize 1.2 linecolor rgb colours[c] \
       title word(families, c).', cut again'
