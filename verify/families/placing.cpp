// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/families/placing.hpp>

#include <cstddef>

#include <tangency/verify/oracles/newton_ascent.hpp>

namespace tangency::inline v0::verify {

Real3 drawn_direction(Draw& draw) {
  for (;;) {
    Real3 n;
    for (Real& v : n) v = draw.real(-1, 1);
    const Real square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    if (square > 1 || square < 0.01) continue;
    const Real length = sqrt(square);
    for (Real& v : n) v /= length;
    return n;
  }
}

Real place_b(EllipsoidPair& pair, const Real3& n, const Real& gap, const Real& share) {
  const Separation<Real> shapes = separation(real(pair.a), real(pair.b));
  const Real3 reach = ascent::combined(ascent::support_point(shapes.a, n), Real(1),
                                       ascent::support_point(shapes.b, n), Real(0), n);
  Real left = -ascent::dot(reach, n);
  for (std::size_t i = 0; i < 3; ++i) {
    const Real from = pair.a.centre[i];
    pair.b.centre[i] = rounded(from + share * reach[i] + gap * n[i]);
    left += (pair.b.centre[i] - from) * n[i];
  }
  return left;
}

}  // namespace tangency::inline v0::verify
