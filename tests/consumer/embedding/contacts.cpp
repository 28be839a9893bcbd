// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/geometry/gap.hpp>

double contact_gap() {
  const tangency::Ellipsoid a({0, 0, 0}, {1, 2, 3}), b({0, 0, 7}, {3, 2, 1});
  return tangency::signed_gap(a, b).gap;
}
