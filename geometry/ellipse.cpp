// SPDX-License-Identifier: MIT
#include <tangency/geometry/ellipse.hpp>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <string>

#include <tangency/geometry/numbers/cosine_sine.hpp>
#include <tangency/geometry/numbers/double_double.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/power_of_two.hpp>

namespace tangency::inline v0 {
namespace {

constexpr double kPi = 0x1.921fb54442d18p+1;

std::string describe(const EllipseFault& fault) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, fault.value).ptr;
  return std::string(fault.field) + " = " + std::string(digits, end) + ": " + fault.rule;
}

Vec2 direction_of(double angle) {
  if (!std::isfinite(angle)) {
    throw InvalidEllipse({"angle", angle, "an angle must be finite"});
  }
  const detail::CosineSine found =
      in_default_environment([&] { return detail::rounded_cosine_sine(angle); });
  return {found.cosine, found.sine};
}

}  // namespace

InvalidEllipse::InvalidEllipse(const EllipseFault& fault)
    : std::invalid_argument(describe(fault)), fault_(fault) {}

std::optional<EllipseFault> Ellipse::find_fault(const Vec2& centre, const Vec2& semi_axes,
                                                const Vec2& direction) noexcept {
  static constexpr const char* kCentre[] = {"x", "y"};
  static constexpr const char* kAxes[] = {"r1", "r2"};
  static constexpr const char* kDirection[] = {"ux", "uy"};
  for (int i = 0; i < 2; ++i) {
    if (!std::isfinite(centre[i])) {
      return EllipseFault{kCentre[i], centre[i], "a centre must be finite"};
    }
  }
  for (int i = 0; i < 2; ++i) {
    // By bits: under DAZ a subnormal semi-axis would compare equal to 0.
    if (!std::isfinite(semi_axes[i]) || std::signbit(semi_axes[i]) || is_zero(semi_axes[i])) {
      return EllipseFault{kAxes[i], semi_axes[i], "a semi-axis must be finite and > 0"};
    }
  }
  constexpr const char* rule = "a direction must be finite and not both 0";
  for (int i = 0; i < 2; ++i) {
    if (!std::isfinite(direction[i])) return EllipseFault{kDirection[i], direction[i], rule};
  }
  if (is_zero(direction[0]) && is_zero(direction[1])) {
    return EllipseFault{"ux", direction[0], rule};
  }
  return std::nullopt;
}

Ellipse::Ellipse(const Vec2& centre, const Vec2& semi_axes, const Vec2& direction)
    : centre_(centre), semi_axes_(semi_axes), direction_(direction) {
  if (const auto fault = find_fault(centre, semi_axes, direction)) throw InvalidEllipse(*fault);
  axis_ = in_default_environment(
      [&] { return detail::rounded(detail::double_double_direction(direction)); });
}

Ellipse Ellipse::at_angle(const Vec2& centre, const Vec2& semi_axes, double angle) {
  return {centre, semi_axes, direction_of(angle)};
}

double Ellipse::area() const noexcept {
  return in_default_environment([&] { return kPi * semi_axes_[0] * semi_axes_[1]; });
}

Ellipse Ellipse::moved_to(const Vec2& centre) const noexcept {
  assert(centre.allFinite());
  Ellipse moved = *this;
  moved.centre_ = centre;
  return moved;
}

double Ellipse::support(const Vec2& n) const noexcept {
  return in_default_environment(
      [&] { return semi_axes_.cwiseProduct(turned_back(axis_, n)).stableNorm(); });
}

Vec2 Ellipse::support_point(const Vec2& n) const noexcept {
  return in_default_environment([&]() -> Vec2 {
    assert(n != Vec2::Zero());
    const Vec2 y = semi_axes_.cwiseProduct(turned_back(axis_, n));
    const Vec2 unit = (y / y.cwiseAbs().maxCoeff()).normalized();
    return turned(axis_, semi_axes_.cwiseProduct(unit));
  });
}

double Ellipse::level(const Vec2& point) const noexcept {
  return in_default_environment(
      [&] { return turned_back(axis_, point - centre_).cwiseQuotient(semi_axes_).squaredNorm(); });
}

}  // namespace tangency::inline v0
