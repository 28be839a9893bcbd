// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/sliding.hpp>

#include <cassert>
#include <cstddef>
#include <cstdint>

#include <tangency/dem/contact/contact_law.hpp>
#include <tangency/dem/micromechanics/average_strain.hpp>

namespace tangency::inline v0::dem {
namespace {

/// d(c + F_n tan(phi))/dt.
double limit_rate(const ContactLaw& law, double normal_stiffness, double opening) {
  return -law.friction_coefficient * normal_stiffness * opening;
}

/// At which the shear force shrinks with its stiffness, which goes by the root of the overlap: of
/// Hertz contacts that open.
double shrinkage(const ContactLaw& law, double shear_force, double overlap, double opening) {
  return law.hertz && opening > 0.0 ? shear_force * opening / (2.0 * overlap) : 0.0;
}

}  // namespace

std::vector<Vec3> sliding_of(const Packing& packing, const ContactLaws& laws,
                             std::span<const Vec3> velocity) {
  const PackingContacts& contacts = packing.contacts;
  assert(velocity.size() == contacts.size());
  const auto type = [&](std::int64_t id) {
    return static_cast<std::size_t>(packing.particles.type[static_cast<std::size_t>(id)]);
  };
  std::vector<Vec3> sliding(contacts.size(), Vec3::Zero());
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const double stiffness = contacts.shear_stiffness[c];
    if (stiffness > 0.0 && contacts.sliding[c] == 0) continue;
    const auto& [a, b] = contacts.bodies[c];
    const Vec3& normal = contacts.normal[c];
    const double opening = normal.dot(velocity[c]);
    const Vec3 tangential = velocity[c] - opening * normal;
    const Vec3 shear = contacts.force[c] - contacts.normal_force[c] * normal;
    const ContactLaw& law = laws.between(type(a), type(b));
    // What shrinks by itself need not be cut back.
    const double rate = limit_rate(law, contacts.normal_stiffness[c], opening) +
                        shrinkage(law, shear.norm(), -contacts.gap[c], opening);
    sliding[c] = micromechanics::sliding_velocity(tangential, shear, stiffness, rate);
  }
  return sliding;
}

}  // namespace tangency::inline v0::dem
