// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <tangency/geometry/gap/chart_bound.hpp>
#include <tangency/geometry/gap/search.hpp>

namespace tangency::inline v0::detail {
namespace {

// Of a direction: chosen, above the 3.2 u that parallel bodies may be off by, and small enough that
// twice (A) of the derivation is below kOrdinaryGapErrorBound.
constexpr double kParallel = 5.5 * kUnitRoundoff;
// (A): what the cross product of two stored axes, or of one and d, may be too small by, of the
// product of their lengths.
constexpr double kCrossError = 2.2 * kUnitRoundoff;
// Cosine between a peak and d's side of the axis; chosen: rounding moves a peak on the equator by
// less wherever the proof counts, and one that lies further on the other side is not of the
// maximum.
constexpr double kBeyondEquator = -0x1p-20;
constexpr double kValueError = 0x1p-92;  // (V2)
constexpr double kSlopeError = 0x1p-48;  // (A), of the terms of the slope
constexpr double kBendError = 0x1p-46;   // of the terms of the slope's own slope, of a difference
constexpr double kOnAxis = 0x1p-50;    // rad; chosen: nearer it is the axis, stationary by symmetry
constexpr std::size_t kMostPeaks = 8;  // chosen: 1 to 3 are common
constexpr std::size_t kMostPending = 64;  // a depth of 60 halvings is beyond doubles
constexpr int kBudget = 2000;             // arcs: chosen, ten times what aspect 1000 needs
// Arcs for a clearance, and those after which it is sought roughly: chosen.
constexpr int kClearanceBudget = 4000, kFineBudget = 1000;
// Of the size: what arcs may be above the best by. Chosen; with (A) below kWidestOk.
constexpr double kFine = 0x1p-58, kRough = 80 * kUnitRoundoff;

/// A direction along and one across an axis of revolution, unit.
struct Axes {
  Vec3 along, across;
};

/// A body of revolution in a plane through its axis.
struct Profile {
  double along, across;  ///< semi-axes
  bool is_sphere;
};

/// The axis of revolution, where there is just one, and the first of the equal axes.
std::optional<Axes> axes_of(const Ellipsoid& body, Profile& profile) {
  const Vec3& a = body.semi_axes();
  const Mat3& r = body.rotation();
  profile = {a[0], a[0], body.is_sphere()};
  if (profile.is_sphere) return std::nullopt;
  for (int k = 0; k < 3; ++k) {
    if (a[(k + 1) % 3] != a[(k + 2) % 3]) continue;
    profile = {a[k], a[(k + 1) % 3], false};
    return Axes{r.col(k), r.col(k == 0 ? 1 : 0)};
  }
  return std::nullopt;
}

/// Bodies that are exactly coaxial, and how far at most f is from theirs at any normal.
struct Coaxial {
  Axes axes;  ///< along: the axis, which points with d, but for its length
  Profile a, b;
  DoubleDouble d;
  double error;
};

std::optional<Coaxial> coaxial(const Pair& pair) {
  Coaxial found;
  const std::optional<Axes> of_a = axes_of(pair.a, found.a), of_b = axes_of(pair.b, found.b);
  if ((!of_a && !found.a.is_sphere) || (!of_b && !found.b.is_sphere)) return std::nullopt;
  found.axes = of_a ? *of_a : *of_b;
  Vec3& axis = found.axes.along;
  const double distance = pair.d.norm(), off = axis.cross(pair.d).norm();
  const double turned = of_a && of_b ? axis.cross(of_b->along).norm() : 0.0;
  if (turned > kParallel || off > kParallel * distance) return std::nullopt;
  if (axis.dot(pair.d) < 0.0) axis = -axis;
  DoubleDouble along, square;
  for (int i = 0; i < 3; ++i) {
    along = along + DoubleDouble(axis[i]) * DoubleDouble(pair.d[i], pair.d_low[i]);
    square = square + two_product(axis[i], axis[i]);
  }
  found.d = along / sqrt(square);
  // (A)
  const double turn_a = of_a ? kUnitRoundoff : 0.0;
  const double turn_b = !of_b ? 0.0 : of_a ? turned + kCrossError : kUnitRoundoff;
  found.error = kMore * (off + kCrossError * distance + turn_a * pair.a.largest_semi_axis() +
                         turn_b * pair.b.largest_semi_axis() + kValueError * pair.size);
  return found;
}

/// f of the coaxial bodies on the great circle n(t) = cos t axis + sin t across, which by symmetry
/// is all of it.
class Meridian {
 public:
  Meridian(const Pair& pair, const FactoredPair& factored, const Coaxial& ideal)
      : pair_(pair),
        factored_(factored),
        ideal_(ideal),
        nested_(pair.sought == Sought::clearance) {}

