// SPDX-License-Identifier: MIT
#include <tangency/geometry/classify_coefficients.hpp>

#include <tangency/geometry/classify_filter.hpp>
#include <tangency/geometry/exact/integer_forms.hpp>
#include <tangency/geometry/exact/quadric_type.hpp>

namespace tangency {

Classification classify_coefficients(const QuadricCoefficients& coefficients) noexcept {
  if (const auto type = filter::regular_type(coefficients)) return {*type, 4, 3, Tier::filter};
  return exact::classify_form(
      exact::quadric_form(coefficients, exact::common_exponent(coefficients)));
}

}  // namespace tangency
