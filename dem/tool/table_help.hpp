// SPDX-License-Identifier: MIT
/// @file
/// What the help of `tangency-dem contacts`, `particles` and `schema` says below the options.
#pragma once

namespace tangency::inline v0::dem {

inline constexpr const char* kContactsHelp = R"(
STATE is a final.state, checkpoint.state or one of states/ of a run. A row a contact, sorted by
a, b and the image; contacts with walls are left out. Without a contact: the header alone.
  a b         particles, numbered from 0 in the order of the scene, a <= b
  ix iy iz    the image of b that is touched: moved by so many edges of the cell
  x y z       point of contact, m, beside a where a is (positions are not wrapped into the cell)
  nx ny nz    unit normal, from a to b
  gap         m, < 0: minus the overlap
  bx by bz    branch vector, m: centre of b's image less centre of a
  ax ay az    arm, m: point of contact less centre of a
  fn          normal force, N; a push is positive
  fx fy fz    the whole force of a on b, N
  sliding     1 where the shear force is at the Coulomb limit, else 0. A state does not know a
              friction_coefficient of its stage: --scene, the scene of the run, tells it, on a ramp
              what it has come to; without it is that of [contact]. The contacts/CYCLE.csv of a
              run have that of the stage
  sx sy sz    shear force of a on b, N: the whole force less fn times the normal
  vx vy vz    velocity of b relative to a at the contact, m/s, spins and the strain of the cell in
              it, half a step ago
  curvature_min curvature_max
              principal curvatures of the distance between the two surfaces, 1/m: of equal spheres
              2/r and 2/r; in the plane 0 and that of the outlines
Numbers read back to the same double.

Exit status:
  0    done
  2    STATE is no state of this program's version, or FILE cannot be written
)";

inline constexpr const char* kParticlesHelp = R"(
STATE is a final.state, checkpoint.state or one of states/ of a run. A row a particle:
  id          from 0 in the order of the scene
  type        from 0 in the alphabetical order of the types' names
  x y z       centre, m, not wrapped into the cell
  r1 r2 r3    semi-axes, m
  qw qx qy qz unit quaternion, body to space
  vx vy vz    velocity relative to the strain of the cell, m/s, half a step ago
  wx wy wz    angular velocity in space axes, 1/s, half a step ago
  contacts    that it has, those with walls included; one with its own image counts twice
  s_xx s_yy s_zz s_xy s_yz s_zx
              stress of the particle, Pa, compression positive: of the forces on it, those of walls
              included, over its volume, made symmetric. Times volumes, summed, over the volume of
              the cell it is the stress of history.csv
Numbers read back to the same double.

Exit status:
  0    done
  2    STATE is no state of this program's version, or FILE cannot be written
)";

inline constexpr const char* kSchemaHelp = R"(
The table that checks scenes, section by section: type, unit, default, what is allowed, meaning.
--json prints it for programs: {"schema": 1, "keys": [...]}, of each key section, key, type, unit,
required, default and default_rule (in words, where it is no value), minimum and maximum and whether
they are allowed themselves, choices, stages (kinds that have the key) and meaning. --markdown
prints it as a page with a table a kind of stage.
)";

}  // namespace tangency::inline v0::dem
