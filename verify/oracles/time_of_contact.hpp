// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Oracle: when two moving ellipsoids first touch, by interval arithmetic over time.
///
/// [0, horizon] is cut in halves, from the left, until each part is one of these, each proven with
/// intervals that are rounded outwards:
///
///  (1) apart throughout: for one fixed direction n, f(t) = n.d(t) - h_A(n, t) - h_B(n, t) > 0 on
///      the part, by the mean-value form f(m) + f'(part) (part - m);
///  (2) in contact at its middle m: one point has levels < 1 of both bodies at m.
///
/// Directions and points are guessed in plain floating point from the Perram-Wertheim form; a guess
/// that fails proves nothing and costs only time.
#pragma once

#include <array>

#include <tangency/verify/oracles/plain_bodies.hpp>

namespace tangency::inline v0::verify {

/// With E(t) = exp(t [w]x): centre(t) = centre + t v + (E(t) - 1) r and R(t) = E(t) R(0); radians.
struct RawMotion {
  std::array<double, 3> velocity{}, angular_velocity{}, pivot_arm{};
};

struct MovingBody {
  RawEllipsoid body;  ///< at t = 0
  RawMotion motion;
};

/// The first contact of the closed solids lies in [from, to], or there is none.
struct FirstContact {
  enum class Status {
    none,       ///< apart throughout [0, horizon]
    contact,    ///< apart before `from`, proven contact at `to`
    undecided,  ///< apart before `from`; then a part as short as the resolution that is neither,
                ///< and no contact is known: `to` is the horizon
  };
  Status status;
  double from, to;
};

/// Parts are not cut shorter than `resolution`. The enclosure of a contact is no longer than that
/// but where intervals of double arithmetic cannot tell: it is proven, however long it is.
FirstContact first_contact(const MovingBody& a, const MovingBody& b, double horizon,
                           double resolution);

}  // namespace tangency::inline v0::verify
