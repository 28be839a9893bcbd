// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include <tangency/geometry/gap.hpp>

double multiply_add(double a, double b, double c);

int main() {
  const tangency::Ellipsoid a({0, 0, 0}, {1, 2, 3}), b({0, 0, 7}, {3, 2, 1});
  const tangency::Gap gap = tangency::signed_gap(a, b);
  std::cout << "gap " << gap.gap << " along " << gap.normal.transpose() << '\n';
  // 1 - u^2 rounded twice is 1 - 1; fused it would leave -2^-60.
  const bool rounds_twice = multiply_add(1 + 0x1p-30, 1 - 0x1p-30, -1) == 0;
  return gap.gap == 3 && rounds_twice ? 0 : 1;
}
