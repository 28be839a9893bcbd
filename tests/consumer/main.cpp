// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstring>
#include <iostream>

#include <tangency/geometry/gap.hpp>
#include <tangency/version.hpp>

double multiply_add(double a, double b, double c);

// Status 0 where the library answers and headers and library are of one version; with the word
// `fused` where, besides, the program's own arithmetic is contracted, as its flags say.
int main(int count, char** words) {
  const tangency::Ellipsoid a({0, 0, 0}, {1, 2, 3}), b({0, 0, 7}, {3, 2, 1});
  const tangency::Gap gap = tangency::signed_gap(a, b);
  std::cout << "gap " << gap.gap << " along " << gap.normal.transpose() << ", version "
            << tangency::version() << '\n';
  static_assert(TANGENCY_VERSION_MAJOR == 0 && TANGENCY_VERSION_MINOR == 2);
  const bool one_version = std::strcmp(tangency::version(), TANGENCY_VERSION_STRING) == 0;
  // 1 - u^2 rounded twice is 1 - 1; fused it leaves -2^-60.
  const bool fused = multiply_add(1 + 0x1p-30, 1 - 0x1p-30, -1) == -0x1p-60;
  const bool asked_for = count > 1 && std::strcmp(words[1], "fused") == 0;
  return gap.gap == 3 && one_version && (fused || !asked_for) ? 0 : 1;
}
