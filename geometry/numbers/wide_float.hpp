// SPDX-License-Identifier: MIT
/// @file
/// Floating-point numbers of 512 bits in integer arithmetic (GMP's mpn layer), for what
/// double-double cannot tell. Internal (GMP).
///
/// No operation allocates or reads the floating-point environment; the exponent does not overflow
/// within reach of what doubles start from. Every result is truncated: product, quotient and root
/// are within kWideEpsilon of themselves, sum and difference within that of the sum of the absolute
/// values of the operands.
#pragma once

#include <gmp.h>

#include <array>
#include <cstdint>

#include <tangency/geometry/numbers/vector3.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::detail {

inline constexpr double kWideEpsilon = 0x1p-510;

class WideFloat {
 public:
  WideFloat() = default;                      ///< 0
  WideFloat(double v) noexcept;               // NOLINT: exact, so implicit. Requires a finite value
  explicit operator double() const noexcept;  ///< the nearest; infinite beyond their range

  bool is_zero() const noexcept { return limbs_[kLimbs - 1] == 0; }
  bool negative() const noexcept { return negative_; }
  /// e with 2^e <= |value| < 2^(e+1). Requires a value other than 0.
  long exponent() const noexcept { return exponent_ - 1; }
  WideFloat scaled(long power) const noexcept;  ///< times 2^power

  WideFloat operator-() const noexcept;
  friend WideFloat operator+(const WideFloat& a, const WideFloat& b) noexcept;
  friend WideFloat operator-(const WideFloat& a, const WideFloat& b) noexcept { return a + -b; }
  friend WideFloat operator*(const WideFloat& a, const WideFloat& b) noexcept;
  friend WideFloat operator/(const WideFloat& a, const WideFloat& b) noexcept;  ///< requires b != 0
  friend WideFloat sqrt(const WideFloat& a) noexcept;                           ///< 0 for a <= 0
  friend bool operator<(const WideFloat& a, const WideFloat& b) noexcept {
    return (a - b).negative_;
  }

 private:
  static_assert(GMP_NAIL_BITS == 0 && 512 % GMP_LIMB_BITS == 0,
                "limbs are full, and make 512 bits");
  static constexpr int kLimbs = 512 / GMP_LIMB_BITS;
  static constexpr int kTopLimbs = 64 / GMP_LIMB_BITS;  ///< that make the highest 64 bits

  std::uint64_t top() const noexcept;  ///< the highest 64 bits
  void set_top(std::uint64_t bits) noexcept;

  /// Shifts a mantissa that is not 0 until its highest bit is set.
  void normalise() noexcept;

  // (-1)^negative times the limbs, lowest first, as a number in [1/2, 1), times 2^exponent.
  std::array<mp_limb_t, kLimbs> limbs_{};
  long exponent_ = 0;
  bool negative_ = false;
};

inline WideFloat abs(const WideFloat& a) noexcept { return a.negative() ? -a : a; }

/// Times 2^power.
inline WideFloat scaled_by_power(const WideFloat& a, long power) noexcept {
  return a.scaled(power);
}

using WideVector = Vector3<WideFloat>;
using WideMatrix = Matrix3<WideFloat>;

/// R(q/|q|), each entry within 20 units of kWideEpsilon.
WideMatrix wide_rotation(const Quaternion& q) noexcept;

inline Vec3 rounded(const WideVector& v) noexcept {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

}  // namespace tangency::inline v0::detail
