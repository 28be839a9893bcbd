// SPDX-License-Identifier: MIT
/// @file
/// Numbers of advice: two digits, rounded to the safe side.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// A number, two digits of it left, its size rounded by std::floor or std::ceil.
inline double two_digits(double x, double (*round)(double)) {
  if (x == 0.0 || !std::isfinite(x)) return 0.0;
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(x))) - 1.0);
  return std::copysign(round(std::abs(x) / unit * (1.0 - 1e-12)) * unit, x);
}

inline std::string rounded_down(double x) {
  return tables::rounded_text(two_digits(x, std::floor), 2);
}
inline std::string rounded_up(double x) {
  return tables::rounded_text(two_digits(x, std::ceil), 2);
}
/// Of what is not below `least`.
inline std::string rounded_down_from(double least, double x) {
  return tables::rounded_text(std::max(least, two_digits(x, std::floor)), 2);
}
/// An integer's text, without an exponent.
inline std::string whole_up(double x) {
  return tables::rounded_text(std::round(two_digits(std::ceil(x), std::ceil)), 17);
}
/// "[ 0.1, 0, -0.2 ]", as in a scene.
inline std::string rounded_down(const Vec3& v) {
  return "[ " + rounded_down(v[0]) + ", " + rounded_down(v[1]) + ", " + rounded_down(v[2]) + " ]";
}

}  // namespace tangency::inline v0::dem
