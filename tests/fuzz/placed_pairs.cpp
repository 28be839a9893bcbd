// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/tests/fuzz/placed_pairs.hpp>

#include <cmath>
#include <limits>

#include <tangency/tests/fuzz/mutate.hpp>

namespace tangency::testing::fuzz {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Roundings, in units of 2^-53 of the lengths that they are of: a product of a matrix and a
// vector, twice, a length and two sums are below it; chosen twice as large.
constexpr double kRounded = 64 * 0x1p-53;
constexpr std::size_t kKinds = 8192, kTouches = kKinds / 2048;
// Long bodies, and those beyond Ellipsoid::moderate(), take ten times as long as others: one that
// is drawn is most often drawn again, so that others are in most pairs unless there are none.
constexpr double kLong = 256;
constexpr std::size_t kSlowOneIn = 16;

/// In [0, 1).
double part(std::uint64_t& state) {
  return std::ldexp(static_cast<double>(next(state) >> 11), -53);
}

/// 2^-least to 2^-most, each power of two as often.
double magnitude(std::uint64_t& state, int least, int most) {
  const auto steps = static_cast<std::size_t>(most - least);
  return std::ldexp(1 + part(state), -least - 1 - static_cast<int>(below(state, steps)));
}

Vec3 support_point(const Ellipsoid& body, const Vec3& n) {
  const Vec3& r = body.semi_axes();
  const Vec3 y = r.cwiseProduct(body.rotation().transpose() * n);
  return body.rotation() * r.cwiseProduct(y / y.norm());
}

}  // namespace

bool PlacedPairs::takes(const Ellipsoid& body) {
  return body.smallest_semi_axis() >= 0x1p-300 && body.largest_semi_axis() <= 0x1p300 &&
         body.largest_semi_axis() <= 0x1p40 * body.smallest_semi_axis();
}

PlacedPairs::PlacedPairs(std::span<const Ellipsoid> bodies, std::uint64_t seed) : state_(seed) {
  for (Vec3& normal : normals_) normal = drawn_normal(bodies);
  for (const Ellipsoid& body : bodies) {
    for (const Vec3& normal : normals_) points_.push_back(support_point(body, normal));
    const double largest = body.largest_semi_axis(), smallest = body.smallest_semi_axis();
    sizes_.push_back({largest, body.least_radius(), largest * (largest / smallest),
                      largest > kLong * smallest || !body.moderate()});
  }
}

/// Any direction, an axis of space or of a body, or as good as one.
Vec3 PlacedPairs::drawn_normal(std::span<const Ellipsoid> bodies) {
  Vec3 normal(part(state_) - 0.5, part(state_) - 0.5, part(state_) - 0.5);
  const auto axis = static_cast<Eigen::Index>(below(state_, 3));
  switch (below(state_, 4)) {
    case 0:
      normal = Vec3::Unit(axis);
      break;
    case 1:
      normal = bodies[below(state_, bodies.size())].rotation().col(axis);
      break;
    case 2:
      normal = magnitude(state_, 1, 52) * normal +
               bodies[below(state_, bodies.size())].rotation().col(axis);
      break;
    default:
      break;
  }
  if (normal.norm() < 0x1p-10) normal = Vec3::Unit(axis);
  return (below(state_, 2) == 0 ? 1 : -1) * normal.normalized();
}

PlacedPairs::Depth PlacedPairs::drawn_gap(double size, double rho) {
  const std::size_t kind = below(state_, kKinds);
  if (kind == 0) return {-rho - size * magnitude(state_, 1, 20), false};
  if (kind <= kTouches)
    return {(static_cast<double>(below(state_, 17)) - 8) * 0x1p-53 * size, true};
  switch (kind % 8) {
    case 0:
      return {size * magnitude(state_, -20, 0), true};
    case 1:
    case 2:
    case 3:
      return {size * magnitude(state_, 0, 32), true};
    default:
      return {-0.9 * rho * magnitude(state_, 0, 16), true};
  }
}

std::size_t PlacedPairs::drawn_body() {
  std::size_t body = below(state_, sizes_.size());
  for (std::size_t k = 1; k < kSlowOneIn && sizes_[body].is_slow; ++k)
    body = below(state_, sizes_.size());
  return body;
}

PlacedPair PlacedPairs::draw() {
  const std::size_t a = drawn_body(), b = drawn_body();
  const std::size_t k = below(state_, kNormals);
  const double size = sizes_[a].largest + sizes_[b].largest;
  const double rho = sizes_[a].radius + sizes_[b].radius;
  const Depth depth = drawn_gap(size, rho);
  const Vec3 points = points_[a * kNormals + k] + points_[b * kNormals + k];
  PlacedPair pair{{static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)},
                  points + depth.gap * normals_[k],
                  normals_[k],
                  {}};
  const double low = kRounded * (size + std::abs(depth.gap));
  // Above 0 a point off its place along its surface changes nothing, below it may.
  const double high = depth.gap >= 0 ? low : kRounded * (sizes_[a].unsure + sizes_[b].unsure);
  const bool is_known = depth.is_known && (depth.gap >= 0 || depth.gap - 2 * high > -rho);
  pair.gap = enclosure_of(depth.gap, low, is_known ? high : kInfinity);
  return pair;
}

}  // namespace tangency::testing::fuzz
