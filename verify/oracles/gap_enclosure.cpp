// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/oracles/gap_enclosure.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include <tangency/verify/oracles/cap_bounds.hpp>
#include <tangency/verify/oracles/newton_ascent.hpp>

namespace tangency::inline v0::verify {
namespace {

using ascent::dot;
using cap::Direction;
using cap::Interval;
using cap::Interval3;
using cap::middle;
using cap::Point;

// ---- the pair in intervals

// Contains every number within `error` of v.
Interval around(const Real& v, const Real& error) {
  const Real low = v - error, high = v + error;
  return Interval(mpfr_get_d(low.backend().data(), MPFR_RNDD),
                  mpfr_get_d(high.backend().data(), MPFR_RNDU));
}

// Lengths in units of 2^unit. The rotation is right to 1e-145, d to 1e-149 of itself; the error
// allowed for is greater, but for semi-axes, which are exact, and for d = 0.
Separation<Interval> enclosed(const Separation<Real>& pair, int unit) {
  const Real of_axes("1e-140"), of_d("1e-140");
  Separation<Interval> result;
  const auto enclose = [&](const Shape<Real>& from, Shape<Interval>& to) {
    for (std::size_t k = 0; k < 3; ++k) {
      to.semi_axes[k] = around(ldexp(from.semi_axes[k], -unit), 0);
      for (std::size_t i = 0; i < 3; ++i) to.axes[k][i] = around(from.axes[k][i], of_axes);
    }
  };
  enclose(pair.a, result.a);
  enclose(pair.b, result.b);
  for (std::size_t i = 0; i < 3; ++i) {
    const Real d = ldexp(pair.d[i], -unit);
    result.d[i] = around(d, of_d * abs(d));
  }
  return result;
}

Separation<double> rounded(const Separation<Interval>& pair) {
  Separation<double> result;
  const auto round = [](const Shape<Interval>& from, Shape<double>& to) {
    for (std::size_t k = 0; k < 3; ++k) {
      to.semi_axes[k] = middle(from.semi_axes[k]);
      std::ranges::transform(from.axes[k], to.axes[k].begin(), middle);
    }
  };
  round(pair.a, result.a);
  round(pair.b, result.b);
  std::ranges::transform(pair.d, result.d.begin(), middle);
  return result;
}

// ---- the search

// >= the angle whose half has a sine <= x: asin x <= x + (pi/2 - 1) x^3.
double angle_of_half_chord(const Interval& x) {
  return Interval(2 * x * (Interval(1) + 0.5708 * square(x))).sup();
}

double angle_between(const Interval3& m, const Interval3& n) {
  const Interval3 chord{m[0] - n[0], m[1] - n[1], m[2] - n[2]};
  return angle_of_half_chord(sqrt(cap::squared_norm(chord)) / 2);
}

// The square of centre (u, v) and half-width `half` on a face of the cube [-1, 1]^3.
struct Box {
  int face;
  double u, v, half;
  double upper = 0;

  Direction direction(double du, double dv) const {
    const auto k = static_cast<std::size_t>(face / 2);
    Direction p{};
    p[k] = face % 2 == 0 ? 1 : -1;
    p[(k + 1) % 3] = u + du;
    p[(k + 2) % 3] = v + dv;
    return p;
  }
};

// >= the angle from n, the box's centre, to any normal of the box: a cap of less than a right angle
// is convex, and so holds the box with its corners.
double radius_about(const Interval3& n, const Box& box) {
  double radius = 0;
  for (const double du : {-box.half, box.half}) {
    for (const double dv : {-box.half, box.half}) {
      radius = std::max(radius, angle_between(n, Point::unit(box.direction(du, dv))));
    }
  }
  return radius;
}

struct Patch {
  NormalCap cap;
  Point point;
};

class Search {
 public:
  Search(const Separation<Interval>& pair, const EnclosureLimits& limits)
      : pair_(pair), rounded_(rounded(pair)), limits_(limits), size_(ascent::extent(rounded_)) {}

  GapEnclosure run() {
    start();
    while (!boxes_.empty() && spent_ < limits_.most_boxes) {
      const Box box = boxes_.front();
      if (box.upper < wanted() || upper() - lower_ <= limits_.width || box.half < kLeast) break;
      std::ranges::pop_heap(boxes_, by_upper);
      boxes_.pop_back();
      for (const double du : {-box.half / 2, box.half / 2}) {
        for (const double dv : {-box.half / 2, box.half / 2}) {
          visit({box.face, box.u + du, box.v + dv, box.half / 2});
        }
      }
    }
    return result();
  }

 private:
  // Where centres and corners of boxes are still exact.
  static constexpr double kLeast = 0x1p-48;

  static bool by_upper(const Box& a, const Box& b) { return a.upper < b.upper; }

  // No maximum below is asked for.
  double wanted() const { return Interval(Interval(lower_) - limits_.within).inf(); }

  double upper() const {
    double most = lower_;
    if (!boxes_.empty()) most = std::max(most, boxes_.front().upper);
    for (const Patch& patch : maxima_) most = std::max(most, patch.cap.upper);
    return most;
  }

  void start() {
    for (const Shape<double>* body : {&rounded_.a, &rounded_.b}) {
      for (const Direction& axis : body->axes) climb_both_ways(axis);
    }
    if (dot(rounded_.d, rounded_.d) > 0) climb_both_ways(rounded_.d);
    for (int face = 0; face < 6; ++face) {
      for (const double u : {-0.5, 0.5}) {
        for (const double v : {-0.5, 0.5}) visit({face, u, v, 0.5});
      }
    }
  }

