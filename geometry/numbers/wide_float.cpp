// SPDX-License-Identifier: MIT
#include <tangency/geometry/numbers/wide_float.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <tangency/geometry/power_of_two.hpp>

namespace tangency::inline v0::detail {
namespace {

constexpr int kLimbBits = GMP_LIMB_BITS;
constexpr mp_limb_t kTop = mp_limb_t{1} << (kLimbBits - 1);
constexpr int kDigits = std::numeric_limits<double>::digits;

}  // namespace

std::uint64_t WideFloat::top() const noexcept {
  std::uint64_t bits = 0;
  for (int i = 0; i < kTopLimbs; ++i) {
    const auto limb = static_cast<std::size_t>(kLimbs - 1 - i);
    bits |= std::uint64_t{limbs_[limb]} << (64 - (i + 1) * kLimbBits);
  }
  return bits;
}

void WideFloat::set_top(std::uint64_t bits) noexcept {
  for (int i = 0; i < kTopLimbs; ++i) {
    const auto limb = static_cast<std::size_t>(kLimbs - 1 - i);
    limbs_[limb] = static_cast<mp_limb_t>(bits >> (64 - (i + 1) * kLimbBits));
  }
}

WideFloat::WideFloat(double v) noexcept : negative_(std::signbit(v)) {
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(v) & ~(std::uint64_t{1} << 63);
  if (bits == 0) {
    negative_ = false;
    return;
  }
  // By bits, so that a subnormal number is what it is under DAZ too.
  constexpr std::uint64_t kHidden = std::uint64_t{1} << (kDigits - 1);
  const std::uint64_t fraction = bits & (kHidden - 1);
  const std::uint64_t mantissa = bits >= kHidden ? kHidden | fraction : fraction;
  set_top(mantissa << std::countl_zero(mantissa));
  exponent_ = exponent_of(v) + 1;
}

WideFloat::operator double() const noexcept {
  if (is_zero()) return 0.0;
  constexpr int kDropped = 64 - kDigits;
  const std::uint64_t highest = top();
  // At most 2^53, and so a double, whatever the rounding mode.
  const std::uint64_t kept = (highest >> kDropped) + ((highest >> (kDropped - 1)) & 1);
  constexpr long kBeyond = 2000;  // an exponent that no double has
  const long power = std::clamp(exponent_, -kBeyond, kBeyond) - kDigits;
  const double value = std::scalbn(static_cast<double>(kept), static_cast<int>(power));
  return negative_ ? -value : value;
}

void WideFloat::normalise() noexcept {
  int empty = 0;
  while (limbs_[static_cast<std::size_t>(kLimbs - 1 - empty)] == 0) ++empty;
  if (empty > 0) {
    std::copy_backward(limbs_.begin(), limbs_.end() - empty, limbs_.end());
    std::fill_n(limbs_.begin(), empty, 0);
  }
  const int bits = std::countl_zero(limbs_[kLimbs - 1]);
  if (bits > 0) mpn_lshift(limbs_.data(), limbs_.data(), kLimbs, static_cast<unsigned>(bits));
  exponent_ -= kLimbBits * empty + bits;
}

WideFloat WideFloat::scaled(long power) const noexcept {
  WideFloat result = *this;
  result.exponent_ += power;
  return result;
}

WideFloat WideFloat::operator-() const noexcept {
  WideFloat result = *this;
  result.negative_ = !is_zero() && !negative_;
  return result;
}

WideFloat operator+(const WideFloat& a, const WideFloat& b) noexcept {
  if (b.is_zero()) return a;
  if (a.is_zero()) return b;
  const WideFloat &large = a.exponent_ >= b.exponent_ ? a : b, &small = &large == &a ? b : a;
  const long shift = large.exponent_ - small.exponent_;
  if (shift >= WideFloat::kLimbs * kLimbBits) return large;
  std::array<mp_limb_t, WideFloat::kLimbs> aligned{};
  const long limbs = shift / kLimbBits;
  std::copy(small.limbs_.begin() + limbs, small.limbs_.end(), aligned.begin());
  if (const auto bits = static_cast<unsigned>(shift % kLimbBits); bits != 0) {
    mpn_rshift(aligned.data(), aligned.data(), WideFloat::kLimbs, bits);
  }
  WideFloat sum = large;
  mp_limb_t* const to = sum.limbs_.data();
  if (large.negative_ == small.negative_) {
    if (mpn_add_n(to, to, aligned.data(), WideFloat::kLimbs) != 0) {
      mpn_rshift(to, to, WideFloat::kLimbs, 1);
      to[WideFloat::kLimbs - 1] |= kTop;
      ++sum.exponent_;
    }
    return sum;
  }
  const int order = mpn_cmp(to, aligned.data(), WideFloat::kLimbs);
  if (order == 0) return {};
  if (order > 0) {
    mpn_sub_n(to, to, aligned.data(), WideFloat::kLimbs);
  } else {
    mpn_sub_n(to, aligned.data(), to, WideFloat::kLimbs);
    sum.negative_ = small.negative_;
  }
  sum.normalise();
  return sum;
}

WideFloat operator*(const WideFloat& a, const WideFloat& b) noexcept {
  if (a.is_zero() || b.is_zero()) return {};
  std::array<mp_limb_t, 2 * WideFloat::kLimbs> product;
  mpn_mul_n(product.data(), a.limbs_.data(), b.limbs_.data(), WideFloat::kLimbs);
  WideFloat result;
  result.negative_ = a.negative_ != b.negative_;
  result.exponent_ = a.exponent_ + b.exponent_;
  if ((product.back() & kTop) == 0) {
    mpn_lshift(product.data(), product.data(), 2 * WideFloat::kLimbs, 1);
    --result.exponent_;
  }
  std::copy(product.begin() + WideFloat::kLimbs, product.end(), result.limbs_.begin());
  return result;
}

WideFloat operator/(const WideFloat& a, const WideFloat& b) noexcept {
  if (a.is_zero()) return {};
  std::array<mp_limb_t, 2 * WideFloat::kLimbs> dividend{};
  std::array<mp_limb_t, WideFloat::kLimbs + 1> quotient;
  std::array<mp_limb_t, WideFloat::kLimbs> rest;
  std::copy(a.limbs_.begin(), a.limbs_.end(), dividend.begin() + WideFloat::kLimbs);
  mpn_tdiv_qr(quotient.data(), rest.data(), 0, dividend.data(), 2 * WideFloat::kLimbs,
              b.limbs_.data(), WideFloat::kLimbs);
  WideFloat result;
  result.negative_ = a.negative_ != b.negative_;
  result.exponent_ = a.exponent_ - b.exponent_;
  if (quotient.back() != 0) {  // the mantissas' quotient is in [1, 2)
    mpn_rshift(quotient.data(), quotient.data(), WideFloat::kLimbs + 1, 1);
    ++result.exponent_;
  }
  std::copy_n(quotient.begin(), WideFloat::kLimbs, result.limbs_.begin());
  return result;
}

WideFloat sqrt(const WideFloat& a) noexcept {
  if (a.is_zero() || a.negative_) return {};
  std::array<mp_limb_t, 2 * WideFloat::kLimbs> square{};
  std::copy(a.limbs_.begin(), a.limbs_.end(), square.begin() + WideFloat::kLimbs);
  const bool odd = a.exponent_ % 2 != 0;
  if (odd) mpn_rshift(square.data(), square.data(), 2 * WideFloat::kLimbs, 1);
  WideFloat result;
  mpn_sqrtrem(result.limbs_.data(), nullptr, square.data(), 2 * WideFloat::kLimbs);
  result.exponent_ = (a.exponent_ + (odd ? 1 : 0)) / 2;
  return result;
}

WideMatrix wide_rotation(const Quaternion& q) noexcept {
  return rotation_matrix<WideFloat>(WideFloat(q.w()), WideFloat(q.x()), WideFloat(q.y()),
                                    WideFloat(q.z()),
                                    [](const WideFloat& a, const WideFloat& b) { return a * b; });
}

}  // namespace tangency::inline v0::detail
