// SPDX-License-Identifier: MIT
/// @file
/// What is measured on an assembly. Looks on and changes nothing.
///
/// Signs, as in scenes, histories and reports: compression is positive in stress and in axial
/// strain, volumetric strain is positive in dilation. The axial direction is z, in the plane y.
/// Strains are logarithmic and count from the cell at the start of the current stage. Only touching
/// pairs are contacts. In the plane stresses, porosity and volumetric strain are those of the unit
/// thickness: of areas.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <tangency/dem/cell.hpp>
#include <tangency/dem/contact/contacts.hpp>
#include <tangency/dem/neighbours.hpp>
#include <tangency/dem/particles.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// Stress of the assembly, (1/V) sum over contacts of force (x) branch vector, made symmetric;
/// compression positive, force/area.
struct Stress {
  Mat3 tensor = Mat3::Zero();  ///< compression > 0
  /// The rise of mean stress per isotropic linear strain if particles only followed the cell,
  /// (1/3V) sum K_n (n . branch)^2, 1/2V in the plane: an upper bound of the true one, and what a
  /// servo needs.
  double affine_stiffness = 0.0;
  int dimensions = 3;  ///< 2 or 3

  /// Mean of the normal components.
  double mean() const { return tensor.trace() / dimensions; }
};
/// Of all contacts, over the volume of the cell.
Stress stress_of(const Contacts& contacts, const Cell& cell);

/// The deviator q: sqrt(3/2 s':s') of the stress less its mean, s1 - s3 in a triaxial test; in the
/// plane (s1 - s2) / 2.
double deviator_of(const Mat3& stress, int dimensions = 3);

/// |s - s'| over the mean stress, of the stress s before it is made symmetric: what moments that
/// are out of balance make of it. 0 without a mean stress.
double asymmetry_of(const Contacts& contacts, const Cell& cell);

/// Stress from the forces through the boundary, compression positive, not symmetric:
/// (1/V) (sum over walls of force (x) place on the wall + sum over contacts that cross a periodic
/// face of force (x) the edges from that face to the opposite one), force of the particle on the
/// wall or of the one before the face on the one behind it. Particles count where they are in the
/// cell.
///
/// (1) With the resultants R of the contacts on particles at x it is the stress of the contacts
///     before it is made symmetric, less (1/V) sum of R (x) x: the same in balance. Places x count
///     from the cell's corner.
Mat3 boundary_stress_of(const Particles& particles, const Cell& cell, const Contacts& contacts,
                        const NeighbourList& list);

/// asin((s1 - s3) / (s1 + s3)) of the principal stresses, in the plane of the two there, in
/// degrees; 0 without stress.
double friction_angle_deg(const Mat3& stress, int dimensions = 3);

/// How far the particles are from equilibrium. A particle is out of balance by the resultant of
/// all forces on it, of its contacts and its weight; ratios are to the mean length of a contact
/// force, 0 where no contact bears a force.
struct Balance {
  double mean_contact_force = 0.0;  ///< mean |force| over the contacts
  /// Mean resultant of the particles that have contacts, over the mean contact force.
  double inertial_fraction = 0.0;
  /// Largest resultant of any particle that has contacts, over the mean contact force.
  double largest_unbalanced_ratio = 0.0;
  /// Largest moment about the centre over the particle's largest semi-axis, alike.
  double largest_unbalanced_moment_ratio = 0.0;
  /// Particles with fewer than two contacts, the fewest that can balance a force [Thornton2000];
  /// under gravity with none, since one can bear a weight.
  std::int64_t rattlers = 0;
  /// Mean number of contacts of the particles that are no rattlers [Thornton2000]; 0 where all are.
  double mechanical_coordination = 0.0;
};
/// @param particles  all of them
/// @param contacts  the contacts
/// @param gravity  acceleration, length/time^2
Balance balance_of(const Particles& particles, const Contacts& contacts,
                   const Vec3& gravity = Vec3::Zero());

/// A step that is stable for the contacts as they are: 2 / sqrt(2 s), s the largest stiffness over
/// inertia of any particle, shifts and turns together. No assembly's frequency is above sqrt(2 s),
/// since a spring stores k |u_b - u_a|^2 / 2 <= k |u_a|^2 + k |u_b|^2; it is reached where
/// neighbours swing the other way, by two equal spheres or a lattice of them. Normals and arms
/// count as fixed. Infinite without contacts.
double critical_time_step(const Particles& particles, const Contacts& contacts,
                          const NeighbourList& list);

/// Where the energy of an assembly came from and went to since the run began, and what is stored at
/// the start. The sum is what it should hold now.
struct EnergyAccount {
  double start = 0.0;     ///< what was stored and moved at the start
  double boundary = 0.0;  ///< work of the straining cell and its walls on the contacts
  double gravity = 0.0;   ///< work of gravity
  double growth = 0.0;    ///< stored by particles that changed their shape
  double branch = 0.0;    ///< gained by contacts that changed branch or curvature (ContactWork)
  double sliding = 0.0;   ///< lost to friction
  double damping = 0.0;   ///< lost to damping
  double viscous = 0.0;   ///< lost to the damped approach of contacts

  /// What should be stored and move now.
  double sum() const {
    return start + boundary + gravity + growth + branch - sliding - damping - viscous;
  }
};

/// One row of a history: everything but cycle, time, stage and its cycle.
struct Observation {
  double axial_strain, volumetric_strain;  ///< of the cell; compression > 0
  Stress stress;                           ///< of the contacts
  double coordination_number;              ///< 2 contacts / particles, rattlers included
  double coordination_std;  ///< standard deviation of a particle's number of contacts
  double porosity;          ///< 1 - (sum of particle volumes) / cell volume
  std::int64_t contacts;    ///< that touch
  double mean_normal_force, mean_overlap;  ///< over the contacts that touch
  Balance balance;                         ///< of forces and moments
  double kinetic_energy;                   ///< half a step ago, when velocities were known
  double elastic_energy;                   ///< stored in the contacts
  double elongation, eccentricity;         ///< a / b and (a - b) / (a + b) of the first type, now
  double packing_density;                  ///< (sum of particle volumes) / cell volume
  double void_ratio;                       ///< porosity / packing_density
  double contact_density;                  ///< 2 contacts / cell volume
  double overlap_fraction;                 ///< mean_overlap / (2 mean of the mean radii)
  /// where energy went
  EnergyAccount account{};
  /// Kinetic and elastic energy now less what the account says: what the time step lost or gained.
  double energy_error = 0.0;
  double asymmetry = 0.0;               ///< asymmetry_of()
  Mat3 boundary_stress = Mat3::Zero();  ///< of a Simulation; else 0
  Vec3 shear_strain = Vec3::Zero();     ///< xy, yz, zx of the cell, of the sign of their stresses
};
/// What a state is like; it changes nothing.
Observation observe(const Particles& particles, const Cell& cell, const Contacts& contacts,
                    const Vec3& gravity = Vec3::Zero());

/// A named value of a history row or of a summary.
struct Field {
  std::string name;                                       ///< of the column
  std::variant<std::int64_t, double, std::string> value;  ///< as it is written
};

/// A row's columns in the order of history.csv.
/// @param cycle  steps since the run began
/// @param time  since the run began
/// @param stage  its name
/// @param seen  the row itself
/// @param stage_cycle  of the current stage: where one stage's rows end and the next one's begin
std::vector<Field> history_fields(std::int64_t cycle, double time, const std::string& stage,
                                  std::int64_t stage_cycle, const Observation& seen);

}  // namespace tangency::inline v0::dem
