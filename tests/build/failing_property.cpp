// SPDX-License-Identifier: GPL-3.0-or-later
// A property that fails, for replay.sh.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <tangency/tests/support/generators.hpp>

namespace tangency {
namespace {

RC_GTEST_PROP(FailingProperty, IsFalseForOneBodyInTen, ()) {
  const Ellipsoid e = *testing::ellipsoid(1000);
  RC_ASSERT(e.largest_semi_axis() < 10 * e.smallest_semi_axis() || e.centre().x() < 1);
}

}  // namespace
}  // namespace tangency
