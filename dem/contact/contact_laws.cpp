// SPDX-License-Identifier: MIT
#include <tangency/dem/contact/contact_laws.hpp>

#include <algorithm>

namespace tangency::inline v0::dem {

double ContactLaws::largest_stiffness() const {
  double largest = 0.0;
  for (const ContactLaw& one : law)
    largest = std::max({largest, one.normal_stiffness, one.shear_stiffness});
  return largest;
}

bool ContactLaws::bear_shear() const {
  return std::any_of(law.begin(), law.end(),
                     [](const ContactLaw& one) { return one.bears_shear(); });
}

bool ContactLaws::dissipate() const {
  return std::any_of(law.begin(), law.end(),
                     [](const ContactLaw& one) { return one.dissipates(); });
}

bool ContactLaws::are_hertz() const { return law.front().hertz.has_value(); }

}  // namespace tangency::inline v0::dem
