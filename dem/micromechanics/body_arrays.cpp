// SPDX-License-Identifier: MIT
#include <tangency/dem/micromechanics/body_arrays.hpp>

#include <cstddef>
#include <stdexcept>
#include <string>

namespace tangency::micromechanics {

void require_sound(const ContactArrays& contacts, const BodyArrays& bodies) {
  require_sound(contacts);
  const auto particles = static_cast<std::size_t>(contacts.particles);
  const auto require = [&](const char* name, std::size_t length, std::size_t wanted) {
    if (length != wanted)
      throw std::invalid_argument(std::string(name) + ": " + std::to_string(length) +
                                  " entries: must be " + std::to_string(wanted));
  };
  require("orientation", bodies.orientation.size(), particles);
  require("semi_axes", bodies.semi_axes.size(), particles);
  require("bodies", contacts.bodies.size(), contacts.size());
  require("arm", contacts.arm.size(), contacts.size());
}

}  // namespace tangency::micromechanics
