// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <tangency/geometry/gap/chart_bound.hpp>
#include <tangency/geometry/numbers/double_double.hpp>
#include <tangency/geometry/plane/plane_gap.hpp>

namespace tangency::inline v0::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Of L: what a value, and of L + a^2/h what a slope, in double-double may be off (derivation).
constexpr double kNoise = 0x1p-92;
constexpr double kSlack = 1.0 + 0x1p-20;  // covers what bounds in double round
constexpr double kTie = 0x1p-80;          // of L: chosen; answers no further apart are one
constexpr double kFine = 0x1p-60;       // of L: chosen; an arc with no more above the best is done
constexpr double kCoarse = 0x1p-52;     // of L: what a search that is slow settles for
constexpr int kFineBudget = 400;        // arcs; chosen: above what kPlaneBudget says of extremes
constexpr double kShortest = 0x1p-200;  // of L; far below the noise
constexpr int kDeepest = 256;           // halvings
constexpr double kBendError = 0x1p-48;  // of the terms of a difference of radii of curvature

struct Body {
  DoubleDouble2 axis;
  double a1, a2;

  explicit Body(const Ellipse& e) noexcept
      : axis(double_double_direction(e.direction())), a1(e.semi_axes()[0]), a2(e.semi_axes()[1]) {}
  double least() const noexcept { return std::min(a1, a2); }
  double spread() const noexcept { return std::abs(a1 - a2); }
};

struct Side {
  DoubleDouble h;
  DoubleDouble2 point;
  double radius;  ///< of curvature
  double slope;   ///< |h'|
};

Side side(const Body& body, const DoubleDouble2& n) noexcept {
  const DoubleDouble2 t = turned_back(body.axis, n);
  const DoubleDouble2 y{DoubleDouble(body.a1) * t.x, DoubleDouble(body.a2) * t.y};
  const DoubleDouble h = length(y);
  const DoubleDouble2 local{DoubleDouble(body.a1) * (y.x / h), DoubleDouble(body.a2) * (y.y / h)};
  const double ratio = body.a1 * (body.a2 / h.high);
  const double slope = std::abs(cross(t, local).high);
  return {h, turned(body.axis, local), ratio * ratio / h.high, slope};
}

/// f and what bounds it near a unit normal.
struct Sample {
  DoubleDouble2 n;
  DoubleDouble2 rest;  ///< d - x_A -+ x_B: the gradient of f's homogeneous extension
  DoubleDouble f, r;   ///< value and slope
  double curvature;    ///< -f''
  double bend_error;   ///< of it, beside kSlack
  Side a, b;
};

class Circle {
 public:
  explicit Circle(const PlanePair& pair) noexcept
      : a_(pair.a),
        b_(pair.b),
        d_(exactly(pair.d) + exactly(pair.d_low)),
        size_(pair.size),
        rho_(pair.least_radius()),
        nested_(pair.sought == Sought::clearance) {}

  double size() const noexcept { return size_; }
  const DoubleDouble2& d() const noexcept { return d_; }

  Sample at(const DoubleDouble2& n) const noexcept {
    Sample s;
    s.n = n;
    s.a = side(a_, n);
    s.b = side(b_, n);
    const DoubleDouble2 beyond_a = d_ - s.a.point;
    s.rest = nested_ ? beyond_a + s.b.point : beyond_a - s.b.point;
    s.f = dot(n, s.rest);
    s.r = cross(n, s.rest);
    s.curvature = s.f.high + s.a.radius + (nested_ ? -s.b.radius : s.b.radius);
    s.bend_error = kBendError * (nested_ ? size_ + s.a.radius + s.b.radius : size_);
    return s;
  }

  /// The maximum that the ascent leads to.
  Sample climb(const DoubleDouble2& start) const noexcept;
  /// What may lie above the value there, on its own branch or everywhere.
  PlaneProof proof(const Sample& at) const noexcept;
  /// The most that f exceeds `best` by on the arc between two normals less than a quarter apart;
  /// c is between them.
  double excess(const Sample& low, const Sample& c, const Sample& high,
                const Sample& best) const noexcept;

