// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <tangency/verify/oracles/ascent.hpp>
#include <tangency/verify/oracles/gap_enclosure.hpp>

namespace tangency::verify {
namespace {

using ascent::cross;
using ascent::dot;
using ascent::Support;
using Interval = CGAL::Interval_nt<false>;
using Direction = std::array<double, 3>;  // of any length but 0, exact

// ---- the pair in intervals

// Contains every number within `error` of v.
Interval around(const Real& v, const Real& error) {
  const Real low = v - error, high = v + error;
  return Interval(mpfr_get_d(low.backend().data(), MPFR_RNDD),
                  mpfr_get_d(high.backend().data(), MPFR_RNDU));
}

double middle(const Interval& v) { return v.inf() + (v.sup() - v.inf()) / 2; }

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

Interval squared_norm(const std::array<Interval, 3>& v) {
  return square(v[0]) + square(v[1]) + square(v[2]);
}

// ---- f at a normal, and about it

// Sum over body axes k of (a_i a_j)^2 x_k y_k: x' adj(M) y.
Interval adjugate_form(const Shape<Interval>& body, const std::array<Interval, 3>& x,
                       const std::array<Interval, 3>& y) {
  Interval sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Interval face = body.semi_axes[(k + 1) % 3] * body.semi_axes[(k + 2) % 3];
    sum += square(face) * dot(body.axes[k], x) * dot(body.axes[k], y);
  }
  return sum;
}

// One body about a normal.
struct Side {
  Support<Interval> at;
  double reach;     // >= the tangential part of the support point
  Interval growth;  // >= e'Me - h^2 for every tangential unit e, and >= 0

  Side(const Shape<Interval>& body, const std::array<Interval, 3>& n,
       const std::array<Interval, 3>& s, const std::array<Interval, 3>& t)
      : at(ascent::support(body, n, s, t)) {
    const Interval reach2 = square(at.slope_s) + square(at.slope_t);
    reach = sqrt(reach2).sup();
    const Interval most_bend = (at.bend_ss + at.bend_tt) / 2 +
                               sqrt(square((at.bend_ss - at.bend_tt) / 2) + square(at.bend_st));
    growth = std::max(0.0, Interval(at.h * most_bend + reach2 - square(at.h)).sup());
  }

  // <= (h(n) / h)^3 wherever h is taken on the cap of sine `sine`: h^2 = (h cos)^2 + 2 sin cos h
  // x.e
  // + sin^2 e'Me, and e'Me = h e'Hess h e + (x.e)^2.
  double share(double sine) const {
    const Interval hh = square(at.h), s = sine;
    const Interval q = hh / (hh + 2 * s * at.h * reach + square(s) * growth);
    return std::max(0.0, Interval(q * sqrt(q)).inf());
  }
};

// f with bounds of its derivatives at the normal along `direction`.
struct Point {
  std::array<Interval, 3> n, s, t;
  Side a, b;
  Interval f, rs, rt;

  Point(const Separation<Interval>& pair, const Direction& direction)
      : Point(pair, unit(direction), ascent::most_normal_axis(direction)) {}

  static std::array<Interval, 3> unit(const Direction& p) {
    std::array<Interval, 3> n{p[0], p[1], p[2]};
    const Interval norm = sqrt(squared_norm(n));
    for (Interval& v : n) v /= norm;
    return n;
  }

 private:
  Point(const Separation<Interval>& pair, const std::array<Interval, 3>& unit_n, std::size_t k)
      : Point(pair, unit_n, ascent::tangents(unit_n, k)) {}

