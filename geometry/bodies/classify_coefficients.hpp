// SPDX-License-Identifier: MIT
/// @file
/// The ladder of tiers of classify(), from coefficients: what Quadric itself may ask. Internal.
///
/// The proof of every claim about the filter is docs/derivations/classification-filter.md. It
/// assumes of each operation only a relative error of at most 2^-52, which all four rounding modes
/// keep, and the range check leaves no operation a subnormal operand or result; so the filter is
/// valid in every floating-point environment and asks for none.
#pragma once

#include <array>
#include <optional>

#include <tangency/geometry/quadric_type.hpp>

namespace tangency::inline v0::detail {

/// The type of the quadric with these coefficients. Requires finite ones. As classify().
Classification classify_coefficients(const QuadricCoefficients& coefficients) noexcept;

}  // namespace tangency::inline v0::detail

namespace tangency::inline v0::filter {

/// A computed value with the sum of the absolute values of its monomials, computed alike.
struct Estimate {
  double value;
  double magnitude;
};

/// |value - true value| <= factor * magnitude, with the product as it is computed.
inline constexpr double kMinor2Factor = 3 * 0x1p-52;
inline constexpr double kT3Factor = 6 * 0x1p-52;
inline constexpr double kD4Factor = 9 * 0x1p-52;

/// The determinants that decide: of the leading 2 x 2 block, of Q_s and of Q.
struct Determinants {
  Estimate minor2;
  Estimate t3;
  Estimate d4;
};

/// The coefficients multiplied by a power of two such that the magnitude of each one that is not
/// zero lies in [2^-200, 2^201), read and scaled by their bits; nothing where a coefficient is
/// subnormal or their exponents span more than 400.
std::optional<QuadricCoefficients> in_range(const QuadricCoefficients& coefficients) noexcept;

/// Requires coefficients in that range.
Determinants determinants(const QuadricCoefficients& coefficients) noexcept;

/// The type of a quadric whose Q and Q_s are both regular, that is rank4 = 4 and rank3 = 3; nothing
/// where the estimates do not prove that.
std::optional<QuadricType> regular_type(const QuadricCoefficients& coefficients) noexcept;

}  // namespace tangency::inline v0::filter