 private:
  double slope_error(const Sample& s) const noexcept {
    const auto radius = [](const Body& body, const Side& side) {
      const double largest = std::max(body.a1, body.a2);
      return largest * (largest / side.h.high);
    };
    return kNoise * (size_ + radius(a_, s.a) + radius(b_, s.b));
  }
  double third_derivative(const Sample& c, double reach) const noexcept;
  /// excess() of a clearance.
  double nested_excess(const DoubleDouble2& low, const DoubleDouble2& c, const DoubleDouble2& high,
                       const DoubleDouble& best) const noexcept;

  Body a_, b_;
  DoubleDouble2 d_;
  double size_, rho_;
  bool nested_;
};

DoubleDouble2 turned_by(const DoubleDouble2& n, double turn) noexcept {
  return normalised(n + DoubleDouble(turn) * quarter(n));
}

Sample Circle::climb(const DoubleDouble2& start) const noexcept {
  Sample here = at(start);
  if (here.r.high == 0.0 && here.curvature >= 0.0) return here;
  // Walk uphill with growing steps until the slope changes its sign, then close in.
  const double way = here.r.high < 0.0 ? -1.0 : 1.0;
  double stride =
      here.curvature > 0.0 ? std::min(0.5, 1.5 * std::abs(here.r.high) / here.curvature) : 0.125;
  Sample there = here;
  for (int step = 0; step < 1200; ++step, stride = std::min(0.5, 2.0 * stride)) {
    there = at(turned_by(here.n, way * std::max(stride, 0x1p-100)));
    if (way * there.r.high <= 0.0) break;
    here = there;
  }
  for (int step = 0; step < 600; ++step) {
    const Sample& nearer = std::abs(here.r.high) < std::abs(there.r.high) ? here : there;
    const double width = std::abs(cross(here.n, there.n).high);
    if (nearer.r.high == 0.0 || width < 0x1p-101) break;
    const double turn = nearer.curvature > 0.0 ? nearer.r.high / nearer.curvature : kInfinity;
    // Inside the bracket and not at its far end? Every third step halves.
    const double side_turn = &nearer == &here ? way * turn : -way * turn;
    const bool newton = step % 3 != 2 && side_turn > 0.0 && side_turn < 0.75 * width;
    const Sample next = at(newton ? turned_by(nearer.n, turn) : normalised(here.n + there.n));
    const bool settled = newton && std::abs(turn) < 0x1p-50;
    (way * next.r.high > 0.0 ? here : there) = next;
    if (settled) break;
  }
  return std::abs(here.r.high) < std::abs(there.r.high) ? here : there;
}

PlaneProof Circle::proof(const Sample& s) const noexcept {
  const double value_error = kNoise * size_ + kUnitRoundoff * std::abs(s.f.high);
  const double reach = (std::abs(s.r.high) + slope_error(s)) * kSlack;
  const Vec2 point_b = rounded(s.b.point);
  PlaneProof proof{s.f.high,
                   s.f.high - value_error,
                   kInfinity,
                   false,
                   rounded(s.n),
                   rounded(s.a.point),
                   nested_ ? point_b : Vec2(-point_b)};
  // The rolling ball: sqrt(x^2 + y^2) - x is at most y, and y^2 / (2x).
  const double ball = proof.low + rho_ * (1.0 - 4.0 * kUnitRoundoff);
  if (ball > 0.0) {
    proof.global = true;
    proof.high = s.f.high + value_error + std::min(reach, reach * reach / ball);
    return proof;
  }
  // The branch alone: while the slope's own slope stays above half of what it is at n.
  const double curvature = nested_ ? s.curvature - s.bend_error : s.curvature;
  const double width = 4.0 * reach / curvature;
  if (curvature > 0.0 && third_derivative(s, width) * width <= 0.5 * curvature) {
    proof.high = s.f.high + value_error + reach * reach / curvature;
  }
  return proof;
}

