// SPDX-License-Identifier: MIT
#include <tangency/geometry/gap/search.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <tangency/geometry/gap/error_bounds.hpp>

namespace tangency::detail {
namespace {

constexpr std::size_t kMostPeaks = 16;     // chosen: 2 to 6 are common
constexpr std::size_t kMostPending = 256;  // four, and one more for each of some 220 halvings
constexpr double kCapError = 64 * kUnitRoundoff;  // section 5 of the derivation, of a semi-axis
constexpr int kGrace = 4;          // chosen: halvings between two ascents from a patch that stays
constexpr double kCapWidth = 1.0;  // chosen: caps as wide as the curvatures allow

/// A maximum, and the cap of normals around it in which its proof bounds f.
struct Peak {
  CapProof proof;
  Vec3 stretched_a, stretched_b;  ///< A' n
  double width;                   ///< of the cap; 0 where there is none
  bool needed = false;            ///< did a patch rest on this cap?
};

struct Triangle {
  std::array<Vec3, 3> corner;  ///< unit but for rounding
  int halvings;
};

class SphereSearch {
 public:
  SphereSearch(const Pair& pair, const FactoredPair& factored)
      : pair_(pair), factored_(factored), size_(pair.size) {}

  void climb(const Vec3& start) {
    const Stationary found = factored_.climb(start);
    if (!found.accepted || count_ == kMostPeaks) return;
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

  bool found() const { return count_ != 0; }

  std::optional<GapProof> result(bool proven) const {
    if (count_ == 0) return std::nullopt;
    GapProof answer = best();
    if (!proven) return answer;
    answer.global = true;
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
    // Above 0 a cap is bounded by the tilt as well: deep pairs have f < 0.
    if (!(peak.width > 0.0) || !(c > 0x1p-10) || !(peak.proof.high < 0.0)) return false;
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
    const bool better = rest.dot(centre) > best().gap + kTieOfSize * size_;
    if (better || t.halvings == next_climb_) {
      if (t.halvings == next_climb_) next_climb_ += kGrace;
      climb(centre);
      if (in_a_cap(t)) return true;
    }
    const double most =
        std::max({rest.dot(t.corner[0]), rest.dot(t.corner[1]), rest.dot(t.corner[2])});
    const double enough = best().gap - kPlaneError * size_;
    return most <= enough && enough < 0.0;
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

}  // namespace tangency::detail
