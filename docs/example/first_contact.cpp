// SPDX-License-Identifier: MIT
#include <iostream>

#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/relation.hpp>

int main() {
  const tangency::Ellipsoid a({0, 0, 0}, {1, 2, 3});                      // centre, semi-axes
  const tangency::Ellipsoid b({0, 0, 4.5}, {3, 2, 1}, {0.9, 0.1, 0, 0});  // and orientation
  std::cout << to_string(relation(a, b).relation) << '\n';                // exact
  const tangency::Gap gap = signed_gap(a, b);                             // < 0: penetration depth
  std::cout << gap.gap << " +- " << gap.gap_error                         // proven
            << " along " << gap.normal.transpose() << '\n';               // normal from a to b
}