/// A bound of |f'''| within `reach` of c:  f''' = -t.d + sum of h' (1 + 3 (a1 a2)^2 / h^4).
double Circle::third_derivative(const Sample& c, double reach) const noexcept {
  const auto body = [&](const Body& e, const Side& s) {
    const double fallen = s.h.high - reach * s.slope - 0.5 * reach * reach * s.h.high;
    const double h = std::max(fallen, e.least());
    const double ratio = (e.a1 / h) * (e.a2 / h);
    return e.spread() * (1.0 + 3.0 * ratio * ratio);
  };
  const double d = std::hypot(d_.x.high, d_.y.high);
  return kSlack * (d + body(a_, c.a) + body(b_, c.b));
}

/// The angle between unit vectors less than a quarter apart, from above.
double angle(const DoubleDouble2& from, const DoubleDouble2& to) noexcept {
  const double chord = length(to - from).high;
  return kSlack * chord * (1.0 + chord * chord / 12.0);
}

/// The most that n.w exceeds `best` by on the arc from `low` to `high`.
double linear_excess(const DoubleDouble2& w, const DoubleDouble2& low, const DoubleDouble2& high,
                     const DoubleDouble& best) noexcept {
  if (cross(low, w).high > 0.0 && cross(w, high).high > 0.0) return (length(w) - best).high;
  return std::max((dot(low, w) - best).high, (dot(high, w) - best).high);
}

/// f is below both n.w_low and n.w_high: where these are equal, if that is on the arc, is the most
/// that the lower one reaches.
double corner_excess(const Sample& low, const Sample& high, const DoubleDouble& best) noexcept {
  const double least = std::min(linear_excess(low.rest, low.n, high.n, best),
                                linear_excess(high.rest, low.n, high.n, best));
  const DoubleDouble2 change = low.rest - high.rest;
  if (length(change).high == 0.0) return least;
  DoubleDouble2 m = normalised(quarter(change));
  if (dot(m, low.n + high.n).high < 0.0) m = -m;
  if (cross(low.n, m).high <= 0.0 || cross(m, high.n).high <= 0.0) return least;
  return std::min(least, std::max(linear_excess(low.rest, low.n, m, best),
                                  linear_excess(high.rest, m, high.n, best)));
}

double Circle::nested_excess(const DoubleDouble2& low, const DoubleDouble2& c,
                             const DoubleDouble2& high, const DoubleDouble& best) const noexcept {
  const auto stretch = [](const Body& body) {
    return [&body](const DoubleDouble2& v) {
      const DoubleDouble2 t = turned_back(body.axis, v);
      return DoubleDouble2{DoubleDouble(body.a1) * t.x, DoubleDouble(body.a2) * t.y};
    };
  };
  const Chart<DoubleDouble, 2> chart(d_, c, std::array{low, high}, stretch(a_), stretch(b_));
  return chart.excess(best, kChartNoiseInDoubleDouble * size_);
}

double Circle::excess(const Sample& low, const Sample& c, const Sample& high,
                      const Sample& best) const noexcept {
  const double noise = kNoise * size_;
  const double corners =
      nested_ ? nested_excess(low.n, c.n, high.n, best.f)
              : std::max(corner_excess(low, c, best.f), corner_excess(c, high, best.f));
  // Taylor's formula about c, the rest by the third derivative.
  const double reach = std::max(angle(low.n, c.n), angle(c.n, high.n));
  const double third = third_derivative(c, reach);
  const double slope = std::abs(c.r.high) + slope_error(c);
  const double curvature = c.curvature * (c.curvature > 0.0 ? 1.0 / kSlack : kSlack) - c.bend_error;
  const double above = (c.f - best.f).high;
  const double parabola = curvature > 0.0 && slope < curvature * reach
                              ? 0.5 * slope * slope / curvature
                              : slope * reach - 0.5 * curvature * reach * reach;
  double taylor = above + kSlack * (parabola + third * reach * reach * reach / 6.0);
  // Concave all over the arc, which has the stationary point that is the best: no more than that.
  const bool has_best = cross(low.n, best.n).high >= 0.0 && cross(best.n, high.n).high >= 0.0 &&
                        dot(best.n, c.n).high > 0.0;
  if (has_best && curvature - reach * third > 0.0) {
    taylor = 2.0 * reach * (std::abs(best.r.high) + slope_error(best));
  }
  return std::min(corners, taylor) + noise;
}

