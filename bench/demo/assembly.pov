// SPDX-License-Identifier: MIT
// The assembly of Size particles in its periodic cell, from particles-assembly-SIZE.inc, which build_page
// makes of a frame: Cell, the edges of the cell, and a particle a line, a sphere of radius 1/2 under
// R diag(2a) R', moved to the centre and coloured by its contacts.
#include "light.inc"
#include concat("particles-assembly-", str(Size, 0, 0), ".inc")

#declare Edge = vlength(Cell) / 700;
#macro Edges(U, V, W)  // the four edges along U
  #local i = 0;
  #while (i < 4)
    #local From = mod(i, 2) * V + int(i / 2) * W;
    cylinder { From, From + U, Edge }
    sphere { From, Edge }
    sphere { From + U, Edge }
    #local i = i + 1;
  #end
#end
union {
  Edges(Cell * x, Cell * y, Cell * z)
  Edges(Cell * y, Cell * z, Cell * x)
  Edges(Cell * z, Cell * x, Cell * y)
  pigment { rgb 0.08 }
  finish { ambient 1 diffuse 0 }
  no_shadow
}
View(Cell / 2, <-0.62, -1, 0.52>, 1.07 * vlength(Cell))
