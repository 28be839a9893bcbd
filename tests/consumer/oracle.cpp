// SPDX-License-Identifier: GPL-3.0-or-later
// An oracle and the kernel of the installed package, asked about two spheres that touch.
#include <iostream>

#include <tangency/geometry/relation.hpp>
#include <tangency/verify/oracles/relation.hpp>

int main() {
  const tangency::Ellipsoid a({0, 0, 0}, {1, 1, 1}), b({3, 0, 0}, {2, 2, 2});
  const auto answer = to_string(relation(a, b).relation);
  const auto truth = tangency::verify::name(
      tangency::verify::exact_relation({{0, 0, 0}, {1, 1, 1}}, {{3, 0, 0}, {2, 2, 2}}).relation);
  std::cout << answer << ", " << truth << '\n';
  return answer == truth && truth == "external_touch" ? 0 : 1;
}