  bool climb(double t) {
    const Stationary found = factored_.climb(normal(t));
    const bool kept = found.accepted || (nested_ && count_ == 0 && found.normal.allFinite());
    if (!kept || count_ == kMostPeaks) return false;
    GapProof proof = prove_gap_in_double_double(pair_, found.normal);
    const Vec3& axis = ideal_.axes.along;
    double along = proof.normal.dot(axis);
    // Only concentric pairs look alike from both ends of the axis.
    if (pair_.d == Vec3::Zero()) along = std::abs(along);
    if (along < kBeyondEquator) return false;
    const double angle = std::atan2(proof.normal.cross(axis).norm(), along);
    // An ascent may wander along a circle of ties; of those the documented one is on the meridian.
    const GapProof here = prove_gap_in_double_double(pair_, normal(angle));
    if (here.gap >= proof.gap - kTieOfSize * pair_.size) proof = here;
    add(proof, angle < kOnAxis ? 0.0 : angle);
    return true;
  }

  bool prove() {
    constexpr double kQuarter = 0x1.921fb54442d19p+0;  // pi / 2, rounded up
    pending_[waiting_++] = {0.0, kQuarter};
    for (int arcs = 0; waiting_ != 0; ++arcs) {
      const int budget = nested_ ? kClearanceBudget : kBudget;
      if (arcs == budget || waiting_ + 2 > kMostPending) return false;
      const auto [from, to] = pending_[--waiting_];
      if (in_a_cap(from, to)) continue;
      if (nested_ ? no_rise(from, to, arcs > kFineBudget) : below_best(from, to)) continue;
      const double middle = 0.5 * (from + to);
      pending_[waiting_++] = {from, middle};
      pending_[waiting_++] = {middle, to};
    }
    return true;
  }

  GapProof result() const {
    GapProof answer = peaks_[best_].proof;
    if (better_) {
      const GapProof proof = prove_gap_in_double_double(pair_, normal(*better_));
      if (proof.low > answer.low) answer = proof, answer.gap = answer.low;
    }
    answer.global = true;
    answer.high = answer.gap;
    for (std::size_t i = 0; i < count_; ++i) {
      const Peak& peak = peaks_[i];
      if (peak.needed || i == best_)
        answer.high = std::max(answer.high, peak.highest + ideal_.error);
    }
    if (nested_) {
      const double high = std::nextafter(reference_ + above_, GapProof::kUnproven);
      answer.high = std::max(answer.high, std::nextafter(high + ideal_.error, GapProof::kUnproven));
    }
    return answer;
  }

 private:
  struct Peak {
    GapProof proof;
    double t;
    double width;    ///< rad: on both sides f of the coaxial bodies is ...
    double highest;  ///< ... at most this
    bool needed = false;
  };

  /// A direction (cosine, sine) from the axis as stored, of length 1 but for rounding.
  struct Direction {
    double c, s;
    explicit Direction(double t) : c(std::cos(t)), s(std::sin(t)) {}
  };

  Vec3 normal(double t) const {
    return std::cos(t) * ideal_.axes.along + std::sin(t) * ideal_.axes.across;
  }

  static double support(const Profile& body, const Direction& n) {
    return std::hypot(body.along * n.c, body.across * n.s);
  }

  /// f of the coaxial bodies.
  DoubleDouble value(const Direction& n) const {
    const DoubleDouble c = n.c, s = n.s;
    const auto length = [&](double p, double q) {
      const DoubleDouble x = two_product(p, n.c), y = two_product(q, n.s);
      return sqrt(x * x + y * y);
    };
    const DoubleDouble a = length(ideal_.a.along, ideal_.a.across);
    const DoubleDouble b = length(ideal_.b.along, ideal_.b.across);
    const DoubleDouble beyond_a = ideal_.d * c - a;
    return (nested_ ? beyond_a + b : beyond_a - b) / sqrt(c * c + s * s);
  }

