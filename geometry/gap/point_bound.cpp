// SPDX-License-Identifier: MIT
#include <tangency/geometry/gap/point_bound.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <tangency/geometry/bodies/surface_projection.hpp>

namespace tangency::inline v0::detail {
namespace {

constexpr int kPoints = 4;  // from each body; measured: 16 settle one pair of a hundred more
// (D), of |distance| and of the largest semi-axis over u, and of the size.
constexpr double kOfDistance = 4.0, kOfAxis = 2.0, kOfSize = 0x1p-78;

struct Nearest {
  double high;  ///< the distance with its error: no gap is above it
  Vec3 arm;     ///< of the point of `other`, from its centre
};

/// @param arm   of a point of `body`, from its centre
/// @param from  the centre of `other` from that of `body`: this times pair.d
Nearest nearest_to(const Pair& pair, const Ellipsoid& body, const Ellipsoid& other, const Vec3& arm,
                   double from) noexcept {
  DoubleDoubleVector point;  // from the centre of `other`
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<int>(i);
    point[i] = DoubleDouble(arm[k]) - DoubleDouble(from * pair.d[k], from * pair.d_low[k]);
  }
  const SeenFromCentre seen = seen_from_centre(other, point);
  const ClosestOnSurface found = closest_on_surface(other, seen);
  const double distance = scaled_by_power(found.distance, seen.exponent).high;
  const double error =
      kUnitRoundoff * (kOfDistance * std::abs(distance) + kOfAxis * body.largest_semi_axis());
  return {distance + (error + kOfSize * pair.size), found.arm};
}

}  // namespace

void bound_by_points(const Pair& pair, double enough, GapProof& proof) noexcept {
  for (const bool first_of_a : {true, false}) {
    bool of_a = first_of_a;
    Vec3 arm = of_a ? proof.arm_a : proof.arm_b;
    for (int k = 0; k < kPoints && proof.high - proof.low > enough; ++k, of_a = !of_a) {
      const Nearest nearest = of_a ? nearest_to(pair, pair.a, pair.b, arm, 1.0)
                                   : nearest_to(pair, pair.b, pair.a, arm, -1.0);
      proof.high = std::min(proof.high, nearest.high);
      arm = nearest.arm;
    }
  }
  proof.gap = std::min(proof.gap, proof.high);
}

}  // namespace tangency::inline v0::detail