  Point(const Separation<Interval>& pair, const std::array<Interval, 3>& unit_n,
        const std::array<std::array<Interval, 3>, 2>& basis)
      : n(unit_n),
        s(basis[0]),
        t(basis[1]),
        a(pair.a, n, s, t),
        b(pair.b, n, s, t),
        f(dot(n, pair.d) - a.at.h - b.at.h),
        rs(dot(s, pair.d) - a.at.slope_s - b.at.slope_s),
        rt(dot(t, pair.d) - a.at.slope_t - b.at.slope_t) {}
};

Interval cosine_of(double sine) { return sqrt(Interval(1) - square(Interval(sine))); }

// Greatest of r x - q x^2 / 2 for |x| <= most.
double greatest_of_parabola(const Interval& r, const Interval& q, double most) {
  const Interval slope = std::max(-r.inf(), r.sup()), bend = q.inf(), end = most;
  if (bend.inf() > 0 && slope.sup() < Interval(bend * end).inf()) {
    return Interval(square(slope) / (2 * bend)).sup();
  }
  return Interval(end * (slope - bend * end / 2)).sup();
}

// (1): an upper bound of f on the cap of sine `sine` about the point.
double upper_bound(const Point& at, double sine) {
  const Interval share_a = at.a.share(sine), share_b = at.b.share(sine);
  const double least = at.f.inf();
  // f cos <= f - f X^2 / 2 for f >= 0, f - f X^2 / (1 + cos) for f < 0.
  const Interval lift =
      least < 0 ? Interval(least * 2 / (Interval(1) + cosine_of(sine).inf())).inf() : least;
  const Interval qss = share_a * at.a.at.bend_ss + share_b * at.b.at.bend_ss + lift;
  const Interval qst = share_a * at.a.at.bend_st + share_b * at.b.at.bend_st;
  const Interval qtt = share_a * at.a.at.bend_tt + share_b * at.b.at.bend_tt + lift;
  // In any basis; in that of the axes of q the bound is sharp.
  const double half = (middle(qss) - middle(qtt)) / 2, off = middle(qst);
  const double high = std::sqrt(half * half + off * off) + std::abs(half);
  Interval x = half < 0 ? off : high, y = half < 0 ? high : off;
  if (!(high > 0)) x = 1, y = 0;
  const Interval norm = sqrt(square(x) + square(y));
  x /= norm;
  y /= norm;
  const Interval quu = square(x) * qss + 2 * x * y * qst + square(y) * qtt;
  const Interval qvv = square(y) * qss - 2 * x * y * qst + square(x) * qtt;
  const Interval quv = x * y * (qtt - qss) + (square(x) - square(y)) * qst;
  const double mixed = Interval(square(Interval(sine)) * abs(quv)).sup();
  return at.f.sup() + greatest_of_parabola(x * at.rs + y * at.rt, quu, sine) +
         greatest_of_parabola(x * at.rt - y * at.rs, qvv, sine) + mixed;
}

// Takes a point of the body from v, for (3): the support point of n, but along those long axes
// whose sign may change on the cap whatever leaves least of v.
void take_point_at_crease(const Shape<Interval>& body, const Side& side,
                          const std::array<Interval, 3>& n, double sine,
                          std::array<Interval, 3>& v) {
  const auto take = [&](const Interval& share, std::size_t k) {
    for (std::size_t i = 0; i < 3; ++i) v[i] -= share * body.semi_axes[k] * body.axes[k][i];
  };
  std::array<Interval, 3> along;
  std::array<bool, 3> creased;
  Interval squares = 0, room = 1;  // 1 less the squares of the shares taken
  for (std::size_t k = 0; k < 3; ++k) {
    const Interval cosine = dot(body.axes[k], n);
    along[k] = body.semi_axes[k] * cosine;
    creased[k] = abs(cosine).inf() < sine && body.semi_axes[k].sup() * sine > side.at.h.inf();
    if (!creased[k]) squares += square(along[k]);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (!creased[k]) continue;
    // Chosen: what leaves a tenth for the other axes.
    const double most = std::sqrt(std::max(0.0, room.inf() - 0.01));
    const double best = middle(dot(body.axes[k], v)) / middle(body.semi_axes[k]);
    const Interval share = std::clamp(best, -most, most);
    take(share, k);
    room -= square(share);
  }
  if (!(squares.inf() > 0)) return;
  const Interval per = Interval(sqrt(room).inf()) / sqrt(squares);
  for (std::size_t k = 0; k < 3; ++k) {
    if (!creased[k]) take(along[k] * per, k);
  }
}

// (3): an upper bound of f on the cap of sine `sine` about the point.
double upper_bound_by_plane(const Separation<Interval>& pair, const Point& at, double sine) {
  std::array<Interval, 3> v = pair.d;
  take_point_at_crease(pair.a, at.a, at.n, sine, v);
  take_point_at_crease(pair.b, at.b, at.n, sine, v);
  const double level = dot(at.n, v).sup();
  const Interval slope = sqrt(square(dot(at.s, v)) + square(dot(at.t, v)));
  const Interval flat = level < 0 ? Interval(level) * cosine_of(sine) : Interval(level);
  return Interval(flat + slope * sine).sup();
}

// Least of f on the cap; nothing is claimed (-infinity) where a body's h may be far below n.x. From
// h(n') <= n'.x + sin^2 (h e'Hess h e) / (2 n'.x).
double lower_bound(const Point& at, double sine) {
  const Interval s = sine, cosine = cosine_of(sine);
  Interval least = Interval(at.f.inf()) * (at.f.inf() < 0 ? Interval(1) : cosine) -
                   s * sqrt(square(at.rs) + square(at.rt));
  for (const Side* side : {&at.a, &at.b}) {
    const Interval along = side->at.h * cosine - s * side->reach;
    if (!(along.inf() > 0)) return -std::numeric_limits<double>::infinity();
    least -= square(s) * side->at.h * (side->at.bend_ss + side->at.bend_tt) / (2 * along.inf());
  }
  return least.inf();
}

// A lower bound of R on the cap in every direction. m, normal to a normal of the cap, has |m.c| <=
// sine: for mu >= 0, m'Jm >= cos^2 y'(J_t - w w'/(J_cc + mu))y - mu sine^2, y its tangential
// direction, J_t, w and J_cc the blocks of J.
double least_radius(const Separation<Interval>& pair, const Point& at, double sine) {
  Interval jss = 0, jst = 0, jtt = 0, jns = 0, jnt = 0, jnn = 0;
  const auto add = [&](const Shape<Interval>& body, const Side& side) {
    const Interval share = side.share(sine), per = share / (square(side.at.h) * side.at.h);
    jss += share * side.at.bend_tt;
    jst -= share * side.at.bend_st;
    jtt += share * side.at.bend_ss;
    jns += per * adjugate_form(body, at.n, at.s);
    jnt += per * adjugate_form(body, at.n, at.t);
    jnn += per * adjugate_form(body, at.n, at.n);
  };
  add(pair.a, at.a);
  add(pair.b, at.b);
  const Interval s = sine;
  const double tilt = Interval(sqrt(square(jns) + square(jnt)) / s).sup();
  const Interval mu = std::max(0.0, tilt - jnn.inf());
  const Interval below = jnn + mu;
  const Interval kss = jss - square(jns) / below, ktt = jtt - square(jnt) / below;
  const Interval kst = jst - jns * jnt / below;
  const Interval low = (kss + ktt) / 2 - sqrt(square((kss - ktt) / 2) + square(kst));
  if (!(low.inf() > 0)) return 0;
  return std::max(0.0, Interval(low * (Interval(1) - square(s)) - mu * square(s)).inf());
}

// ---- the search

// >= the angle whose half has a sine <= x: asin x <= x + (pi/2 - 1) x^3.
double angle_of_half_chord(const Interval& x) {
  return Interval(2 * x * (Interval(1) + 0.5708 * square(x))).sup();
}

double angle_between(const std::array<Interval, 3>& m, const std::array<Interval, 3>& n) {
  const std::array<Interval, 3> chord{m[0] - n[0], m[1] - n[1], m[2] - n[2]};
  return angle_of_half_chord(sqrt(squared_norm(chord)) / 2);
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
double radius_about(const std::array<Interval, 3>& n, const Box& box) {
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
      if (box.upper < wanted() || upper() - lower_ <= limits_.width) break;
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
      if (!(lower_bound(point, sine) + least_radius(pair_, point, sine) > 0)) continue;
      maxima_.push_back({{top, sine, upper_bound(point, sine), true}, point});
      return;
    }
    ++flat_;
  }

  bool covered(const std::array<Interval, 3>& n, double radius) const {
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
    box.upper = upper_bound(point, radius);
    if (box.upper >= wanted()) {
      box.upper = std::min(box.upper, upper_bound_by_plane(pair_, point, radius));
    }
    if (box.upper < wanted() || covered(point.n, radius)) return;
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
  const CGAL::Protect_FPU_rounding<true> rounding_up;
  EnclosureLimits scaled = limits;
  scaled.width = std::ldexp(limits.width, -unit);
  scaled.within = std::ldexp(limits.within, -unit);
  GapEnclosure found = Search(enclosed(pair, unit), scaled).run();
  found.lower = -std::ldexp(-found.lower, unit);  // rounded up, as all here
  found.upper = std::ldexp(found.upper, unit);
  for (NormalCap& cap : found.caps) cap.upper = std::ldexp(cap.upper, unit);
  return found;
}

GapEnclosure gap_enclosure(const RawEllipsoid& a, const RawEllipsoid& b,
                           const EnclosureLimits& limits) {
  return gap_enclosure(real(a), real(b), limits);
}

}  // namespace tangency::verify
