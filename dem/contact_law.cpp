// SPDX-License-Identifier: MIT
#include <tangency/dem/contact_law.hpp>

namespace tangency::dem {

NormalResponse ContactLaw::normal_response(double overlap,
                                           const PrincipalCurvatures& relative) const {
  if (!hertz) {
    const double force = normal_stiffness * overlap;
    return {force, normal_stiffness, 0.5 * force * overlap, {shear_stiffness, shear_stiffness}};
  }
  const HertzContact contact = hertz_contact(relative.curvature, overlap, *hertz);
  return {contact.force,
          contact.stiffness,
          contact.energy,
          {contact.shear_stiffness[0], contact.shear_stiffness[1], relative.direction[1]}};
}

}  // namespace tangency::dem
