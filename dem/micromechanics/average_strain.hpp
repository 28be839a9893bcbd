// SPDX-License-Identifier: MIT
/// @file
/// The average strain of a periodic packing, as a sum over neighbours, and what each mechanism
/// gives to it [Ouadfel1998, section 8.8; KruytRothenburg1996; Bagi1996].
///
/// With the difference D of the velocities, or displacements, of the two centres of each edge of a
/// net (strain_mesh.hpp)
///
///     gradient = (1/V) sum D (x) area (8.11, 8.12)
///
/// is exactly the velocity gradient of the cell, G_ij = dv_i/dx_j, whatever the centres do.
/// Extension is positive, as in dem::Cell::rate; its symmetric part is the strain. Of displacements
/// from one state to another it is F - I, F the deformation of the cell since the state of the net.
///
/// Errors: arrays of wrong lengths are std::invalid_argument. Functions keep nothing: any number of
/// threads may call them. Formulas: docs/derivations/micromechanics.md.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <tangency/dem/micromechanics/strain_mesh.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::micromechanics {

/// The sum above.
/// @param mesh  the net
/// @param difference  of the image of l less that of k, one an edge of the net
///
/// (1) equals the gradient of the cell, whatever the centres do, and changes of images with it
/// (2) a motion of one centre and all its images alone adds nothing
Mat3 gradient_of(const StrainMesh& mesh, std::span<const Vec3> difference);

/// Differences of velocities: those of the fluctuation, which all images of a particle share, and
/// rate . branch.
/// @param mesh  the net
/// @param rate  velocity gradient of the cell
/// @param velocity  of each particle, in addition to the motion of the cell, as dem::Particles has
std::vector<Vec3> velocity_differences(const StrainMesh& mesh, std::span<const Vec3> velocity,
                                       const Mat3& rate);

/// Differences of displacements, from the centres of the net to later ones: the branch between the
/// same two images then, less that now. Centres must have been followed: of one that was put back
/// into its cell in between the image is another.
std::vector<Vec3> displacement_differences(const StrainMesh& mesh, const PeriodicCentres& later);

/// Contacts and their motion: of each contact the vectors of contact_arrays.hpp, and of each
/// particle velocities. Views of arrays that the caller keeps.
struct ContactMotion {
  PeriodicPairs contacts;        ///< pairs in contact
  std::span<const Vec3> normal;  ///< unit, from the first body to the second
  std::span<const Vec3> arm;     ///< contact point less centre of the first
  /// How fast the second slides over the first: the part of the tangential velocity that no spring
  /// takes up (sliding_velocity). Empty: nothing slides.
  std::span<const Vec3> sliding{};
  std::span<const Vec3> velocity;  ///< of each particle, in addition to the motion of the cell
  std::span<const Vec3> spin;      ///< of each particle, 1/time
  Mat3 rate = Mat3::Zero();        ///< velocity gradient of the cell
};

/// Of a contact whose spring is at its limit, what the limit makes it slide: with the shear force f
/// of the first on the second, s = f/|f|, and limit' the rate at which the limit grows,
///
///     s (v . s + limit'/stiffness)   where -stiffness v . s > limit', else 0
///
/// as a spring that is cut back to its limit does (dem/contact/contact_law.hpp).
/// @param shear_force  f, of the first on the second
/// @param limit_rate  limit', force per time
/// @param tangential  velocity of the second relative to the first at the contact, in its plane
/// @param stiffness   of the shear spring; 0: there is none, and all of the velocity is sliding
Vec3 sliding_velocity(const Vec3& tangential, const Vec3& shear_force, double stiffness,
                      double limit_rate);

/// Relative velocity of the bodies of each contact at the contact point, that of the second less
/// that of the first, spins included (eq. 8.14).
std::vector<Vec3> contact_velocities(const ContactMotion& motion, const PeriodicCentres& centres);

/// What the velocity gradient is made of. A difference of centres at a contact, whose velocity is
/// v, whose arms are l_a and l_b and whose spins are w_a and w_b, is
///
///     D = (v . n) n + elastic + sliding + (w_a x l_a - w_b x l_b)
///
/// and that of an edge without contact stands alone.
///
/// (3) the parts add up to the gradient of the cell
/// (4) turned about with it as one body, a packing has rotation alone in its contacts
struct StrainParts {
  Mat3 normal = Mat3::Zero();         ///< contacts become shorter or longer
  Mat3 elastic = Mat3::Zero();        ///< shear springs are stretched
  Mat3 sliding = Mat3::Zero();        ///< contacts slide
  Mat3 rotation = Mat3::Zero();       ///< particles turn
  Mat3 apart = Mat3::Zero();          ///< edges without contact; 0 of polygons
  std::size_t edges_in_contact = 0;   ///< edges of the net whose bodies touch
  std::size_t contacts_left_out = 0;  ///< contacts that are no edge of the net

  /// The whole average velocity gradient.
  Mat3 sum() const { return normal + elastic + sliding + rotation + apart; }
  /// What stands as (8.13) and (8.14): the sum over contacts of relative velocities at the contact,
  /// spins included. Not the strain of the cell: these do not add up to 0 around a polygon.
  Mat3 published() const { return normal + elastic + sliding; }
};
/// @overload
StrainParts strain_parts(const StrainMesh& mesh, const PeriodicCentres& centres,
                         const ContactMotion& motion);

/// The gradient F - I by what became of the edges.
///
/// (5) the parts add up to it
struct StrainOfEdges {
  /// The share of some edges of the net.
  struct Part {
    Mat3 gradient = Mat3::Zero();  ///< displacement gradient of these edges
    std::size_t edges = 0;         ///< how many they are
  };
  Part kept;    ///< in contact at the net's state and later
  Part lost;    ///< at the net's state alone
  Part gained;  ///< later alone; none of polygons, whose edges are contacts
  Part apart;   ///< at neither

  /// The whole average displacement gradient.
  Mat3 sum() const { return kept.gradient + lost.gradient + gained.gradient + apart.gradient; }
};
/// @param mesh  the net
/// @param difference  one an edge, displacement_differences
/// @param before,later  contacts at the state of the net and at the later one
StrainOfEdges strain_of_edges(const StrainMesh& mesh, std::span<const Vec3> difference,
                              const PeriodicPairs& before, const PeriodicPairs& later);

}  // namespace tangency::inline v0::micromechanics
