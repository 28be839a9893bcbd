// SPDX-License-Identifier: MIT
#include <tangency/geometry/lattice.hpp>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include <tangency/geometry/floating_point.hpp>
#include <tangency/geometry/numbers/double_double.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>

namespace tangency::inline v0 {
namespace {

/// A sum of doubles, and how far it may be from that of the numbers that were added.
struct TrackedSum {
  double value = 0.0;
  double error = 0.0;

  void add(double term) {
    const detail::DoubleDouble sum = detail::two_sum(value, term);
    value = sum.high;
    error += std::abs(sum.low);
  }
  void add_product(double edge, std::int32_t times) {
    const double product = edge * times;
    // By a power of two nothing is rounded, whatever the edge is.
    if (!std::has_single_bit(static_cast<std::uint32_t>(std::abs(std::int64_t{times}))))
      error += kUnitRoundoff * std::abs(product) + std::numeric_limits<double>::denorm_min();
    add(product);
  }
};

ImageSeparation separation_here(const Vec3& centre_a, const Vec3& centre_b, const Mat3& edges,
                                const LatticeImage& image) {
  ImageSeparation found{Vec3::Zero(), 0.0};
  for (int i = 0; i < 3; ++i) {
    TrackedSum sum{centre_b[i], 0.0};
    sum.add(-centre_a[i]);
    for (int k = 0; k < 3; ++k) {
      const std::int32_t times = image[static_cast<std::size_t>(k)];
      if (times != 0) sum.add_product(edges(i, k), times);
    }
    found.vector[i] = sum.value;
    found.error += sum.error;
  }
  found.error *= 1.0 + 0x1p-48;  // for the sums of the errors
  return found;
}

}  // namespace

ImageSeparation separation(const Vec3& centre_a, const Vec3& centre_b, const Mat3& edges,
                           const LatticeImage& image) noexcept {
  return in_default_environment([&] {
    ImageSeparation found = separation_here(centre_a, centre_b, edges, image);
    if (found.vector.allFinite() && std::isfinite(found.error)) return found;
    // Terms that overflow on the way: in a unit that has room for four of them, 2^31 times an edge.
    constexpr double kSmall = 0x1p-40, kMost = std::numeric_limits<double>::max();
    found = separation_here(kSmall * centre_a, kSmall * centre_b, kSmall * edges, image);
    const Vec3 vector = (found.vector / kSmall).cwiseMin(kMost).cwiseMax(-kMost);
    // Scaling down rounds numbers below 2^-982.
    const bool in_range = kSmall * vector == found.vector;
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    return ImageSeparation{vector, in_range ? found.error / kSmall + 0x1p-990 : kInfinite};
  });
}

}  // namespace tangency::inline v0
