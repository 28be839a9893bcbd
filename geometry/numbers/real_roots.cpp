// SPDX-License-Identifier: MIT
#include <tangency/geometry/numbers/real_roots.hpp>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include <tangency/geometry/numbers/integer_forms.hpp>

namespace tangency::inline v0::exact {
namespace {

constexpr std::uint64_t kSignBit = std::uint64_t{1} << 63;
constexpr std::uint64_t kLargestBits =
    std::bit_cast<std::uint64_t>(std::numeric_limits<double>::max());

mpq_class power_of_two(long exponent) {
  mpq_class result = 1;
  if (exponent >= 0) result <<= static_cast<mp_bitcnt_t>(exponent);
  if (exponent < 0) result >>= static_cast<mp_bitcnt_t>(-exponent);
  return result;
}

/// Largest e with 2^e <= x. Requires x > 0.
long floor_log2(const mpq_class& x) {
  const long e = static_cast<long>(mpz_sizeinbase(x.get_num_mpz_t(), 2)) -
                 static_cast<long>(mpz_sizeinbase(x.get_den_mpz_t(), 2));
  return power_of_two(e) <= x ? e : e - 1;
}

/// Bits of the largest double <= x. Requires x >= 0.
std::uint64_t bits_below(const mpq_class& x) {
  if (x == 0) return 0;
  const long exponent = floor_log2(x);
  if (exponent > 1023) return kLargestBits;
  const long quantum = std::max(exponent - 52, -1074L);
  const mpq_class scaled = x * power_of_two(-quantum);
  const mpz_class mantissa = scaled.get_num() / scaled.get_den();
  // Below 2^53, so that the double is exact.
  return (static_cast<std::uint64_t>(quantum + 1074) << 52) +
         static_cast<std::uint64_t>(mantissa.get_d());
}

std::uint64_t bits_above(const mpq_class& x) {
  const std::uint64_t below = bits_below(x);
  return to_rational(std::bit_cast<double>(below)) == x ? below : below + 1;
}

bool is_infinite(double x) { return (std::bit_cast<std::uint64_t>(x) & ~kSignBit) > kLargestBits; }

/// A double strictly inside, next to the wanted point (which lies inside); nothing where there is
/// none.
std::optional<mpq_class> double_inside(const mpq_class& low, const mpq_class& high,
                                       const mpq_class& wanted) {
  for (const double candidate : {double_below(wanted), double_above(wanted)}) {
    if (is_infinite(candidate)) continue;
    mpq_class value = to_rational(candidate);
    if (low < value && value < high) return value;
  }
  return std::nullopt;
}

/// A point strictly inside that halves the interval in its logarithm while its ends are far apart,
/// and in its length afterwards. `least` is a lower bound on the magnitudes of all roots but 0.
mpq_class halfway(const mpq_class& low, const mpq_class& high, const mpq_class& least) {
  if (low < 0 && high > 0) return 0;
  if (high <= 0) return -halfway(-high, -low, least);
  if (low == 0) return high > least ? least : mpq_class(high / 2);
  if (high <= 4 * low) return (low + high) / 2;
  return power_of_two((floor_log2(low) + floor_log2(high) + 1) >> 1);
}

/// Cauchy's bound: 2^e, e the result, exceeds the magnitude of all roots of a polynomial with these
/// coefficients, the leading one given.
long root_bound(std::span<const mpz_class> coefficients, const mpz_class& leading) {
  std::size_t largest = 0;
  for (const mpz_class& c : coefficients) {
    if (c != 0) largest = std::max(largest, mpz_sizeinbase(c.get_mpz_t(), 2));
  }
  return static_cast<long>(largest) - static_cast<long>(mpz_sizeinbase(leading.get_mpz_t(), 2)) + 2;
}

/// 2^shift x for a dyadic x. Requires that this is an integer.
mpz_class scaled(const mpq_class& x, mp_bitcnt_t shift) {
  return x.get_num() << (shift - mpz_scan1(x.get_den_mpz_t(), 0));
}

/// 2^(n shift) p(x / 2^shift), n the degree: Horner's rule.
mpz_class value_at(const IntegerPolynomial& p, const mpz_class& x, mp_bitcnt_t shift) {
  const auto c = p.coefficients();
  mpz_class value = p.leading();
  mp_bitcnt_t shifted = 0;
  for (std::size_t i = c.size() - 1; i-- > 0;) {
    value *= x;
    shifted += shift;
    value += c[i] << shifted;
  }
  return value;
}

/// Sign of the square-free p immediately above x, which may be a root.
int sign_after(const IntegerPolynomial& p, const mpq_class& x) {
  const int sign = p.sign_at(x);
  return sign != 0 ? sign : p.derivative().sign_at(x);
}

/// Roots in low < x < high, the ends excluded.
int roots_inside(const SturmSequence& sturm, const mpq_class& low, const mpq_class& high) {
  return sturm.roots_between(low, high) - (sturm.square_free().sign_at(high) == 0 ? 1 : 0);
}

/// A lower bound on the magnitudes of all roots but 0.
mpq_class least_root(const IntegerPolynomial& p) {
  const auto coefficients = p.coefficients();
  const auto lowest = std::find_if(coefficients.begin(), coefficients.end(),
                                   [](const mpz_class& c) { return c != 0; });
  return power_of_two(-root_bound(coefficients, *lowest));
}

class Isolation {
 public:
  explicit Isolation(const SturmSequence& sturm)
      : sturm_(sturm), least_(least_root(sturm.square_free())) {
    const auto coefficients = sturm.square_free().coefficients();
    most_ = power_of_two(root_bound(coefficients, coefficients.back()));
  }

  std::vector<RealRoot> run() {
    split(-most_, most_, sturm_.roots());
    for (RealRoot& root : roots_) refine(root);
    return std::move(roots_);
  }

