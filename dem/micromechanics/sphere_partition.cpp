// SPDX-License-Identifier: MIT
#include <tangency/dem/micromechanics/sphere_partition.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace tangency::inline v0::micromechanics {
namespace {

using std::numbers::pi;

constexpr int kMostPatches = 1000;           // chosen: 24 million classes
constexpr std::size_t kOctants = 8;          // of the signs of three components, one bit each
constexpr std::size_t kAllSigns = 7;         // the bits of every sign
constexpr double kLongestAngle = 0.25 * pi;  // of a face of the cube from its middle

/// Solid angle of the directions between the middle of a face and the angles u and v on it: of a
/// quadrangle of great circles.
double corner_area(double u, double v) { return std::asin(std::sin(u) * std::sin(v)); }

std::size_t to_class(double position, std::size_t count) {
  return std::min(static_cast<std::size_t>(std::max(position, 0.0)), count - 1);
}

}  // namespace

SpherePartition SpherePartition::near_uniform(int n) {
  if (n < 1 || n > kMostPatches)
    throw std::invalid_argument("near-uniform partition: n = " + std::to_string(n) +
                                ": must be 1 to " + std::to_string(kMostPatches));
  SpherePartition made;
  const std::size_t patches = made.patches_ = static_cast<std::size_t>(n);
  const auto angle = [&](double i) { return kLongestAngle * i / n; };
  for (int i = 0; i < n; ++i) made.tangents_.push_back(std::tan(angle(i)));
  const std::size_t classes = 3 * kOctants * patches * patches;
  made.area_.resize(classes);
  made.direction_.resize(classes);
  for (std::size_t g = 0; g < classes; ++g) {
    const auto i = static_cast<double>(g / patches % patches), j = static_cast<double>(g % patches);
    const std::size_t face = g / (patches * patches);
    const std::size_t signs = face % kOctants;
    const auto k = static_cast<Eigen::Index>(face / kOctants);
    made.area_[g] =
        (corner_area(angle(i + 1), angle(j + 1)) - corner_area(angle(i), angle(j + 1))) -
        (corner_area(angle(i + 1), angle(j)) - corner_area(angle(i), angle(j)));
    Vec3 n_mid;
    n_mid[k] = 1.0;
    n_mid[(k + 1) % 3] = std::tan(angle(i + 0.5));
    n_mid[(k + 2) % 3] = std::tan(angle(j + 0.5));
    for (std::size_t axis = 0; axis < 3; ++axis)
      if ((signs >> axis & 1U) != 0) n_mid[static_cast<Eigen::Index>(axis)] *= -1.0;
    made.direction_[g] = n_mid.normalized();
  }
  return made;
}

SpherePartition SpherePartition::polar(int rings, int sectors, const Vec3& axis) {
  if (rings < 1)
    throw std::invalid_argument("polar partition: rings = " + std::to_string(rings) +
                                ": must be at least 1");
  if (sectors < 2 || sectors % 2 != 0)
    throw std::invalid_argument("polar partition: sectors = " + std::to_string(sectors) +
                                ": must be even and at least 2");
  if (!(axis.norm() > 0.0) || !axis.allFinite())
    throw std::invalid_argument("polar partition: axis: must be finite and not 0");
  SpherePartition made;
  made.rings_ = static_cast<std::size_t>(rings);
  made.sectors_ = static_cast<std::size_t>(sectors);
  made.axis_ = axis.normalized();
  Eigen::Index largest = 0;
  made.axis_.cwiseAbs().maxCoeff(&largest);
  const Vec3 beside = Vec3::Unit((largest + 1) % 3);
  made.first_ = (beside - beside.dot(made.axis_) * made.axis_).normalized();
  made.second_ = made.axis_.cross(made.first_);
  made.area_.resize(made.rings_ * made.sectors_);
  made.direction_.resize(made.area_.size());
  const double step = pi / rings, turn = 2.0 * pi / sectors;
  for (std::size_t g = 0; g < made.area_.size(); ++g) {
    const auto ring = static_cast<double>(g / made.sectors_);
    const auto sector = static_cast<double>(g % made.sectors_);
    const double beta = (ring + 0.5) * step, alpha = (sector + 0.5) * turn;
    // cos(beta - step/2) - cos(beta + step/2), without cancellation
    made.area_[g] = 2.0 * std::sin(beta) * std::sin(0.5 * step) * turn;
    made.direction_[g] =
        std::cos(beta) * made.axis_ +
        std::sin(beta) * (std::cos(alpha) * made.first_ + std::sin(alpha) * made.second_);
    const std::size_t mirror = made.opposite(g);
    if (mirror < g) made.direction_[g] = -made.direction_[mirror];
  }
  return made;
}

std::size_t SpherePartition::opposite(std::size_t g) const {
  if (patches_ > 0) {
    const std::size_t face = patches_ * patches_;
    return ((g / face) ^ kAllSigns) * face + g % face;
  }
  return (rings_ - 1 - g / sectors_) * sectors_ + (g + sectors_ / 2) % sectors_;
}

std::size_t SpherePartition::class_of(const Vec3& n) const {
  return patches_ > 0 ? cube_class(n) : ring_class(n);
}

std::size_t SpherePartition::cube_class(const Vec3& n) const {
  Eigen::Index k = 0;
  const double most = n.cwiseAbs().maxCoeff(&k);
  if (n[k] < 0.0) return opposite(cube_class(-n));
  const auto patch = [&](Eigen::Index axis) {
    const double along = std::abs(n[axis]);
    std::size_t at =
        to_class(std::atan2(along, most) / kLongestAngle * static_cast<double>(patches_), patches_);
    // The angle is rounded; the edges' tangents decide.
    while (at + 1 < patches_ && along >= most * tangents_[at + 1]) ++at;
    while (at > 0 && along < most * tangents_[at]) --at;
    return at;
  };
  std::size_t signs = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (n[static_cast<Eigen::Index>(axis)] < 0.0) signs |= std::size_t{1} << axis;
  const std::size_t face = static_cast<std::size_t>(k) * kOctants + signs;
  return (face * patches_ + patch((k + 1) % 3)) * patches_ + patch((k + 2) % 3);
}

std::size_t SpherePartition::ring_class(const Vec3& n) const {
  const double along = n.dot(axis_), x = n.dot(first_), y = n.dot(second_);
  const bool mirrored = along < 0.0 || (along == 0.0 && (y < 0.0 || (y == 0.0 && x < 0.0)));
  if (mirrored) return opposite(ring_class(-n));
  const double beta = std::atan2(std::hypot(x, y), along);
  double alpha = std::atan2(y, x);
  if (alpha < 0.0) alpha += 2.0 * pi;
  const auto rings = static_cast<double>(rings_), sectors = static_cast<double>(sectors_);
  return to_class(beta / pi * rings, rings_) * sectors_ +
         to_class(alpha / (2.0 * pi) * sectors, sectors_);
}

}  // namespace tangency::inline v0::micromechanics
