// SPDX-License-Identifier: MIT
#include <tangency/geometry/ellipsoid.hpp>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>

#include <tangency/geometry/numbers/double_double.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/power_of_two.hpp>

namespace tangency::inline v0 {
namespace {

std::string describe(const EllipsoidFault& fault) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, fault.value).ptr;
  return std::string(fault.field) + " = " + std::string(digits, end) + ": " + fault.rule;
}

/// R diag(e) R'
Symmetric3 with_eigenvalues(const Mat3& r, const Vec3& e) {
  const auto entry = [&](int i, int j) {
    return r(i, 0) * e[0] * r(j, 0) + r(i, 1) * e[1] * r(j, 1) + r(i, 2) * e[2] * r(j, 2);
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(1, 2), entry(2, 0), entry(0, 1)};
}

// docs/derivations/bounding-box.md: the most that one operation errs relative to its result, what
// roots of the stored shape are off, and entries of the rotation, over the largest semi-axis.
constexpr double kEpsilon = 0x1p-52, kOfRoot = 10 * kEpsilon, kOfEntry = 0x1p-93;

/// h(e_i) = sqrt(M_ii), outwards by more than its rounding.
Vec3 beyond_roots(const Symmetric3& m) {
  const Vec3 root = Vec3(m.xx, m.yy, m.zz).cwiseSqrt();
  return root + kOfRoot * root;
}

/// Where squares of semi-axes leave the range of doubles. Apart from the others, whose box costs
/// what its arithmetic costs.
[[gnu::noinline, gnu::cold]] Vec3 half_widths_by_own_unit(const Ellipsoid& e) {
  const int power = exponent_of(e.largest_semi_axis());
  const Vec3 axes = scaled_by_power(e.semi_axes(), -power);
  const Vec3 unit = beyond_roots(with_eigenvalues(e.rotation(), axes.cwiseAbs2()));
  return unit.unaryExpr([power](double h) {
    return scaled_by_power(h + 2.0 * kOfEntry, power) + std::numeric_limits<double>::denorm_min();
  });
}

}  // namespace

InvalidEllipsoid::InvalidEllipsoid(const EllipsoidFault& fault)
    : std::invalid_argument(describe(fault)), fault_(fault) {}

std::optional<EllipsoidFault> Ellipsoid::find_fault(const Vec3& centre, const Vec3& semi_axes,
                                                    const Quaternion& orientation) noexcept {
  static constexpr const char* kCentre[] = {"x", "y", "z"};
  static constexpr const char* kAxes[] = {"r1", "r2", "r3"};
  static constexpr const char* kOrientation[] = {"qw", "qx", "qy", "qz"};
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(centre[i])) {
      return EllipsoidFault{kCentre[i], centre[i], "a centre must be finite"};
    }
  }
  for (int i = 0; i < 3; ++i) {
    // By bits: under DAZ a subnormal semi-axis would compare equal to 0.
    if (!std::isfinite(semi_axes[i]) || std::signbit(semi_axes[i]) || is_zero(semi_axes[i])) {
      return EllipsoidFault{kAxes[i], semi_axes[i], "a semi-axis must be finite and > 0"};
    }
  }
  const double q[] = {orientation.w(), orientation.x(), orientation.y(), orientation.z()};
  constexpr const char* rule = "an orientation must be finite and not all 0";
  for (int i = 0; i < 4; ++i) {
    if (!std::isfinite(q[i])) return EllipsoidFault{kOrientation[i], q[i], rule};
  }
  if (is_zero(q[0]) && is_zero(q[1]) && is_zero(q[2]) && is_zero(q[3])) {
    return EllipsoidFault{"qw", q[0], rule};
  }
  return std::nullopt;
}

Mat3 rotation_of(const Quaternion& q) noexcept {
  const detail::DoubleDoubleMatrix r =
      in_default_environment([&] { return detail::double_double_rotation(q); });
  Mat3 rounded;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      rounded(i, j) = r[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)].high;
    }
  }
  return rounded;
}

Ellipsoid::Ellipsoid(const Vec3& centre, const Vec3& semi_axes, const Quaternion& orientation)
    : centre_(centre), semi_axes_(semi_axes), orientation_(orientation) {
  if (const auto fault = find_fault(centre, semi_axes, orientation)) throw InvalidEllipsoid(*fault);
  in_default_environment([&] {
    rotation_ = rotation_of(orientation);
    const Vec3 a2 = semi_axes.cwiseAbs2();
    shape_ = with_eigenvalues(rotation_, a2);
    shape_adjugate_ = with_eigenvalues(rotation_, {a2[1] * a2[2], a2[2] * a2[0], a2[0] * a2[1]});
    shape_determinant_ = a2[0] * a2[1] * a2[2];
    largest_ = semi_axes.maxCoeff();
    smallest_ = semi_axes.minCoeff();
    least_radius_ = smallest_ * (smallest_ / largest_);
    is_sphere_ = semi_axes[0] == semi_axes[1] && semi_axes[1] == semi_axes[2];
    moderate_ = largest_ <= detail::kLargestModerate && smallest_ >= detail::kSmallestModerate;
  });
}

Ellipsoid Ellipsoid::moved_to(const Vec3& centre) const noexcept {
  assert(centre.allFinite());
  Ellipsoid moved = *this;
  moved.centre_ = centre;
  return moved;
}

double Ellipsoid::support(const Vec3& n) const noexcept {
  return in_default_environment(
      [&] { return semi_axes_.cwiseProduct(rotation_.transpose() * n).stableNorm(); });
}

Vec3 Ellipsoid::support_point(const Vec3& n) const noexcept {
  return in_default_environment([&]() -> Vec3 {
    assert(n != Vec3::Zero());
    const Vec3 y = semi_axes_.cwiseProduct(rotation_.transpose() * n);
    const Vec3 unit = (y / y.cwiseAbs().maxCoeff()).normalized();
    return rotation_ * semi_axes_.cwiseProduct(unit);
  });
}

double Ellipsoid::level(const Vec3& point) const noexcept {
  return in_default_environment([&] {
    return (rotation_.transpose() * (point - centre_)).cwiseQuotient(semi_axes_).squaredNorm();
  });
}

Eigen::AlignedBox3d Ellipsoid::bounding_box() const noexcept {
  return in_default_environment([&]() -> Eigen::AlignedBox3d {
    Vec3 half = moderate_ ? Vec3(beyond_roots(shape_) + Vec3::Constant(kOfEntry * largest_))
                          : half_widths_by_own_unit(*this);
    half += 2.0 * kEpsilon * centre_.cwiseAbs();
    return {centre_ - half, centre_ + half};
  });
}

}  // namespace tangency::inline v0
