// SPDX-License-Identifier: MIT
#include <tangency/geometry/trace/scheme.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <tangency/geometry/numbers/projective_quartic.hpp>
#include <tangency/geometry/trace/frame.hpp>

namespace tangency::inline v0::detail {
namespace {

/// Halvings of the box: 2^10 - 1 curves at most. Chosen: the thesis says "and so on".
constexpr int kLevels = 10;

/// The pair in coordinates in which B is the unit ball: points of A's surface are centre + axes u,
/// |u| = 1.
template <class Real>
struct Images {
  TraceVector<Real> centre;
  Eigen::Matrix<Real, 3, 3> axes;
  Real level(const TraceVector<Real>& u) const { return (centre + axes * u).squaredNorm() - 1; }
};

/// Where the ellipse centre + x cos t + y sin t crosses the unit sphere, as t - start in
/// [-pi/2, 3 pi/2), ascending. With w = tan((t - start)/2) that is a quartic, whose singular place
/// w = infinity is opposite to the start and no worse than others (projective_quartic.hpp).
template <class Real>
struct Crossings {
  std::array<Real, 4> t;
  std::size_t count = 0;

  Crossings(const TraceVector<Real>& centre, const TraceVector<Real>& x, const TraceVector<Real>& y,
            Real start) {
    const Real c = std::cos(start), s = std::sin(start);
    const TraceVector<Real> u = c * x + s * y, v = c * y - s * x;
    const Real uv = u.dot(v), vm = v.dot(centre);
    const auto roots = projective_roots<Real>(
        {(centre + u).squaredNorm() - 1, 4 * (vm + uv),
         2 * (2 * v.squaredNorm() - u.squaredNorm() + (centre.squaredNorm() - 1)), 4 * (vm - uv),
         (centre - u).squaredNorm() - 1});
    for (int i = 0; i < roots.count && count < t.size(); ++i) {
      const auto& root = roots.root[static_cast<std::size_t>(i)];
      if (root.crosses) t[count++] = root.angle();
    }
  }
};

/// The theta-curve's arcs in B that end at neither pole.
template <class Real>
struct Arcs {
  int count = 0;
  Interval<Real> first{0, 0};
};

template <class Real>
Arcs<Real> cut_theta_curve(const Images<Real>& pair, Real theta, Real start) {
  const TraceVector<Real> outwards =
      std::cos(theta) * pair.axes.col(0) + std::sin(theta) * pair.axes.col(1);
  const TraceVector<Real> pole = pair.axes.col(2);
  const Crossings<Real> crossings(pair.centre, pole, outwards, start);
  std::array<Real, 4> phi;
  std::size_t count = 0;
  for (std::size_t i = 0; i < crossings.count; ++i) {
    const Real t = std::remainder(start + crossings.t[i], 2 * kPi<Real>);
    if (t <= 0) continue;  // the other half is the curve at theta + pi
    std::size_t place = count++;
    for (; place > 0 && phi[place - 1] > t; --place) phi[place] = phi[place - 1];
    phi[place] = t;
  }
  Arcs<Real> arcs;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const Interval<Real> piece{phi[i], phi[i + 1]};
    const Real middle = piece.middle();
    const TraceVector<Real> point =
        pair.centre + std::cos(middle) * pole + std::sin(middle) * outwards;
    if (point.squaredNorm() >= 1) continue;
    if (arcs.count++ == 0) arcs.first = piece;
  }
  return arcs;
}

/// The arc of the phi-curve around theta, which is in B; nothing where the whole curve is.
template <class Real>
std::optional<Interval<Real>> cut_phi_curve(const Images<Real>& pair, Real phi, Real theta) {
  const Real s = std::sin(phi);
  const Crossings<Real> crossings(pair.centre + std::cos(phi) * pair.axes.col(2),
                                  s * pair.axes.col(0), s * pair.axes.col(1), theta);
  if (crossings.count == 0) return std::nullopt;
  Interval<Real> arc{-2 * kPi<Real>, 2 * kPi<Real>};
  for (std::size_t i = 0; i < crossings.count; ++i) {
    const Real t = crossings.t[i];
    arc.low = std::max(arc.low, t < 0 ? t : t - 2 * kPi<Real>);
    arc.high = std::min(arc.high, t > 0 ? t : t + 2 * kPi<Real>);
  }
  return Interval<Real>{theta + arc.low, theta + arc.high};
}

template <class Real>
struct Limits {
  Interval<Real> theta, phi;
};

/// Steps 2 and 3: the limits, or why there are none.
template <class Real>
struct Search {
  TraceStatus status = TraceStatus::no_arc;
  Limits<Real> limits{};
  int curves = 0;

