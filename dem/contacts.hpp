// SPDX-License-Identifier: MIT
/// @file
/// The contacts of an assembly: one record a listed pair. The one place that asks geometry.
///
/// A pair touches where its overlap, minus the signed gap, is > 0. The contact point is the
/// midpoint of the two witness points. A plane scene asks for ellipses. Results do not depend on
/// the number of threads: each pair writes its own record and each particle adds its own pairs in
/// the order of the list.
#pragma once

#include <stdexcept>
#include <tangency/dem/contact_law.hpp>
#include <tangency/dem/neighbours.hpp>
#include <tangency/geometry/ellipse.hpp>
#include <vector>

namespace tangency::dem {

/// One listed pair (a, image of b) at the current positions.
struct Contact {
  Vec3 normal = Vec3::Zero();  ///< unit, from a to b; of a pair apart: as last known; 0: not known
  Vec3 branch = Vec3::Zero();  ///< c_b - c_a
  Vec3 arm = Vec3::Zero();     ///< contact point - c_a; of touching pairs only
  Vec3 force = Vec3::Zero();   ///< of a on b; 0 for pairs apart
  Vec3 shear = Vec3::Zero();   ///< the part of it in the tangent plane; stays 0 without friction
  double overlap = 0.0;        ///< length; > 0 where the pair touches, else 0
  double normal_force = 0.0;
  double normal_stiffness = 0.0;  ///< of the pair's law; of touching pairs only

  bool touches() const { return overlap > 0.0; }
};

/// Laws by the types of the two particles, symmetric; types x types, row by row.
struct ContactLaws {
  std::size_t types = 0;
  std::vector<ContactLaw> law;

  const ContactLaw& between(std::int32_t a, std::int32_t b) const {
    return law[static_cast<std::size_t>(a) * types + static_cast<std::size_t>(b)];
  }
  /// The largest stiffness of any law, normal or shear.
  double largest_stiffness() const;
};

class Contacts {
 public:
  /// Brings every record to the current positions and velocities and renews the resultants.
  /// @param dt  time since the last update: the shear displacement is velocity times dt
  void update(const Particles& particles, const Cell& cell, const NeighbourList& list,
              const ContactLaws& laws, double dt);

  /// Keeps the records of pairs that are in both lists.
  void carry_over(const std::vector<Pair>& before, const std::vector<Pair>& now);

  /// Adds the saved records' forces up again: after a restore.
  void restore(std::vector<Contact> records, const Particles& particles, const NeighbourList& list);

  const std::vector<Contact>& records() const { return records_; }
  const Resultants& resultants() const { return resultants_; }

 private:
  template <class Body>
  void update_with(std::vector<Body>& bodies, const Particles& particles, const Cell& cell,
                   const NeighbourList& list, const ContactLaws& laws, double dt);
  void add_up(const NeighbourList& list, std::size_t particles);

  std::vector<Contact> records_;
  // Shapes and orientations; one of the two is used.
  std::vector<Ellipsoid> ellipsoids_;
  std::vector<Ellipse> ellipses_;
  Resultants resultants_;
};

}  // namespace tangency::dem
