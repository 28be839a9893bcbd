// SPDX-License-Identifier: MIT
/// @file
/// What `tangency-dem micro --help` says.
#pragma once

namespace tangency::inline v0::dem {

inline constexpr const char* kMicroHelp = R"(
Contacts are those between particles: contacts with walls are counted and in no average but the
measured stress, which is that of history.csv; the theory makes the stress of the others alone.
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
  contact_statistics    f_*, pair_*, P2, P4, P2_model, a_axial_r_rot, a1 and chi_* as in micro.csv;
                        standard errors as NAME_error; r_rot, 3x3: of <P2> a^E, what the bodies'
                        axes explain of a^r; r_other, r_other_error: the rest;
    of spheroids        a1_by_area, f_by_area: if contacts were spread evenly over their surfaces;
                        G_off_model, G_off_area: largest distance of the cumulative share of contact
                        sides by length from the model with the measured a1, and from that of areas;
                        correlation_coordination, correlation_orientation_x, _y, _z: of P2 of the
                        angle between contact vector and axis of symmetry with the body's number of
                        contacts, and with the squares of the components of that axis
    in the plane        a_L, a_L_by_arc: 2 <cos 2 beta> of contact vectors in body axes, and if
                        contacts were spread evenly over outlines
In the plane tensors are 3x3 with third row and column 0, and magnitudes are sqrt(2) times
amplitudes.

Columns of micro.csv, which a run with a micro_interval writes: cycle, time, stage, stage_cycle
and axial_strain as in history.csv; empty cells where something is not defined. X stands for r
contact normals, n normal force, t tangential force, z normal and zt tangential branch, len
branch length, E long axes, lambda contact vectors:
  contacts wall_contacts particles rattlers coordination_number
  coordination_without_rattlers coordination_std coordination_skewness
  coordination_excess_kurtosis empty_classes contact_density
                        2 contacts / particles: in history.csv contacts with walls count too;
                        rattlers have fewer than two contacts, walls included, whether there is
                        gravity or not
  f0 z0 mean_branch_length
                        means over orientations
  mean_normal_force     over contacts
  A_X A_error_X a_axial_X
                        magnitude with the sign of X:a^r; the root of the sum of squares of its
                        standard errors; component zz, in the plane yy
  a_cv a_cv_error a1 a1_error
                        contact vectors in body axes: magnitude, component along the body's axis
  b_X b_error_X         magnitudes of order 4
  unexplained2_X unexplained4_X
                        share of the variance of class means that orders 2, and 2 and 4, leave
  asymmetry_t asymmetry_zt vector_normal_angle_mean_deg vector_normal_angle_largest_deg
  stress_asymmetry
  mean_stress s1 s2 s3 a_s, and with _seven, _eight, _fourth, _noshape, _independent
                        mean, principal values, sqrt(3/2) |deviator| / mean (in the plane
                        sin(phi)): measured, and by the theory as in the JSON
  s0 D_n                isotropic part; factor of the mean stress by signed magnitudes
  P_xx P_yy P_zz axial_deg_P commutator_P
                        of the parts P of the stress: diagonals, axes against the measured stress
  share_X axisymmetric_X (r n t z zt rz rf zf) share_shape a_s_axisymmetric
                        what each gives to a_s_seven; by signed magnitudes alone
  a_s_small a_s_coaxial sin(phi) of coaxial tensors in the plane
  axial_deg_X commutator_X axisymmetry_X sign_X joint_X
                        axes and signs against a^r; df is a^n - a^t, dz is a^z - a^zt
  fraction_x fraction_y fraction_z normal_force_x normal_force_y normal_force_z
                        contacts whose normal is mainly along an axis, and their normal force
  f_short f_intermediate f_long pair_ss pair_si pair_sl pair_ii pair_il pair_ll
                        shares of contact sides by the length of the contact vector, of contacts
                        by both; of bodies of one shape, as what follows
  f_short_model f_intermediate_model f_long_model pair_model_ss and the like
                        calculated from a1
  P2 P4 P2_model        <P2>, <P4> of the cosine of normal and axis of symmetry, and calculated
                        from a1; in the plane <cos 2 gamma>
  a_axial_r_rot         of <P2> a^E over sides: what the bodies' axes explain of a^r
  chi_squared chi_degrees chi_p
                        are local normals independent of how bodies lie?
  shear_strain_xy shear_strain_yz shear_strain_zx
                        as in history.csv

Columns of a histogram, one row a class, in space: class, dx dy dz (its middle), area (solid
angle), sides (contacts seen from both bodies), E (their density), fn, ft, zn, zt, length
(class means of force, branch and branch length), fl (of force (x) contact vector), and the
models of order 2 (E2, fn2, ...) and of orders 2 and 4 (E4, ...) there. All sides are twice the
contacts, and E times area adds up to 1.
)";

}  // namespace tangency::inline v0::dem