  Search(const Images<Real>& pair, const Interval<Real>& box, Real start, bool first_found) {
    for (int level = 1; level <= kLevels && status == TraceStatus::no_arc; ++level) {
      const int parts = 1 << level;
      for (int n = 1; n < parts; n += 2) {
        const Real fraction = static_cast<Real>(n) / static_cast<Real>(parts);
        try_curve(pair, box.low + fraction * (box.high - box.low), start);
        if (status == TraceStatus::several_arcs) return;
        if (status == TraceStatus::ok && first_found) return;
      }
    }
  }

  /// Keeps what a theta-curve gives where its arc is the longest so far.
  void try_curve(const Images<Real>& pair, Real theta, Real start) {
    ++curves;
    const Arcs<Real> arcs = cut_theta_curve(pair, theta, start);
    if (arcs.count == 0) return;
    if (arcs.count > 1) {
      status = TraceStatus::several_arcs;
      return;
    }
    const Interval<Real>&arc = arcs.first, &best = limits.phi;
    if (arc.high - arc.low <= best.high - best.low) return;
    const auto around = cut_phi_curve(pair, arc.middle(), theta);
    if (!around) return;
    limits = {*around, arc};
    status = TraceStatus::ok;
  }

  /// Cuts again through the middle of the limits.
  void refine(const Images<Real>& pair) {
    const Real theta = limits.theta.middle();
    const Arcs<Real> arcs = cut_theta_curve(pair, theta, limits.phi.middle());
    if (arcs.count != 1) return;
    if (const auto around = cut_phi_curve(pair, arcs.first.middle(), theta)) {
      limits = {*around, arcs.first};
    }
  }
};

/// The roots t of |p + t q|^2 = 1; inside = 1 - |p|^2.
template <class Real>
std::optional<Interval<Real>> line_through_ball(const TraceVector<Real>& p,
                                                const TraceVector<Real>& q, Real inside) {
  const Real pq = p.dot(q), qq = q.squaredNorm(), discriminant = pq * pq + qq * inside;
  if (!(discriminant > 0)) return std::nullopt;
  // Of the two forms of each root the one in which nothing cancels.
  const Real root = std::sqrt(discriminant), sum = std::abs(pq) + root;
  if (pq > 0) return Interval<Real>{-sum / qq, inside / sum};
  return Interval<Real>{-inside / sum, sum / qq};
}

/// Step 4, in A's frame and explicit: docs/derivations/trace-contact.md. d in that frame.
template <class Real>
TraceFound<Real> contact(const Poled<Real>& a, const Images<Real>& pair,
                         const Limits<Real>& limits) {
  TraceFound<Real> found{};
  const Real theta = limits.theta.middle(), phi = limits.phi.middle();
  const Real half_theta = (limits.theta.high - limits.theta.low) / 2,
             half_phi = (limits.phi.high - limits.phi.low) / 2;
  found.status = TraceStatus::no_tangent_plane;
  if (!(half_theta < kPi<Real> / 2)) return found;
  const Real sin_phi = std::sin(phi), cos_phi = std::cos(phi);
  const Real c_t = std::cos(half_theta), c_p = std::cos(half_phi);
  const TraceVector<Real> around(std::cos(theta) * sin_phi, std::sin(theta) * sin_phi, 0);
  const auto along_pole = [](Real z) { return TraceVector<Real>(0, 0, z); };
  // In the coordinates that make A the unit ball: the centroid, and the normal's image.
  const TraceVector<Real> centroid = c_p * (c_t * around + along_pole(cos_phi));
  const TraceVector<Real> normal =
      (around + along_pole(c_t * cos_phi)).cwiseQuotient(a.frame.radii).normalized();
  const TraceVector<Real> step = normal.cwiseQuotient(a.frame.radii);
  const Real s_p = std::sin(half_phi), s_t = std::sin(half_theta);
  const auto p = line_through_ball<Real>(centroid, step,
                                         s_p * s_p + c_p * c_p * s_t * s_t * sin_phi * sin_phi);
  const auto q = line_through_ball<Real>(pair.centre + pair.axes * centroid, pair.axes * step,
                                         -pair.level(centroid));
  found.status = TraceStatus::no_overlap_on_the_line;
  if (!p || !q) return found;
  const Real depth = p->high - q->low;
  const Real other = std::min(
      {std::abs(p->low - q->low), std::abs(p->low - q->high), std::abs(p->high - q->high)});
  if (!(depth > 0) || other < depth || !std::isfinite(depth)) return found;
  found.status = TraceStatus::ok;
  found.gap = -depth;
  const auto in_space = [&](const TraceVector<Real>& u) {
    return TraceVector<Real>(a.frame.axes * a.frame.radii.cwiseProduct(u));
  };
  found.normal = a.frame.axes * normal;
  found.arm_a = in_space(centroid + p->high * step);
  found.arm_b = in_space(centroid + q->low * step);  // from A's centre
  const auto& [t, f] = limits;
  const std::array<std::pair<Real, Real>, 4> at{
      {{t.low, f.low}, {t.high, f.low}, {t.high, f.high}, {t.low, f.high}}};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto [theta_k, phi_k] = at[k];
    found.corner[k] = in_space({std::cos(theta_k) * std::sin(phi_k),
                                std::sin(theta_k) * std::sin(phi_k), std::cos(phi_k)});
  }
  return found;
}

