// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What is proven about f(n) = n.d - h_A(n) - h_B(n) on a cap of the sphere of normals, in outward
/// rounded doubles. Inner header of the gap oracles.
///
/// Every function here requires the rounding mode that CGAL::Protect_FPU_rounding sets, lengths
/// that are moderate numbers (about 1 at the most), and caps of less than a right angle. The
/// equations' numbers are those of gap_enclosure.hpp. `sine` is at least the sine of the cap's
/// angle.
#pragma once

#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include <tangency/verify/oracles/newton_ascent.hpp>

namespace tangency::inline v0::verify::cap {

using Interval = CGAL::Interval_nt<false>;
using Interval3 = std::array<Interval, 3>;
using Direction = std::array<double, 3>;  ///< of any length but 0, exact

inline double middle(const Interval& v) { return v.inf() + (v.sup() - v.inf()) / 2; }

inline Interval squared_norm(const Interval3& v) {
  return square(v[0]) + square(v[1]) + square(v[2]);
}

/// One body about a normal.
struct Side {
  ascent::Support<Interval> at;
  double reach;     ///< >= the tangential part of the support point
  Interval growth;  ///< >= e'Me - h^2 for every tangential unit e, and >= 0

  Side(const Shape<Interval>& body, const Interval3& n, const Interval3& s, const Interval3& t)
      : at(ascent::support(body, n, s, t)) {
    const Interval reach2 = square(at.slope_s) + square(at.slope_t);
    reach = sqrt(reach2).sup();
    const Interval most_bend = (at.bend_ss + at.bend_tt) / 2 +
                               sqrt(square((at.bend_ss - at.bend_tt) / 2) + square(at.bend_st));
    growth = std::max(0.0, Interval(at.h * most_bend + reach2 - square(at.h)).sup());
  }

  /// <= (h(n) / h)^3 wherever h is taken on the cap of sine `sine`:
  /// h^2 = (h cos)^2 + 2 sin cos h x.e + sin^2 e'Me, and e'Me = h e'Hess h e + (x.e)^2.
  double share(double sine) const {
    const Interval hh = square(at.h), s = sine;
    const Interval q = hh / (hh + 2 * s * at.h * reach + square(s) * growth);
    return std::max(0.0, Interval(q * sqrt(q)).inf());
  }
};

/// f with bounds of its derivatives at the normal along `direction`.
struct Point {
  Interval3 n, s, t;
  Side a, b;
  Interval f, rs, rt;

  Point(const Separation<Interval>& pair, const Direction& direction)
      : Point(pair, unit(direction), ascent::most_normal_axis(direction)) {}

  static Interval3 unit(const Direction& p) {
    Interval3 n{p[0], p[1], p[2]};
    const Interval norm = sqrt(squared_norm(n));
    for (Interval& v : n) v /= norm;
    return n;
  }

 private:
  Point(const Separation<Interval>& pair, const Interval3& unit_n, std::size_t k)
      : Point(pair, unit_n, ascent::tangents(unit_n, k)) {}

  Point(const Separation<Interval>& pair, const Interval3& unit_n,
        const std::array<Interval3, 2>& basis)
      : n(unit_n),
        s(basis[0]),
        t(basis[1]),
        a(pair.a, n, s, t),
        b(pair.b, n, s, t),
        f(ascent::dot(n, pair.d) - a.at.h - b.at.h),
        rs(ascent::dot(s, pair.d) - a.at.slope_s - b.at.slope_s),
        rt(ascent::dot(t, pair.d) - a.at.slope_t - b.at.slope_t) {}
};

/// (1): an upper bound of f on the cap about the point.
double upper_bound(const Point& at, double sine);

/// (3): another.
double upper_bound_by_plane(const Separation<Interval>& pair, const Point& at, double sine);

/// A lower bound of f on the cap; -infinity where a body's h may be far below n.x.
double lower_bound(const Point& at, double sine);

/// A lower bound, at least 0, of R on the cap in every direction.
double least_radius(const Separation<Interval>& pair, const Point& at, double sine);

/// (4): f has proven to have no maximum on the cap, whose angle is at most `angle`.
bool holds_no_maximum(const Separation<Interval>& pair, const Point& at, double angle);

}  // namespace tangency::inline v0::verify::cap
