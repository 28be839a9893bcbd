// SPDX-License-Identifier: GPL-2.0-or-later
/// @file
/// What computes ask of a pair style that knows its contacts.
#pragma once

#include <force.h>
#include <pair.h>

#include <functional>

#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::lammps {

/// A contact that touches. Signs are those of the simulator: the normal points out of a, the force
/// is that of a on b.
struct SeenContact {
  int a = 0, b = 0;            ///< places in the arrays of atoms of this rank, ghosts included
  Vec3 normal = Vec3::Zero();  ///< unit
  Vec3 branch = Vec3::Zero();  ///< centre of b less centre of a
  Vec3 force = Vec3::Zero();   ///< normal and shear part
};

/// Implemented by pair styles beside LAMMPS_NS::Pair.
class ContactSource {
 public:
  /// Calls `look` with each contact of the last step of which this rank tells: over all ranks each
  /// one once, with newton on and off.
  virtual void for_each_contact(const std::function<void(const SeenContact&)>& look) const = 0;

  /// That of the pair style in use; null where it knows none.
  static const ContactSource* of(const LAMMPS_NS::Force& force) {
    return dynamic_cast<const ContactSource*>(force.pair);
  }

 protected:
  ~ContactSource() = default;  ///< nobody owns one by this base
};

}  // namespace tangency::inline v0::lammps
