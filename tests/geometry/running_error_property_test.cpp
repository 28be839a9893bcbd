// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>

#include <tangency/geometry/numbers/integer_forms.hpp>
#include <tangency/geometry/numbers/running_error.hpp>
#include <tangency/tests/support/generators.hpp>

namespace tangency::detail {
namespace {

using exact::to_rational;

/// A number that is known with an error, and what it truly is.
struct Known {
  Bounded bounded;
  mpq_class truth;
};

bool is_number(const Bounded& b) { return std::isfinite(b.value) && std::isfinite(b.error); }

bool encloses(const Known& k) {
  return abs(mpq_class(to_rational(k.bounded.value) - k.truth)) <= to_rational(k.bounded.error);
}

/// Ordinary numbers, those next to cancelling each other, and both ends of the range of doubles.
Known operand() {
  const double magnitude = *rc::gen::oneOf(tangency::testing::log_uniform(0.5, 2),
                                           tangency::testing::log_uniform(0x1p-540, 0x1p-500),
                                           tangency::testing::log_uniform(0x1p-1074, 0x1p-1000),
                                           tangency::testing::log_uniform(0x1p400, 0x1p1023));
  const double value = *rc::gen::element(1.0, -1.0) * magnitude;
  // The truth anywhere in the error's reach, its ends included.
  const double error = *rc::gen::element(0.0, 0x1p-53, 0x1p-30, 0.25, 1.5) * magnitude;
  const mpq_class part(*rc::gen::inRange(-8, 9), 8);
  return {{value, error}, to_rational(value) + part * to_rational(error)};
}

Known combined(const Known& a, const Known& b) {
  switch (*rc::gen::inRange(0, 5)) {
    case 0:
      return {a.bounded + b.bounded, a.truth + b.truth};
    case 1:
      return {a.bounded - b.bounded, a.truth - b.truth};
    case 2:
      return {a.bounded * b.bounded, a.truth * b.truth};
    case 3:
      return {square(a.bounded), a.truth * a.truth};
    default:
      return {-a.bounded, -a.truth};
  }
}

// geometry/numbers/running_error.hpp (1) (2)
RC_GTEST_PROP(BoundedProperty, ErrorHoldsAfterEveryOperationAndNoSignAfterAnOverflow, ()) {
  Known sum = operand();
  for (int i = 0; i < 6; ++i) {
    sum = combined(sum, i % 2 == 0 ? operand() : sum);
    if (!is_number(sum.bounded)) {
      RC_ASSERT(!sum.bounded.positive() && !sum.bounded.negative());
      RC_SUCCEED("overflow");
    }
    RC_ASSERT(encloses(sum));
    RC_ASSERT(!sum.bounded.positive() || sum.truth > 0);
    RC_ASSERT(!sum.bounded.negative() || sum.truth < 0);
  }
}

}  // namespace
}  // namespace tangency::detail