struct Arc {
  Sample low, high;
  int depth;
};

/// Depth first over the arcs of the half circle n.d >= 0, on the rest of which f is no better.
class Search {
 public:
  Search(const Circle& circle, const Sample& best, int budget) noexcept
      : circle_(circle), best_(best), budget_(budget) {}

  void run(const DoubleDouble2& from) noexcept {
    const DoubleDouble root(0.5);
    const DoubleDouble diagonal = sqrt(root);
    std::array<Sample, 5> corners;
    const DoubleDouble2 ahead = quarter(from);
    corners[0] = circle_.at(from);
    corners[1] = circle_.at(diagonal * (from + ahead));
    corners[2] = circle_.at(ahead);
    corners[3] = circle_.at(diagonal * (ahead - from));
    corners[4] = circle_.at(-from);
    for (std::size_t i = 0; i < 4; ++i) visit({corners[i], corners[i + 1], 0});
  }
  bool finished() const noexcept { return finished_; }
  const Sample& best() const noexcept { return best_; }
  double above() const noexcept { return above_; }

 private:
  void visit(const Arc& arc) noexcept {
    const Sample c = circle_.at(normalised(arc.low.n + arc.high.n));
    if ((c.f - best_.f).high > kTie * circle_.size()) {
      const Sample top = circle_.climb(c.n);
      best_ = (top.f - c.f).high > 0.0 ? top : c;
    }
    const double excess = circle_.excess(arc.low, c, arc.high, best_);
    ++arcs_;
    const double wanted = arcs_ > kFineBudget ? kCoarse : kFine;
    if (excess <= wanted * circle_.size()) {
      above_ = std::max(above_, excess);
      return;
    }
    if (arc.depth >= kDeepest || arcs_ > budget_) {
      finished_ = false;
      return;
    }
    visit({arc.low, c, arc.depth + 1});
    visit({c, arc.high, arc.depth + 1});
  }

  const Circle& circle_;
  Sample best_;
  int budget_;  ///< arcs
  double above_ = 0.0;
  int arcs_ = 0;
  bool finished_ = true;
};

/// v, or the other way round if that is more with d.
DoubleDouble2 towards(const DoubleDouble2& d, const DoubleDouble2& v) noexcept {
  return dot(d, v).high < 0.0 ? -v : v;
}

}  // namespace

PlaneProof climb_plane_gap(const PlanePair& pair, const Vec2& start) noexcept {
  const Circle circle(pair);
  return circle.proof(circle.climb(normalised(exactly(start))));
}

PlaneProof search_plane_gap(const PlanePair& pair, const Vec2& first, int budget) noexcept {
  const Circle circle(pair);
  const DoubleDouble2 u_a = double_double_direction(pair.a.direction());
  const DoubleDouble2 u_b = double_double_direction(pair.b.direction());
  const bool concentric = circle.d().x.high == 0.0 && circle.d().y.high == 0.0;
  Sample best = circle.climb(concentric || !first.allFinite() ? u_a : normalised(exactly(first)));
  const PlaneProof at_once = circle.proof(best);
  if (at_once.global) return at_once;
  for (const DoubleDouble2& axis : {u_a, quarter(u_a), u_b, quarter(u_b)}) {
    const Sample top = circle.climb(towards(circle.d(), axis));
    if ((top.f - best.f).high > kTie * circle.size()) best = top;
  }
  Search search(circle, best, budget);
  // A d so short that its square underflows makes no difference: any half circle will do.
  const double reach = std::max(std::abs(circle.d().x.high), std::abs(circle.d().y.high));
  const DoubleDouble2 ahead = reach < kShortest * circle.size() ? u_a : normalised(circle.d());
  search.run(-quarter(ahead));
  PlaneProof proof = circle.proof(search.best());
  if (proof.global || !search.finished()) return proof;
  proof.global = true;
  proof.high = proof.gap + (proof.gap - proof.low) + search.above();
  return proof;
}

}  // namespace tangency::inline v0::detail
