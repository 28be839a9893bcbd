// SPDX-License-Identifier: MIT
// Needles that came to rest in a box of walls, from particles-pile.inc, which build_page makes of a
// frame: Cell, the edges of the box, and a particle a line, coloured by its contacts. Of the walls
// only the floor is drawn.
#include "light.inc"
#include "particles-pile.inc"

#declare Width = Cell.x;
box { <0, 0, -0.025 * Width>, <Width, Cell.y, 0> pigment { rgb 0.93 } finish { ambient 0.5 diffuse 0.5 } }
// The pile is some 0.6 of its width high.
View(<Width / 2, Cell.y / 2, 0.25 * Width>, <-0.62, -1, 0.45>, 1.75 * Width)
