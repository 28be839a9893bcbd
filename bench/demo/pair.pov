// SPDX-License-Identifier: MIT
// The pairs of the pair file, a frame of an animation each, from pair-N.inc, which build_page makes:
//   A, B            the bodies as objects
//   Point_a, Point_b, Normal   witness points and unit normal (Known = 0 without an answer)
//   Middle, Radius  a sphere around both
#include "light.inc"
#include concat("pair-", str(frame_number, 0, 0), ".inc")

object { A pigment { rgbt <0.10, 0.32, 0.66, 0.5> } finish { Surface } }
object { B pigment { rgbt <0.92, 0.42, 0.02, 0.4> } finish { Surface } }
#if (Known)
  union {
    // From B's witness point to A's, the overlap or the distance; the arrow is the normal.
    #declare Arrow = 0.5 * Radius;
    #declare Thin = 0.016 * Radius;
    #declare From = (Point_a + Point_b) / 2;
    cylinder { From, From + 0.8 * Arrow * Normal, Thin }
    cone { From + 0.8 * Arrow * Normal, 3 * Thin, From + Arrow * Normal, 0 }
    sphere { Point_a, 2.2 * Thin }
    sphere { Point_b, 2.2 * Thin }
    pigment { rgb 0.03 }
    finish { ambient 1 diffuse 0 }
    no_shadow
  }
#end
View(Middle, <-0.35, -1, 0.4>, 2.1 * Radius * image_width / image_height)