  /// The cap of cap.cpp along one tangent only.
  void add(const GapProof& proof, double t) {
    Peak& peak = peaks_[count_];
    peak.proof = proof;
    // What it proves of the maximum nearby is for one that is sharp in every direction.
    peak.proof.gap = peak.proof.low;
    peak.t = t;
    const Direction n(t);
    const DoubleDouble at = value(n);
    const double f = at.high;
    peak.highest = std::nextafter(f, GapProof::kUnproven);
    peak.width = 0.0;
    double radius = 0.0, of_b = 0.0, slope = -ideal_.d.high * n.s, terms = std::abs(slope);
    double reach = std::numeric_limits<double>::infinity();
    for (const Profile* body : {&ideal_.a, &ideal_.b}) {
      const double p = body->along, q = body->across, h = support(*body, n);
      const double root = p * (q / h), turn = (p - q) * ((p + q) / h) * (n.s * n.c);
      const bool taken = nested_ && body == &ideal_.b;
      (taken ? of_b : radius) += root * (root / h);
      slope += taken ? -turn : turn, terms += std::abs(turn);
      reach = std::min(reach, h / std::hypot(p * n.s, q * n.c));
    }
    double kappa = std::min(1.0, std::sqrt(radius * kLess / -f) - 1.0);
    double least = radius * kLess / (1.0 + kappa) + f;
    if (nested_) {
      // (N) along one tangent.
      const double slack = ((radius - of_b) + f) - kBendError * (radius + of_b + std::abs(f));
      kappa = std::min(0.5, kLess * 0.5 * slack / (radius + 2.0 * of_b));
      least = 0.5 * slack;
    }
    if (f < 0.0 && kappa > (nested_ ? 0.0 : 64.0 * kRoundings)) {
      const double steep = std::abs(slope) + kSlopeError * terms;
      peak.highest = std::nextafter(f + 0.5 * steep * (steep / least) * kMore, GapProof::kUnproven);
      // Less what t and the ends of arcs are rounded by.
      if (2.0 * steep <= least * kappa * reach)
        peak.width = std::max(0.0, std::atan(kappa * reach) * kLess - 0x1p-50 * t);
    }
    const double best = count_ == 0 ? 0.0 : peaks_[best_].proof.gap;
    if (count_ == 0 || peak.proof.gap > best + kTieOfSize * pair_.size) best_ = count_;
    ++count_;
  }

  bool in_a_cap(double from, double to) {
    for (std::size_t i = 0; i < count_; ++i) {
      Peak& peak = peaks_[i];
      if (peak.t - peak.width <= from && to <= peak.t + peak.width) return peak.needed = true;
    }
    return false;
  }

  bool below_best(double from, double to) {
    const double middle = 0.5 * (from + to);
    // The linear function of the support points at the middle: (G), of the coaxial bodies.
    const Direction n(middle);
    double x = ideal_.d.high, y = 0.0;
    for (const Profile* body : {&ideal_.a, &ideal_.b}) {
      const double h = support(*body, n);
      x -= body->along * (body->along * n.c / h), y -= body->across * (body->across * n.s / h);
    }
    const auto along = [&](const Direction& v) { return x * v.c + y * v.s; };
    const double best = peaks_[best_].proof.gap;
    if (along(n) > best + kTieOfSize * pair_.size && climb(middle) && in_a_cap(from, to))
      return true;
    const double enough = peaks_[best_].proof.gap - kPlaneError * pair_.size;
    return std::max(along(Direction(from)), along(Direction(to))) <= enough && enough < 0.0;
  }

  /// For a clearance: by the second order of f in the chart of the middle.
  bool no_rise(double from, double to, bool roughly) {
    const double middle = 0.5 * (from + to);
    reference_ = std::max(reference_, peaks_[best_].highest);
    const DoubleDouble here = value(Direction(middle));
    if ((here - DoubleDouble(reference_)).high > 0.0) reference_ = here.high, better_ = middle;
    const auto at = [](double t) {
      const Direction n(t);
      return DoubleDouble2{n.c, n.s};
    };
    const auto stretch = [](const Profile& body) {
      return [&body](const DoubleDouble2& v) {
        return DoubleDouble2{DoubleDouble(body.along) * v.x, DoubleDouble(body.across) * v.y};
      };
    };
    const Chart<DoubleDouble, 2> chart(DoubleDouble2{ideal_.d, 0.0}, normalised(at(middle)),
                                       std::array{at(from), at(to)}, stretch(ideal_.a),
                                       stretch(ideal_.b));
    const double rise = chart.excess(reference_, kChartNoiseInDoubleDouble * pair_.size);
    if (!(rise <= (roughly ? kRough : kFine) * pair_.size)) return false;  // true for NaN
    above_ = std::max(above_, rise);
    return true;
  }

  const Pair& pair_;
  const FactoredPair& factored_;
  const Coaxial& ideal_;
  bool nested_;
  // f is at most reference + above on arcs that are in no cap.
  double reference_ = -std::numeric_limits<double>::infinity(), above_ = 0.0;
  std::optional<double> better_;  ///< angle of the best middle of an arc
  std::array<Peak, kMostPeaks> peaks_;
  std::size_t count_ = 0, best_ = 0;
  std::array<std::pair<double, double>, kMostPending> pending_;
  std::size_t waiting_ = 0;
};

}  // namespace

std::optional<GapProof> search_meridian(const Pair& pair, const FactoredPair& factored) noexcept {
  const std::optional<Coaxial> ideal = coaxial(pair);
  if (!ideal) return std::nullopt;
  Meridian meridian(pair, factored, *ideal);
  bool found = false;
  // Chosen: along, across and between. The other half of a concentric pair looks the same.
  for (const double t : {0.0, 1.5707963267948966, 0.5, 1.0}) found = meridian.climb(t) || found;
  if (!found || !meridian.prove()) return std::nullopt;
  return meridian.result();
}

}  // namespace tangency::inline v0::detail
