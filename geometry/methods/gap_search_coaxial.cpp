// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include <tangency/geometry/methods/gap_search.hpp>

namespace tangency::methods {
namespace {

// Of a direction: chosen, twice what the stored axes of parallel bodies may differ by.
constexpr double kParallel = 8 * kUnitRoundoff;
// Cosine between a peak and d's side of the axis; chosen: rounding moves a peak on the equator by
// less wherever the proof counts, and one that lies further on the other side is not of the
// maximum.
constexpr double kBeyondEquator = -0x1p-20;
// (A) of the derivation: what f of bodies within kParallel of coaxial may lack, of the size, and
// what r may, of size and largest radii of curvature.
constexpr double kAsymmetry = 10 * kUnitRoundoff;
constexpr double kSkewRest = 10 * kUnitRoundoff;
constexpr std::size_t kMostPeaks = 8;     // chosen: 1 to 3 are common
constexpr std::size_t kMostPending = 64;  // a depth of 60 halvings is beyond doubles
constexpr int kBudget = 2000;             // arcs: chosen, ten times what aspect 1000 needs

/// A direction along and one across an axis of revolution, unit.
struct Axes {
  Vec3 along, across;
};

/// The axis of revolution, where there is just one, and the first of the equal axes.
std::optional<Axes> axes_of(const Ellipsoid& body) {
  const Vec3& a = body.semi_axes();
  const Mat3& r = body.rotation();
  if (body.is_sphere()) return std::nullopt;
  for (int k = 0; k < 3; ++k) {
    if (a[(k + 1) % 3] == a[(k + 2) % 3]) return Axes{r.col(k), r.col(k == 0 ? 1 : 0)};
  }
  return std::nullopt;
}

/// The axis about which both bodies and their line of centres can be turned, pointing with d.
std::optional<Axes> common_axes(const Pair& pair) {
  const std::optional<Axes> of_a = axes_of(pair.a), of_b = axes_of(pair.b);
  if ((!of_a && !pair.a.is_sphere()) || (!of_b && !pair.b.is_sphere())) return std::nullopt;
  Axes axes = of_a ? *of_a : *of_b;
  if (of_b && axes.along.cross(of_b->along).norm() > kParallel) return std::nullopt;
  if (axes.along.cross(pair.d).norm() > kParallel * pair.d.norm()) return std::nullopt;
  if (axes.along.dot(pair.d) < 0.0) axes.along = -axes.along;
  return axes;
}

/// f on the great circle n(t) = cos t axis + sin t across, which by symmetry is all of f.
class Meridian {
 public:
  Meridian(const Pair& pair, const FactoredPair& factored, const Axes& axes)
      : pair_(pair), factored_(factored), axis_(axes.along), across_(axes.across) {}

  bool climb(double t) {
    const Stationary found = factored_.climb(normal(t));
    if (!found.accepted || count_ == kMostPeaks) return false;
    GapProof proof = prove_gap_in_double_double(pair_, found.normal);
    double along = proof.normal.dot(axis_);
    // Only concentric pairs look alike from both ends of the axis.
    if (pair_.d == Vec3::Zero()) along = std::abs(along);
    if (along < kBeyondEquator) return false;
    const double angle = std::atan2(proof.normal.cross(axis_).norm(), along);
    // An ascent may wander along a circle of ties; of those the documented one is on the meridian.
    const GapProof here = prove_gap_in_double_double(pair_, normal(angle));
    if (here.gap >= proof.gap - kTieOfSize * pair_.size) proof = here;
    add(proof, angle);
    return true;
  }

  bool prove() {
    constexpr double kQuarter = 0x1.921fb54442d19p+0;  // pi / 2, rounded up
    pending_[waiting_++] = {0.0, kQuarter};
    for (int arcs = 0; waiting_ != 0; ++arcs) {
      if (arcs == kBudget || waiting_ + 2 > kMostPending) return false;
      const auto [from, to] = pending_[--waiting_];
      if (in_a_cap(from, to) || below_best(from, to)) continue;
      const double middle = 0.5 * (from + to);
      pending_[waiting_++] = {from, middle};
      pending_[waiting_++] = {middle, to};
    }
    return true;
  }

