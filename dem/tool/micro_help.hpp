// SPDX-License-Identifier: MIT
/// @file
/// What `tangency-dem micro --help` says.
#pragma once

namespace tangency::dem {

inline constexpr const char* kMicroHelp = R"(
Contacts are those between particles: contacts with walls are counted and in no average.
Compression is positive. Partitions of directions, by N = --classes from 1 to 100:
  near-uniform   24 N^2 classes of nearly equal area; in the plane 8 N equal arcs
  polar          N rings of 2 N sectors about z, N from 2; in the plane 2 N equal arcs

Prints coordination, averages over orientations, the anisotropies of order 2 with their
standard errors (a magnitude is the root of the sum of squares of all components), the stress as
it is summed over contacts and as the theory makes it of the anisotropies, and what each of
these gives to the shear stress ratio. What is not defined is -: all without contacts, of spheres
what needs the axis of a body, in the plane what is of order 4.

JSON, null where something is not defined:
  fabric, normal_force, tangential_force, branch_normal, branch_tangential, branch_length,
  long_axes, local_contacts (in body axes), contact_vectors (in space axes)
                        second 3x3, fourth 3x3x3x3, magnitude, their standard errors, and the
                        share of the variance of class means that orders 2, and 2 and 4, leave
  f0, z0, mean_branch_length
                        means over orientations
  coordination_number, contact_density (contact sides per volume), stress (as summed: not made
  symmetric), stress_force_fabric (its parts, their sum, and that of the published seven)
  published, contact_sums
                        the same of forces and branches by the two other estimators: class means
                        at the middles of classes, and sums over contacts
  dimensions, particles, contacts, wall_contacts, cycle, time, volume, cell, partition,
  classes, class_count, empty_classes
  coordination          mean, without_rattlers, rattlers, std, skewness, excess_kurtosis,
                        histogram
  stresses              measured, seven, eight, fourth (models of orders 2 and 4), noshape,
                        independent (class means multiplied): tensor, mean, principal, a_s
  s0, D_n, shares, shares_eight, axisymmetric_shares, signed_magnitudes, signs, joint_signs,
  coaxiality, part_coaxiality, axisymmetry, stress_asymmetry, force_asymmetry,
  branch_asymmetry, vector_normal_angle_mean_deg, vector_normal_angle_largest_deg,
  direction_groups, radial_rings (polar), plane, mean_normal_force
In the plane tensors are 3x3 with third row and column 0, and magnitudes are sqrt(2) times
amplitudes.

Columns of a histogram, one row a class, in space: class, dx dy dz (its middle), area (solid
angle), sides (contacts seen from both bodies), E (their density), fn, ft, zn, zt, length
(class means of force, branch and branch length), fl (of force (x) contact vector), and the
models of order 2 (E2, fn2, ...) and of orders 2 and 4 (E4, ...) there. All sides are twice the
contacts, and E times area adds up to 1.
)";

}  // namespace tangency::dem
