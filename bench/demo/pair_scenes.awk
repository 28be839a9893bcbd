# SPDX-License-Identifier: MIT
# Of contacts.csv and pairs.csv, in this order, makes pair-1.inc, pair-2.inc, ... for pair.pov and
# prints their number. All pairs have orientation columns.
BEGIN { FS = "," }
{ sub(/\r$/, "") }
FILENAME != previous { previous = FILENAME; ++file; in_header = 1 }
/^#/ || /^ *$/ { next }
in_header { in_header = 0; for (i = 1; i <= NF; ++i) column[file, $i] = i; next }
file == 1 {
  known[++answers] = cell("gap") != ""
  point_a[answers] = vector("pa.x", "pa.y", "pa.z")
  point_b[answers] = vector("pb.x", "pb.y", "pb.z")
  normal[answers] = vector("nx", "ny", "nz")
  next
}
{
  scene = "pair-" ++pairs ".inc"
  print "#declare A = " body("a.") ";" > scene
  print "#declare B = " body("b.") ";" > scene
  print "#declare Known = " known[pairs] + 0 ";" > scene
  if (known[pairs]) {
    print "#declare Point_a = " point_a[pairs] ";" > scene
    print "#declare Point_b = " point_b[pairs] ";" > scene
    print "#declare Normal = " normal[pairs] ";" > scene
  }
  surrounding_sphere()
  close(scene)
}
END { print pairs }

function cell(name) { return $column[file, name] }
function vector(x, y, z) { return "<" cell(x) "," cell(y) "," cell(z) ">" }

# The unit sphere under R diag(r1, r2, r3), a row an axis, then moved to the centre.
function body(of,   w, x, y, z, s) {
  w = cell(of "qw"); x = cell(of "qx"); y = cell(of "qy"); z = cell(of "qz")
  s = 2 / (w * w + x * x + y * y + z * z)
  return "sphere { 0, 1 matrix <" \
    axis(cell(of "r1"), 1 - s * (y * y + z * z), s * (x * y + w * z), s * (z * x - w * y)) "," \
    axis(cell(of "r2"), s * (x * y - w * z), 1 - s * (z * z + x * x), s * (y * z + w * x)) "," \
    axis(cell(of "r3"), s * (z * x + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y)) "," \
    cell(of "x") "," cell(of "y") "," cell(of "z") "> }"
}
function axis(r, x, y, z) { return sprintf("%.9g,%.9g,%.9g", r * x, r * y, r * z) }

function longest(of,   r, i) {
  r = 0
  for (i = 1; i <= 3; ++i) if (cell(of "r" i) + 0 > r) r = cell(of "r" i) + 0
  return r
}

# Around the bounding spheres of both bodies.
function surrounding_sphere(   dx, dy, dz, d, ra, rb, radius, t) {
  dx = cell("b.x") - cell("a.x"); dy = cell("b.y") - cell("a.y")
  dz = cell("b.z") - cell("a.z")
  d = sqrt(dx * dx + dy * dy + dz * dz)
  ra = longest("a."); rb = longest("b.")
  if (ra >= d + rb) { radius = ra; t = 0 }
  else if (rb >= d + ra) { radius = rb; t = 1 }
  else { radius = (d + ra + rb) / 2; t = (radius - ra) / d }
  printf "#declare Middle = <%.9g,%.9g,%.9g>;\n", cell("a.x") + t * dx, \
    cell("a.y") + t * dy, cell("a.z") + t * dz > scene
  printf "#declare Radius = %.9g;\n", radius > scene
}
