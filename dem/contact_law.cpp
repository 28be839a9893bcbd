// SPDX-License-Identifier: MIT
#include <tangency/dem/contact_law.hpp>

namespace tangency::inline v0::dem {

NormalResponse ContactLaw::hertz_response(double overlap,
                                          const PrincipalCurvatures& relative) const {
  const HertzContact contact = hertz_contact(relative.curvature, overlap, *hertz);
  return {contact.force,
          contact.stiffness,
          contact.energy,
          {contact.shear_stiffness[0], contact.shear_stiffness[1], relative.direction[1]}};
}

}  // namespace tangency::inline v0::dem