  void climb_both_ways(const Direction& n) {
    climb(n);
    climb({-n[0], -n[1], -n[2]});
  }

  // Newton's way up from n; a maximum that is new, and alone in a cap, is kept.
  void climb(const Direction& n) {
    // Chosen: some roundings; and steps enough for needles.
    constexpr double kTolerance = 0x1p-50;
    constexpr int kMostSteps = 200;
    const Direction top = ascent::ascend(rounded_, n, kTolerance * size_, kMostSteps).at.n;
    const Point point(pair_, top);
    lower_ = std::max(lower_, point.f.inf());
    if (covered(point.n, 0)) return;
    for (double sine = 0.5; sine > 0x1p-40; sine /= 2) {
      if (!(cap::lower_bound(point, sine) + cap::least_radius(pair_, point, sine) > 0)) continue;
      maxima_.push_back({{top, sine, cap::upper_bound(point, sine), true}, point});
      return;
    }
    ++flat_;
  }

  bool covered(const Interval3& n, double radius) const {
    return std::ranges::any_of(maxima_, [&](const Patch& patch) {
      return angle_between(patch.point.n, n) + radius <= patch.cap.radius;
    });
  }

  // Is a maximum near enough for the step of Newton's method to stay in or near the cap?
  static bool promises_a_maximum(const Point& at, double sine) {
    const double kss = middle(at.f + at.a.at.bend_ss + at.b.at.bend_ss);
    const double kst = middle(at.a.at.bend_st + at.b.at.bend_st);
    const double ktt = middle(at.f + at.a.at.bend_tt + at.b.at.bend_tt);
    const double rs = middle(at.rs), rt = middle(at.rt), det = kss * ktt - kst * kst;
    if (!(kss > 0 && det > 0)) return false;
    const double ds = (ktt * rs - kst * rt) / det, dt = (kss * rt - kst * rs) / det;
    return ds * ds + dt * dt < 4 * sine * sine;
  }

  void visit(Box box) {
    ++spent_;
    const Direction centre = box.direction(0, 0);
    const Point point(pair_, centre);
    const double radius = radius_about(point.n, box);  // and >= its sine
    lower_ = std::max(lower_, point.f.inf());
    box.upper = cap::upper_bound(point, radius);
    if (box.upper >= wanted()) {
      box.upper = std::min(box.upper, cap::upper_bound_by_plane(pair_, point, radius));
    }
    if (std::isnan(box.upper)) box.upper = std::numeric_limits<double>::infinity();
    if (box.upper < wanted() || covered(point.n, radius)) return;
    if (limits_.within > 0 && cap::holds_no_maximum(pair_, point, radius)) return;
    // Chosen: where maxima tie along a curve none is alone, and no more are tried.
    constexpr int kMostFlat = 50;
    if (flat_ < kMostFlat && promises_a_maximum(point, radius)) {
      climb(centre);
      if (box.upper < wanted() || covered(point.n, radius)) return;
    }
    boxes_.push_back(box);
    std::ranges::push_heap(boxes_, by_upper);
  }

  GapEnclosure result() const {
    GapEnclosure found{lower_, upper(), {}, true, spent_};
    for (const Patch& patch : maxima_) {
      if (patch.cap.upper >= wanted()) found.caps.push_back(patch.cap);
    }
    for (const Box& box : boxes_) {
      if (box.upper < wanted()) continue;
      const auto n = Point::unit(box.direction(0, 0));
      found.caps.push_back(
          {{middle(n[0]), middle(n[1]), middle(n[2])}, radius_about(n, box), box.upper, false});
      found.isolated = false;
    }
    std::ranges::sort(found.caps, std::ranges::greater{}, &NormalCap::upper);
    return found;
  }

  Separation<Interval> pair_;
  Separation<double> rounded_;
  EnclosureLimits limits_;
  double size_;
  double lower_ = -std::numeric_limits<double>::infinity();
  std::vector<Patch> maxima_;  // each alone in its cap
  std::vector<Box> boxes_;     // a heap
  std::size_t spent_ = 0;
  int flat_ = 0;
};

}  // namespace

GapEnclosure gap_enclosure(const RealEllipsoid& a, const RealEllipsoid& b,
                           const EnclosureLimits& limits) {
  const Separation<Real> pair = separation(a, b);
  int unit = 0;
  frexp(ascent::extent(pair), &unit);
  const Separation<Interval> intervals = enclosed(pair, unit);
  const CGAL::Protect_FPU_rounding<true> rounding_up;
  EnclosureLimits scaled = limits;
  scaled.width = std::ldexp(limits.width, -unit);
  scaled.within = std::ldexp(limits.within, -unit);
  GapEnclosure found = Search(intervals, scaled).run();
  found.lower = -std::ldexp(-found.lower, unit);  // rounded up, as all here
  found.upper = std::ldexp(found.upper, unit);
  for (NormalCap& cap : found.caps) cap.upper = std::ldexp(cap.upper, unit);
  return found;
}

GapEnclosure gap_enclosure(const RawEllipsoid& a, const RawEllipsoid& b,
                           const EnclosureLimits& limits) {
  return gap_enclosure(real(a), real(b), limits);
}

}  // namespace tangency::inline v0::verify