 private:
  /// Requires that (low, high), the ends excluded, holds `count` roots.
  void split(const mpq_class& low, const mpq_class& high, int count) {
    if (count == 0) return;
    if (count == 1) {
      roots_.emplace_back(sturm_.square_free(), low, high);
      return;
    }
    const mpq_class cut = halfway(low, high, least_);
    const int is_root = sturm_.square_free().sign_at(cut) == 0 ? 1 : 0;
    const int left = roots_inside(sturm_, low, cut);
    split(low, cut, left);
    if (is_root != 0) roots_.emplace_back(sturm_.square_free(), cut, cut);
    split(cut, high, count - left - is_root);
  }

  void refine(RealRoot& root) const {
    while (!root.is_exact()) {
      const mpq_class half = halfway(root.low(), root.high(), least_);
      const auto cut = double_inside(root.low(), root.high(), half);
      if (!cut) return;
      root.cut(*cut);
    }
  }

  const SturmSequence& sturm_;
  mpq_class least_, most_;
  std::vector<RealRoot> roots_;
};

}  // namespace

RealRoot::RealRoot(const IntegerPolynomial& p, mpq_class low, mpq_class high)
    : p_(&p), low_(std::move(low)), high_(std::move(high)) {}

void RealRoot::cut(const mpq_class& at) {
  assert(low_ < at && at < high_);
  const int sign = p_->sign_at(at);
  if (before_ == 0) before_ = sign_after(*p_, low_);
  if (sign == 0) {
    low_ = high_ = mpq_class(at);
  } else if (sign == before_) {
    low_ = at;
  } else {
    high_ = at;
  }
}

void RealRoot::halve() { cut(halfway(low_, high_, least_root(*p_))); }

// Quadratic interval refinement: where the chord between the ends crosses 0, an interval
// 2^-digits as wide; as many digits again where the root is in it.
void RealRoot::narrow() {
  if (is_exact()) return;
  const bool same_scale = low_ > 0 ? high_ <= 4 * low_ : high_ < 0 && low_ >= 4 * high_;
  const mp_bitcnt_t shift =
      digits_ + std::max(mpz_scan1(low_.get_den_mpz_t(), 0), mpz_scan1(high_.get_den_mpz_t(), 0));
  const mpz_class low = scaled(low_, shift), high = scaled(high_, shift);
  const mpz_class at_low = value_at(*p_, low, shift), at_high = value_at(*p_, high, shift);
  if (!same_scale || sgn(at_low) * sgn(at_high) >= 0) return halve();

  const mpz_class part = (high - low) >> digits_;
  const mpz_class before = (at_low << digits_) / (at_low - at_high);  // parts, below 2^digits
  for (const mpz_class& at :
       {mpz_class(low + before * part), mpz_class(low + (before + 1) * part)}) {
    mpq_class end = at;
    end >>= shift;
    if (low_ < end && end < high_) cut(end);
  }
  if (is_exact()) return;
  const bool inside = (high_ - low_) * mpq_class(mpz_class(1) << shift) == part;
  digits_ = inside ? 2 * digits_ : std::max<mp_bitcnt_t>(1, digits_ / 2);
  if (!inside) halve();
}

double RealRoot::below() const { return double_below(low_); }
double RealRoot::above() const { return double_above(high_); }

double RealRoot::nearest() const {
  const double lower = below();
  const double upper = above();
  if (is_infinite(lower)) return upper;
  if (is_infinite(upper) || lower == upper) return lower;
  const mpq_class middle = (to_rational(lower) + to_rational(upper)) / 2;
  if (middle <= low_) return upper;
  if (middle >= high_) return lower;
  return p_->sign_at(middle) == sign_after(*p_, low_) ? upper : lower;
}

std::vector<RealRoot> isolate_real_roots(const SturmSequence& sturm) {
  return Isolation(sturm).run();
}

int compare(RealRoot& a, RealRoot& b) {
  const auto apart = [&] { return a.high_ <= b.low_ || b.high_ <= a.low_; };
  if (!apart() && !a.is_exact() && !b.is_exact()) {
    const mpq_class low = std::max(a.low_, b.low_), high = std::min(a.high_, b.high_);
    if (!coprime(*a.p_, *b.p_) && roots_inside(SturmSequence(gcd(*a.p_, *b.p_)), low, high) != 0) {
      return 0;
    }
  }
  while (!apart()) {
    if (b.is_exact()) {
      a.cut(b.low_);
    } else if (a.is_exact()) {
      b.cut(a.low_);
    } else {
      // The wider one, or the other would gain digits that tell nothing.
      (a.high_ - a.low_ < b.high_ - b.low_ ? b : a).narrow();
    }
  }
  if (a.is_exact() && b.is_exact()) return cmp(a.low_, b.low_);
  return a.high_ <= b.low_ ? -1 : 1;
}

mpq_class sample_between(RealRoot& left, RealRoot& right) {
  while (left.high() == right.low() && (left.is_exact() || right.is_exact())) {
    (left.is_exact() ? right : left).narrow();
  }
  if (left.high() == right.low()) return left.high();
  const mpq_class middle = (left.high() + right.low()) / 2;
  return double_inside(left.high(), right.low(), middle).value_or(middle);
}

double double_below(const mpq_class& x) {
  if (x >= 0) return std::bit_cast<double>(bits_below(x));
  return std::bit_cast<double>(bits_above(-x) | kSignBit);
}

double double_above(const mpq_class& x) {
  if (x >= 0) return std::bit_cast<double>(bits_above(x));
  const std::uint64_t bits = bits_below(-x);
  return std::bit_cast<double>(bits == 0 ? 0 : bits | kSignBit);
}

}  // namespace tangency::inline v0::exact
