// SPDX-License-Identifier: MIT
#include <tangency/geometry/gap/search.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <tangency/geometry/gap/chart_bound.hpp>
#include <tangency/geometry/gap/error_bounds.hpp>

namespace tangency::inline v0::detail {
namespace {

constexpr std::size_t kMostPeaks = 16;     // chosen: 2 to 6 are common
constexpr std::size_t kMostPending = 256;  // four, and one more for each of some 220 halvings
constexpr double kCapError = 64 * kUnitRoundoff;  // section 5 of the derivation, of a semi-axis
constexpr int kGrace = 4;          // chosen: halvings between two ascents from a patch that stays
constexpr double kCapWidth = 1.0;  // chosen: caps as wide as the curvatures allow
// Of a clearance: of the size, what triangles may be above the best by. Chosen: a search that is
// slow settles for more, at last for what is below kWidestOk.
constexpr double kFine = 0x1p-58, kCoarse = 0x1p-51, kRough = 80 * kUnitRoundoff;
constexpr int kFineBudget = 1000, kCoarseBudget = 4000;  // triangles
constexpr double kDoubtful = 0x1p-41;  // of the size: chosen, some times kChartNoise

/// A maximum, and the cap of normals around it in which its proof bounds f.
struct Peak {
  CapProof proof;
  Vec3 stretched_a, stretched_b;  ///< A' n
  double width;                   ///< of the cap; 0 where there is none
  bool needed = false;            ///< did a patch rest on this cap?
};

struct Triangle {
  std::array<Vec3, 3> corner;  ///< unit but for rounding; for a clearance exact, of any length
  int halvings;
};

/// v -> A'v in double-double.
class Stretch {
 public:
  explicit Stretch(const Ellipsoid& body)
      : rotation_(double_double_rotation(body.orientation())), axes_(exactly(body.semi_axes())) {}

  DoubleDoubleVector operator()(const DoubleDoubleVector& v) const {
    DoubleDoubleVector y = turned_back(rotation_, v);
    for (std::size_t i = 0; i < 3; ++i) y[i] = axes_[i] * y[i];
    return y;
  }

 private:
  DoubleDoubleMatrix rotation_;
  DoubleDoubleVector axes_;
};

/// What a search for a clearance needs in double-double.
struct Nested {
  Stretch a, b;
  DoubleDoubleVector d;

  explicit Nested(const Pair& pair) : a(pair.a), b(pair.b) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto k = static_cast<int>(i);
      d[i] = DoubleDouble(pair.d[k], pair.d_low[k]);
    }
  }
};

class SphereSearch {
 public:
  SphereSearch(const Pair& pair, const FactoredPair& factored)
      : pair_(pair), factored_(factored), size_(pair.size) {
    if (pair.sought == Sought::clearance) nested_.emplace(pair);
  }

  void climb(const Vec3& start) {
    const Stationary found = factored_.climb(start);
    // Whatever the normal, it has a value: of a clearance one is kept, though doubles do not tell
    // that it is a maximum.
    const bool kept = found.accepted || (nested_ && count_ == 0 && found.normal.allFinite());
    if (!kept || count_ == kMostPeaks) return;
    const auto end = peaks_.begin() + std::ptrdiff_t(count_);
    if (std::any_of(peaks_.begin(), end, [&](const Peak& p) { return holds(p, found.normal); }))
      return;
    Peak& peak = *end;
    peak.proof = prove_gap_in_double_double(pair_, found.normal, kCapWidth);
    peak.stretched_a = factored_.factor_a().transpose() * peak.proof.normal;
    peak.stretched_b = factored_.factor_b().transpose() * peak.proof.normal;
    peak.width = peak.proof.cap.proven ? kLess * peak.proof.cap.width : 0.0;
    if (count_ == 0 || peak.proof.gap > best().gap + kTieOfSize * size_) best_ = count_;
    ++count_;
  }