  GapProof result() const {
    GapProof answer = peaks_[best_].proof;
    const double error = kAsymmetry * pair_.size;
    answer.global = true;
    answer.high = answer.gap;
    for (std::size_t i = 0; i < count_; ++i) {
      const Peak& peak = peaks_[i];
      if (peak.needed || i == best_)
        answer.high = std::max(answer.high, peak.proof.gap + peak.height + error);
    }
    return answer;
  }

 private:
  struct Peak {
    GapProof proof;
    double t;
    double width;  ///< rad: on both sides f is at most its value here + height
    double height;
    bool needed = false;
  };

  Vec3 normal(double t) const { return std::cos(t) * axis_ + std::sin(t) * across_; }

  Vec3 rest(const Vec3& n, double& h_a, double& h_b) const {
    const Vec3 ya = factored_.factor_a().transpose() * n, yb = factored_.factor_b().transpose() * n;
    h_a = ya.norm(), h_b = yb.norm();
    return pair_.d - factored_.factor_a() * (ya / h_a) - factored_.factor_b() * (yb / h_b);
  }

  /// The cap of gap_cap.cpp along one tangent only.
  void add(const GapProof& proof, double t) {
    Peak& peak = peaks_[count_];
    const Vec3 n = normal(t).normalized(), e = across_ * std::cos(t) - axis_ * std::sin(t);
    peak.proof = proof;
    // What it proves of the maximum nearby is for one that is sharp in every direction.
    peak.proof.gap = peak.proof.low;
    peak.t = t;
    peak.width = 0.0, peak.height = 0.0;
    double h_a, h_b;
    const Vec3 r = rest(n, h_a, h_b);
    const double radius =
        hessian_along(pair_.a, h_a, n.cross(e)) + hessian_along(pair_.b, h_b, n.cross(e));
    const double f = peak.proof.gap;
    const double kappa = std::min(1.0, std::sqrt(radius * kLess / -f) - 1.0);
    const double least = radius * kLess / (1.0 + kappa) + f;
    if (f < 0.0 && kappa > 64.0 * kRoundings) {
      const double largest = pair_.a.largest_semi_axis() * (pair_.a.largest_semi_axis() / h_a) +
                             pair_.b.largest_semi_axis() * (pair_.b.largest_semi_axis() / h_b);
      // (R) and (A)
      const double slope = std::abs(r.dot(e)) +
                           kUnitRoundoff * (8.0 * largest + 32.0 * pair_.size) +
                           kSkewRest * (largest + pair_.size);
      const double reach = kappa * std::min(h_a / (factored_.factor_a().transpose() * e).norm(),
                                            h_b / (factored_.factor_b().transpose() * e).norm());
      peak.height = 0.5 * slope * (slope / least) * kMore;
      if (2.0 * slope <= least * reach) peak.width = std::atan(reach) * kLess;
    }
    if (count_ == 0 || f > peaks_[best_].proof.gap + kTieOfSize * pair_.size) best_ = count_;
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
    double h_a, h_b;
    const double middle = 0.5 * (from + to);
    const Vec3 n = normal(middle), r = rest(n, h_a, h_b);
    const double best = peaks_[best_].proof.gap;
    if (r.dot(n) > best + kTieOfSize * pair_.size && climb(middle) && in_a_cap(from, to))
      return true;
    const double enough = peaks_[best_].proof.gap - kPlaneError * pair_.size;
    return std::max(r.dot(normal(from)), r.dot(normal(to))) <= enough && enough < 0.0;
  }

  const Pair& pair_;
  const FactoredPair& factored_;
  Vec3 axis_, across_;
  std::array<Peak, kMostPeaks> peaks_;
  std::size_t count_ = 0, best_ = 0;
  std::array<std::pair<double, double>, kMostPending> pending_;
  std::size_t waiting_ = 0;
};

}  // namespace

std::optional<GapProof> search_meridian(const Pair& pair, const FactoredPair& factored) noexcept {
  const std::optional<Axes> axes = common_axes(pair);
  if (!axes) return std::nullopt;
  Meridian meridian(pair, factored, *axes);
  bool found = false;
  // Chosen: along, across and between. The other half of a concentric pair looks the same.
  for (const double t : {0.0, 1.5707963267948966, 0.5, 1.0}) found = meridian.climb(t) || found;
  if (!found || !meridian.prove()) return std::nullopt;
  return meridian.result();
}

}  // namespace tangency::methods
