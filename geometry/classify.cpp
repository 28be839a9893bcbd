// SPDX-License-Identifier: MIT
#include <tangency/geometry/classify.hpp>

#include <tangency/geometry/bodies/classify_coefficients.hpp>

namespace tangency::inline v0 {

Classification classify(const Quadric& quadric) noexcept {
  return detail::classify_coefficients(quadric.coefficients());
}

}  // namespace tangency::inline v0