  /// Is every normal shown to be no better than the best, within the budget?
  bool prove(int budget) {
    if (best().global && best().high - best().low <= kOrdinaryError * size_) return true;
    if (nested_) return prove_all(budget);
    // f(-n) = f(n) - 2 n.d: only the half of the sphere towards d can hold the greatest value.
    const Vec3 pole = pair_.d == Vec3::Zero() ? Vec3(Vec3::UnitZ()) : pair_.d.stableNormalized();
    const Vec3 e = pole.unitOrthogonal(), m = pole.cross(e).normalized();
    for (const auto& [p, q] : {std::pair(e, m), {m, Vec3(-e)}, {Vec3(-e), Vec3(-m)}, {Vec3(-m), e}})
      pending_[waiting_++] = {{pole, p, q}, 0};
    for (; waiting_ != 0; ++triangles_) {
      if (triangles_ == budget) return false;
      const Triangle t = pending_[--waiting_];
      if (in_a_cap(t) || below_best(t)) continue;
      if (waiting_ + 2 > kMostPending) return false;
      split(t);
    }
    return true;
  }

  /// The same for a clearance, over the sides of an octahedron: their corners and the middles of
  /// those are exact, so that triangles leave no slivers between them.
  bool prove_all(int budget) {
    for (const double x : {1.0, -1.0}) {
      for (const double y : {1.0, -1.0}) {
        for (const double z : {1.0, -1.0})
          pending_[waiting_++] = {{x * Vec3::UnitX(), y * Vec3::UnitY(), z * Vec3::UnitZ()}, 0};
      }
    }
    for (; waiting_ != 0; ++triangles_) {
      if (triangles_ == budget) return false;
      const Triangle t = pending_[--waiting_];
      if (is_behind(t) || in_a_cap(t) || no_rise(t)) continue;
      if (waiting_ + 2 > kMostPending || !split_exactly(t)) return false;
    }
    return true;
  }

  bool found() const { return count_ != 0; }

  std::optional<GapProof> result(bool proven) const {
    if (count_ == 0) return std::nullopt;
    GapProof answer = better_ && better_->low > best().low ? *better_ : best();
    if (!proven) return answer;
    answer.global = true;
    // The triangles have shown more than the best shows by itself, unless none was needed.
    if (nested_ && triangles_ != 0) {
      answer.high = std::max(answer.gap, std::nextafter(reference_ + above_, GapProof::kUnproven));
    }
    for (std::size_t i = 0; i < count_; ++i) {
      if (peaks_[i].needed) answer.high = std::max(answer.high, peaks_[i].proof.high);
    }
    return answer;
  }

 private:
  const GapProof& best() const { return peaks_[best_].proof; }

  /// Is the normal in the peak's cap?
  bool holds(const Peak& peak, const Vec3& v) const {
    const double c = v.dot(peak.proof.normal);
    if (!(peak.width > 0.0) || !(c > 0x1p-10)) return false;
    // Above 0 a cap is bounded by the tilt as well, |s|^2 <= 4 width: deep pairs have f < 0.
    const double most = kLess * (1.0 + 4.0 * peak.width) * c * c;
    if (!(peak.proof.high < 0.0) && !(nested_ && v.squaredNorm() < most)) return false;
    // |A's| <= width h_A at s = v/c - n, times c, less what rounding and slivers beside halved
    // sides may be off by.
    const auto reaches = [&](const Mat3& factor, const Vec3& stretched, const Ellipsoid& body) {
      const double off = kCapError * body.largest_semi_axis();
      const double across = (factor.transpose() * v - c * stretched).norm();
      return across + off <= c * peak.width * stretched.norm();
    };
    return reaches(factored_.factor_a(), peak.stretched_a, pair_.a) &&
           reaches(factored_.factor_b(), peak.stretched_b, pair_.b);
  }

  /// A cap is convex on the sphere, so its corners speak for a triangle.
  bool in_a_cap(const Triangle& t) {
    for (std::size_t i = 0; i < count_; ++i) {
      Peak& peak = peaks_[i];
      if (!holds(peak, t.corner[0]) || !holds(peak, t.corner[1]) || !holds(peak, t.corner[2]))
        continue;
      peak.needed = true;
      return true;
    }
    return false;
  }

