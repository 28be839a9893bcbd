// SPDX-License-Identifier: MIT
#include <tangency/geometry/bodies/double_double_body.hpp>

#include <cstddef>

namespace tangency::inline v0::detail {

DoubleDoubleSide::DoubleDoubleSide(const Ellipsoid& body, const DoubleDoubleVector& normal) noexcept
    : rotation(double_double_rotation(body.orientation())),
      semi_axes(&body.semi_axes()),
      stretched(turned_back(rotation, normal)) {
  for (std::size_t k = 0; k < 3; ++k) stretched[k] = axis(k) * stretched[k];
  support = sqrt(dot(stretched, stretched));
}

DoubleDoubleVector DoubleDoubleSide::support_point() const noexcept {
  DoubleDoubleVector body;
  for (std::size_t k = 0; k < 3; ++k) body[k] = axis(k) * stretched[k] / support;
  return turned(rotation, body);
}

}  // namespace tangency::inline v0::detail
