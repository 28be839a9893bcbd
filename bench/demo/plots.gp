# SPDX-License-Identifier: MIT
# The page's plots. Run by build_page in a directory with
#   profile-MOTION-CONTACT.csv  the rows of tangency_profiles of one motion and contact
#   history-N.csv               history.csv of the assembly of N particles, N in `sizes`
# Writes an SVG of each profile and of three columns of the histories.
set terminal svg size 420,320 fixed enhanced font 'Helvetica,14' background '#ffffff'
set encoding utf8
set minussign
set datafile separator comma
set border 3 linewidth 1 linecolor '#555555'
set tics nomirror out scale 0.5 textcolor '#222222'
set grid linewidth 0.5 linetype 1 linecolor '#dddddd'
set title font ',16' textcolor '#222222' offset 0,-0.5
set tmargin 2.2
set bmargin 5
set key at screen 0.53,0.015 center bottom horizontal maxrows 1 samplen 1.6 width -1 font ',13' \
  textcolor '#222222'
blue = '#1f4e8c'; orange = '#d9730d'; grey = '#8a8a8a'; green = '#2e7d4f'

# Panels of one motion share their ranges. Lengths in short semi-axes, b.
set ylabel 'overlap / b, in 10^{-2}'
do for [motion in 'normal tangential rotation'] {
  across = 1.0
  if (motion eq 'normal') {
    set xlabel 'displacement along the normal / b, in 10^{-2}'
    across = 100.0
    set xrange [-3.3:3.3]; set yrange [-2:6]; set xtics 1; set ytics 1
  }
  if (motion eq 'tangential') {
    set xlabel 'tangential displacement / b'
    set xrange [-0.32:0.32]; set yrange [-1.5:2.5]; set xtics 0.1; set ytics 1
  }
  if (motion eq 'rotation') {
    set xlabel 'rotation of B, degrees'
    across = 180.0 / pi
    set xrange [-19:19]; set yrange [-5:10]; set xtics 6; set ytics 5
  }
  do for [contact in 'side-side side-end end-end skew'] {
    data = 'profile-'.motion.'-'.contact.'.csv'
    set output 'profile-'.motion.'-'.contact.'.svg'
    set title contact
    plot 0 with lines linewidth 1 linecolor rgb '#999999' notitle, \
         data using (across * column('displacement')):(100 * column('published')) with lines \
           linewidth 1.6 dashtype (6,4) linecolor rgb grey title 'published', \
         data using (across * column('displacement')):(100 * column('expected')) with lines \
           linewidth 2.2 linecolor rgb orange title 'expected', \
         data using (across * column('displacement')):(100 * column('overlap')) every 4 \
           with points pointtype 7 pointsize 0.42 linecolor rgb blue title 'computed'
  }
}

# Histories.
array colours[3] = [green, orange, blue]
set xlabel 'cycle, in thousands'
set xrange [*:*]; set yrange [0:*]; set xtics autofreq; set ytics autofreq
set offsets 0, 0, graph 0.08, 0
do for [name in 'mean_stress coordination_number porosity'] {
  scale = 1.0
  if (name eq 'mean_stress') { set title 'mean stress, MPa'; scale = 1e-6 }
  if (name eq 'coordination_number') { set title 'coordination number' }
  if (name eq 'porosity') { set title 'porosity' }
  unset ylabel
  set output 'history-'.name.'.svg'
  plot for [i = 1:words(sizes)] 'history-'.word(sizes, i).'.csv' \
    using (1e-3 * column('cycle')):(scale * column(name)) with lines linewidth 2 \
    linecolor rgb colours[i] title 'N = '.word(sizes, i)
}