  /// h_A(v) >= v.x for every point x of A: the support points of one normal bound f from above
  /// everywhere, by a linear function whose corners speak for a triangle where it is negative.
  bool below_best(const Triangle& t) {
    const Vec3 centre = (t.corner[0] + t.corner[1] + t.corner[2]).normalized();
    const Vec3 ya = factored_.factor_a().transpose() * centre;
    const Vec3 yb = factored_.factor_b().transpose() * centre;
    const Vec3 rest =
        pair_.d - factored_.factor_a() * (ya / ya.norm()) - factored_.factor_b() * (yb / yb.norm());
    if (climbs_into_a_cap(t, centre, rest.dot(centre))) return true;
    const double most =
        std::max({rest.dot(t.corner[0]), rest.dot(t.corner[1]), rest.dot(t.corner[2])});
    const double enough = best().gap - kPlaneError * size_;
    return most <= enough && enough < 0.0;
  }

  /// Does an ascent from the centre, where f is `value`, end at a maximum whose cap has the
  /// triangle? Only from where it promises a better one, or now and then.
  bool climbs_into_a_cap(const Triangle& t, const Vec3& centre, double value) {
    const bool better = value > best().gap + kTieOfSize * size_;
    if (!better && t.halvings != next_climb_) return false;
    if (t.halvings == next_climb_) next_climb_ += kGrace;
    climb(centre);
    return in_a_cap(t);
  }

  /// Of a clearance: f(-n) = f(n) - 2 n.d, so that where n.d < 0 all over a triangle the opposite
  /// one has the greater values.
  bool is_behind(const Triangle& t) const {
    const double least = -16.0 * kUnitRoundoff * pair_.d.norm();
    return std::ranges::all_of(t.corner, [&](const Vec3& v) { return v.dot(pair_.d) < least; });
  }

  /// For a clearance: is f nowhere above the best, or by no more than a slow search settles for?
  bool no_rise(const Triangle& t) {
    const Vec3 centre = (t.corner[0] + t.corner[1] + t.corner[2]).normalized();
    if (climbs_into_a_cap(t, centre, factored_.value(centre))) return true;
    // What is proven of the best, if that is near: no more can be shown near it.
    const double high = best().high;
    const bool near = high - best().gap <= kCoarse * size_;
    reference_ = std::max(reference_, near ? high : best().gap);
    if (below_by_planes(t, centre)) return true;
    const Chart<double, 3> rough(
        pair_.d, centre, t.corner,
        [&](const Vec3& v) -> Vec3 { return factored_.factor_a().transpose() * v; },
        [&](const Vec3& v) -> Vec3 { return factored_.factor_b().transpose() * v; });
    double rise = rough.excess(reference_, kChartNoise * size_);
    if (rise <= 0.0) return true;
    if (!(rise <= kDoubtful * size_)) return false;  // true for NaN
    const DoubleDoubleVector c = exactly(centre);
    const Chart<DoubleDouble, 3> chart(
        nested_->d, DoubleDouble(1.0) / length(c) * c,
        std::array{exactly(t.corner[0]), exactly(t.corner[1]), exactly(t.corner[2])}, nested_->a,
        nested_->b);
    if ((chart.at_centre() - DoubleDouble(reference_)).high > kFine * size_) improve(centre);
    rise = chart.excess(reference_, kChartNoiseInDoubleDouble * size_);
    const double wanted = triangles_ > kCoarseBudget ? kRough
                          : triangles_ > kFineBudget ? kCoarse
                                                     : kFine;
    if (!(rise <= wanted * size_)) return false;
    above_ = std::max(above_, rise);
    return true;
  }

