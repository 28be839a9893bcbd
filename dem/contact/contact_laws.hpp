// SPDX-License-Identifier: MIT
/// @file
/// The laws of the contacts of an assembly.
#pragma once

#include <cstddef>
#include <vector>

#include <tangency/dem/contact/contact_law.hpp>

namespace tangency::inline v0::dem {

/// Laws by the types of the two particles, symmetric; types x types, row by row. In a walled cell
/// the walls are the last type.
struct ContactLaws {
  std::size_t types = 0;        ///< number of particle types
  std::vector<ContactLaw> law;  ///< types x types, row by row
  /// Does an impulse turn a body? Else its turns have no share in how a contact is damped.
  bool bodies_turn = true;

  /// The law between types a and b.
  const ContactLaw& between(std::size_t a, std::size_t b) const { return law[a * types + b]; }
  /// The largest stiffness of any law, normal or shear.
  double largest_stiffness() const;
  bool bear_shear() const;  ///< does any?
  bool dissipate() const;   ///< does the approach of any lose energy?
  bool are_hertz() const;   ///< then all are
};

}  // namespace tangency::inline v0::dem
