# SPDX-License-Identifier: MIT
# Of frames of tangency-dem, told by frame_text.py, an item a line, makes what assembly.pov includes: a
# file particles-NAME.inc a frame, the names from -v names= in the order of the frames. Prints the colours'
# legend, with the numbers of the last frame, in HTML.
BEGIN { split(names, name, " ") }
FNR == 1 { ++frames }
/<DataArray/ {
  array = "points"
  if (match($0, /Name="[^"]*"/)) array = substr($0, RSTART + 6, RLENGTH - 7)
  reading = 1
  next
}
/<\/DataArray>/ { reading = 0 }
reading { item[frames, array, count[frames, array]++] = $0 }
END {
  least = most = item[1, "contacts", 0] + 0
  for (k = 1; k <= frames; ++k)
    for (i = 0; i < count[k, "contacts"]; ++i) {
      c = item[k, "contacts", i] + 0
      if (c < least) least = c
      if (c > most) most = c
      ++having[k, c]
    }
  for (k = 1; k <= frames; ++k) write_scene("particles-" name[k] ".inc")
  print "<span class=\"legend\">"
  for (c = least; c <= most; ++c) {
    find_colour(c)
    printf "<span><i style=\"background:rgb(%d,%d,%d)\"></i>%d (%d)</span>\n", 255 * red, \
      255 * green, 255 * blue, c, having[frames, c]
  }
  print "</span>"
}

function write_scene(file,   c, i) {
  print "#declare Cell = <" diagonal(item[k, "cell", 0]) ">;" > file
  for (c = least; c <= most; ++c) {
    find_colour(c)
    printf "#declare C%d = pigment { color srgb <%.3f,%.3f,%.3f> }\n", c, red, green, blue > file
  }
  for (i = 0; i < count[k, "points"]; ++i)
    print "sphere { 0, 0.5 matrix <" commas(item[k, "axes", i]) "," commas(item[k, "points", i]) \
      "> pigment { C" item[k, "contacts", i] + 0 " } finish { Surface } }" > file
  close(file)
}

# Of the three edge vectors of a box its three edges.
function diagonal(edges,   e) { split(edges, e, / +/); return e[1] "," e[5] "," e[9] }

function commas(text) { gsub(/ +/, ",", text); return text }

# The colour map viridis from the least number of contacts to the most, by straight lines between
# five of its colours; dark to light, so that it also speaks to readers who see no hues.
function find_colour(c,   stops, i, t) {
  split("0.267 0.005 0.329 0.231 0.322 0.545 0.129 0.569 0.549 0.369 0.788 0.384 0.992 0.906 0.145",
        stops, " ")
  t = most == least ? 0 : 4 * (c - least) / (most - least)
  i = int(t)
  if (i > 3) i = 3
  t -= i
  red = stops[3 * i + 1] * (1 - t) + stops[3 * i + 4] * t
  green = stops[3 * i + 2] * (1 - t) + stops[3 * i + 5] * t
  blue = stops[3 * i + 3] * (1 - t) + stops[3 * i + 6] * t
}