  /// For a clearance below the best that is > 0: h_A(v) >= v.x for every point x of A, and h_B, as
  /// it is convex, is below the linear function of its values at the corners. So is f then, all
  /// over the triangle, if it is at them.
  bool below_by_planes(const Triangle& t, const Vec3& centre) const {
    const double enough = reference_ - kPlaneError * size_;
    if (!(enough < 0.0)) return false;
    std::array<double, 3> of_b, length;
    for (std::size_t i = 0; i < 3; ++i) {
      of_b[i] = (factored_.factor_b().transpose() * t.corner[i]).norm();
      length[i] = t.corner[i].norm();
    }
    const auto decides = [&](const Vec3& from) {
      const Vec3 y = factored_.factor_a().transpose() * from;
      const Vec3 rest = pair_.d - factored_.factor_a() * (y / y.norm());
      for (std::size_t i = 0; i < 3; ++i) {
        if (rest.dot(t.corner[i]) + of_b[i] > enough * length[i]) return false;
      }
      return true;
    };
    return decides(centre) || std::ranges::any_of(t.corner, decides);
  }

  /// What an ascent in double cannot tell from the best.
  void improve(const Vec3& normal) {
    const GapProof proof = prove_gap_in_double_double(pair_, normal, kCapWidth);
    if (better_ && proof.low <= better_->low) return;
    better_ = proof;
    reference_ = std::max(reference_, proof.gap);
  }

  /// In two at the middle of the side that is longest in the widths of both charts, so that
  /// triangles become as flat as bodies are. False where the middle has no exact doubles.
  bool split_exactly(const Triangle& t) {
    const Vec3 centre = t.corner[0] + t.corner[1] + t.corner[2];
    const double h2_a = (factored_.factor_a().transpose() * centre).squaredNorm();
    const double h2_b = (factored_.factor_b().transpose() * centre).squaredNorm();
    std::size_t longest = 0;
    double length = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 side = t.corner[(i + 1) % 3] - t.corner[i];
      const double along =
          std::max({side.squaredNorm() / centre.squaredNorm(),
                    (factored_.factor_a().transpose() * side).squaredNorm() / h2_a,
                    (factored_.factor_b().transpose() * side).squaredNorm() / h2_b});
      if (along > length) longest = i, length = along;
    }
    const std::size_t next = (longest + 1) % 3, last = (longest + 2) % 3;
    const Vec3 &from = t.corner[longest], &to = t.corner[next], sum = from + to;
    if (from != sum - to || to != sum - from) return false;
    const Vec3 middle = 0.5 * sum;
    pending_[waiting_++] = {{from, middle, t.corner[last]}, t.halvings + 1};
    pending_[waiting_++] = {{middle, to, t.corner[last]}, t.halvings + 1};
    return true;
  }

  void split(const Triangle& t) {
    std::size_t longest = 0;
    double length = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double side = (t.corner[(i + 1) % 3] - t.corner[i]).squaredNorm();
      if (side > length) longest = i, length = side;
    }
    const std::size_t next = (longest + 1) % 3, last = (longest + 2) % 3;
    const Vec3 middle = (t.corner[longest] + t.corner[next]).normalized();
    pending_[waiting_++] = {{t.corner[longest], middle, t.corner[last]}, t.halvings + 1};
    pending_[waiting_++] = {{middle, t.corner[next], t.corner[last]}, t.halvings + 1};
  }

  const Pair& pair_;
  const FactoredPair& factored_;
  double size_;
  std::optional<Nested> nested_;  ///< for a clearance
  // f is at most reference + above on triangles that are in no cap.
  double reference_ = -std::numeric_limits<double>::infinity(), above_ = 0.0;
  std::optional<GapProof> better_;  ///< than the best of the peaks, in double-double alone
  std::array<Peak, kMostPeaks> peaks_;
  std::size_t count_ = 0, best_ = 0;
  std::array<Triangle, kMostPending> pending_;
  std::size_t waiting_ = 0;
  int triangles_ = 0, next_climb_ = 8;
};

}  // namespace

std::optional<GapProof> search_sphere(const Pair& pair, const FactoredPair& factored,
                                      const Vec3& first, int budget) noexcept {
  SphereSearch search(pair, factored);
  search.climb(first);
  for (int i = 0; i < 6; ++i) search.climb(factored.axis(i));
  return search.result(search.found() && search.prove(budget));
}

}  // namespace tangency::inline v0::detail