template <class Real>
Images<Real> images(const Poled<Real>& a, const TraceBody<Real>& b, const TraceVector<Real>& d) {
  const auto to_ball = [&](const auto& v) {
    return TraceVector<Real>((b.rotation.transpose() * v).cwiseQuotient(b.semi_axes));
  };
  Images<Real> pair;
  pair.centre = -to_ball(d);
  for (int k = 0; k < 3; ++k) pair.axes.col(k) = a.frame.radii[k] * to_ball(a.frame.axes.col(k));
  return pair;
}

}  // namespace

template <class Real>
TraceFound<Real> trace_scheme(const TraceBody<Real>& a, const TraceBody<Real>& b,
                              const TraceVector<Real>& d, const TraceOptions& options) noexcept {
  TraceFound<Real> result{};
  result.status = TraceStatus::concentric;
  const Real distance = d.norm();
  if (distance == 0) return result;
  Frame<Real> frame = sorted_frame(a);
  if (options.turned_to_the_pair) turn_to_pair(frame, b, d);
  const TraceVector<Real> e = frame.axes.transpose() * d / distance;

  const Cones<Real> cones(a.semi_axes.maxCoeff(), b.semi_axes.maxCoeff(), distance);
  int curves = 0;
  for (std::size_t i = 0; i < cones.count; ++i) {
    const Poled<Real> poled = choose_pole(frame, cones.cone[i], e);
    const Images<Real> pair = images(poled, b, d);
    // phi of the line of centres: a place to count the curve's angle from.
    const TraceVector<Real> towards = poled.e.cwiseQuotient(poled.frame.radii);
    const Real phi = std::atan2(std::hypot(towards.x(), towards.y()), towards.z());
    Search<Real> search(pair, theta_box(poled, cones.cone[i]), phi, !options.turned_to_the_pair);
    curves += search.curves;
    result.status = search.status;
    if (search.status == TraceStatus::no_arc) continue;
    if (search.status == TraceStatus::ok) {
      for (int k = 0; k < options.refinements; ++k) search.refine(pair);
      result = contact(poled, pair, search.limits);
      result.arm_b -= d;
    }
    result.cone = cones.cone[i].kind;
    result.other_pole = poled.other_pole;
    break;
  }
  result.curves = curves;
  return result;
}

template TraceFound<float> trace_scheme(const TraceBody<float>&, const TraceBody<float>&,
                                        const TraceVector<float>&, const TraceOptions&) noexcept;
template TraceFound<double> trace_scheme(const TraceBody<double>&, const TraceBody<double>&,
                                         const TraceVector<double>&, const TraceOptions&) noexcept;
template TraceFound<long double> trace_scheme(const TraceBody<long double>&,
                                              const TraceBody<long double>&,
                                              const TraceVector<long double>&,
                                              const TraceOptions&) noexcept;

}  // namespace tangency::inline v0::detail
