// SPDX-License-Identifier: GPL-3.0-or-later
// Holds the real roots of quartics, of coefficients over the whole range of doubles, against
// Sturm's count in exact integers. The merge gate runs a part of it; docs/testing.md names the
// whole.
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <tangency/geometry/polynomial.hpp>
#include <tangency/tests/verify/agreement.hpp>

namespace {

using Coefficients = std::array<double, 5>;
using Polynomial = std::vector<mpz_class>;  // lowest first, the last not 0
using tangency::QuarticRoot;
using tangency::QuarticRoots;

constexpr double kU = tangency::kUnitRoundoff;

/// mantissa 2^exponent
struct Dyadic {
  mpz_class mantissa;
  long exponent = 0;
};

Dyadic dyadic(double x) {
  if (x == 0) return {0, 0};
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  return {mpz_class(std::ldexp(fraction, 53)), exponent - 53};
}
mpz_class shifted(const mpz_class& value, long by) { return value << static_cast<mp_bitcnt_t>(by); }

Dyadic sum(const Dyadic& a, const Dyadic& b) {
  if (a.mantissa == 0) return b;
  if (b.mantissa == 0) return a;
  const long least = std::min(a.exponent, b.exponent);
  return {shifted(a.mantissa, a.exponent - least) + shifted(b.mantissa, b.exponent - least), least};
}
Dyadic half(Dyadic a) { return {a.mantissa, a.exponent - 1}; }
Dyadic minus(const Dyadic& a) { return {-a.mantissa, a.exponent}; }
bool less(const Dyadic& a, const Dyadic& b) { return sum(a, minus(b)).mantissa < 0; }

Dyadic value(const Polynomial& p, const Dyadic& x) {
  Dyadic result;
  for (std::size_t k = p.size(); k-- > 0;) {
    result = sum({result.mantissa * x.mantissa, result.exponent + x.exponent}, {p[k], 0});
  }
  return result;
}
int sign_at(const Polynomial& p, const Dyadic& x) { return sgn(value(p, x).mantissa); }

/// In units of the least double.
Polynomial exactly(const Coefficients& a) {
  Polynomial p;
  for (const double c : a) {
    const Dyadic d = dyadic(c);
    p.push_back(d.exponent + 1074 >= 0
                    ? shifted(d.mantissa, d.exponent + 1074)
                    : d.mantissa >> static_cast<mp_bitcnt_t>(-d.exponent - 1074));
  }
  while (!p.empty() && p.back() == 0) p.pop_back();
  return p;
}

Polynomial derivative(const Polynomial& p) {
  Polynomial result;
  for (std::size_t k = 1; k < p.size(); ++k) result.push_back(p[k] * static_cast<unsigned>(k));
  return result;
}

/// A negative multiple of the rest of p by q, of no common factor.
Polynomial negative_rest(Polynomial p, const Polynomial& q) {
  const mpz_class lead = q.back();
  while (p.size() >= q.size()) {
    const mpz_class top = p.back() * sgn(lead);
    for (mpz_class& c : p) c *= abs(lead);
    const std::size_t shift = p.size() - q.size();
    for (std::size_t k = 0; k < q.size(); ++k) p[k + shift] -= top * q[k];
    while (!p.empty() && p.back() == 0) p.pop_back();
  }
  mpz_class common = 0;
  for (const mpz_class& c : p) common = gcd(common, c);
  for (mpz_class& c : p) c /= -common;
  return p;
}

/// Sturm's sequence: how many distinct real roots lie in an interval.
class Sturm {
 public:
  explicit Sturm(const Polynomial& p) : sequence_{p} {
    if (p.size() > 1) sequence_.push_back(derivative(p));
    while (sequence_.size() > 1) {
      Polynomial rest = negative_rest(sequence_[sequence_.size() - 2], sequence_.back());
      if (rest.empty()) break;
      sequence_.push_back(std::move(rest));
    }
  }
  int variations_at(const Dyadic& x) const {
    return variations([&](const Polynomial& p) { return sign_at(p, x); });
  }
  /// Distinct real roots in all.
  int count() const {
    return variations([](const Polynomial& p) { return sgn(p.back()) * (p.size() % 2 ? 1 : -1); }) -
           variations([](const Polynomial& p) { return sgn(p.back()); });
  }
  bool is_square_free() const { return sequence_.back().size() == 1; }

 private:
  template <class Sign>
  int variations(const Sign& sign) const {
    int changes = 0, before = 0;
    for (const Polynomial& p : sequence_) {
      const int here = sign(p);
      if (here != 0 && before != 0 && here != before) ++changes;
      if (here != 0) before = here;
    }
    return changes;
  }
  std::vector<Polynomial> sequence_;
};

/// A sign change of p within (low, high), as narrow as 2^-80 of itself or within a root's error.
struct Crossing {
  Dyadic low, high;
};

/// The sign changes of p in (low, high), both of one sign and no roots: the interval is halved, in
/// the exponent first.
/// @param enclosed  all of the interval is within the error of a root
void isolate(const Polynomial& p, const Sturm& sturm, const Dyadic& low, const Dyadic& high,
             bool enclosed, std::vector<Crossing>& found) {
  const int inside = sturm.variations_at(low) - sturm.variations_at(high);
  if (inside == 0) return;
  const Dyadic width = sum(high, minus(low)), far = low.mantissa < 0 ? low : high;
  const auto bits = [](const Dyadic& x) {
    return static_cast<long>(mpz_sizeinbase(x.mantissa.get_mpz_t(), 2)) + x.exponent;
  };
  if ((enclosed && inside == 1) || bits(width) < bits(far) - 80) {
    if (sign_at(p, low) * sign_at(p, high) < 0) found.push_back({low, high});
    return;
  }
  const Dyadic near = low.mantissa < 0 ? high : low;
  Dyadic middle = half(sum(low, high));
  if (bits(far) > bits(near) + 2) {
    middle = {far.mantissa < 0 ? -1 : 1, (bits(far) + bits(near)) >> 1};
  }
  // Sturm's theorem is of intervals whose ends are no multiple roots.
  while (sign_at(p, middle) == 0) middle = half(sum(middle, far));
  isolate(p, sturm, low, middle, enclosed, found);
  isolate(p, sturm, middle, high, enclosed, found);
}

/// Low and high end.
using Enclosure = std::pair<Dyadic, Dyadic>;

/// Those of p(0) != 0: every root is between 2^-4400 and 2^4400 in magnitude (Cauchy's bound, of
/// coefficients that are integers below 2^2098).
std::vector<Crossing> crossings(const Polynomial& p, const std::vector<Enclosure>& enclosures) {
  const Sturm sturm(p);
  const Dyadic tiny{1, -4400}, huge{1, 4400};
  std::vector<Dyadic> cuts{minus(huge), minus(tiny), tiny, huge};
  for (const auto& [low, high] : enclosures) {
    for (const Dyadic& end : {low, high}) {
      const Dyadic size{abs(end.mantissa), end.exponent};
      if (sign_at(p, end) != 0 && less(tiny, size) && less(size, huge)) cuts.push_back(end);
    }
  }
  std::sort(cuts.begin(), cuts.end(), less);
  std::vector<Crossing> found;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const Dyadic &low = cuts[i], &high = cuts[i + 1];
    if (low.mantissa < 0 && high.mantissa > 0) continue;
    const bool enclosed = std::any_of(enclosures.begin(), enclosures.end(), [&](const auto& e) {
      return !less(low, e.first) && !less(e.second, high);
    });
    isolate(p, sturm, low, high, enclosed, found);
  }
  return found;
}

/// Is |p(x)| <= 32 u sum |a_k x^k|?
bool is_lost(const Polynomial& p, const Dyadic& x) {
  Polynomial positive = p;
  for (mpz_class& c : positive) c = abs(c);
  Dyadic most = value(positive, {abs(x.mantissa), x.exponent}), here = value(p, x);
  most.exponent -= 48;
  here.mantissa = abs(here.mantissa);
  return !less(most, here);
}

/// The greatest double, with room for a root's own error.
const Dyadic kLimit{mpz_class((1UL << 50) - 1), 1024 - 50};

struct Tally {
  long polynomials = 0, roots = 0, closely = 0, missed = 0, beyond = 0, violations = 0;
  double widest = 0;  // error of a root that is told well, in u sum |a_k x^k| / |p'(x)| + u |x|
};

/// The stored polynomial without its root 0, and what is claimed of it.
class Check {
 public:
  Check(const Coefficients& a, Tally& tally)
      : a_(a), p_(exactly(a)), found_(tangency::quartic_roots(a)), tally_(tally) {}

  bool holds() {
    if (p_.empty()) return found_.vanishes && found_.count == 0;
    if (found_.vanishes) return false;
    std::size_t zeros = 0;
    while (p_[zeros] == 0) ++zeros;
    p_.erase(p_.begin(), p_.begin() + static_cast<std::ptrdiff_t>(zeros));
    for (int i = 0; i < found_.count; ++i) {
      const QuarticRoot& root = found_.root[static_cast<std::size_t>(i)];
      if (!(root.error >= 0) || std::isnan(root.x)) return false;
      if (zeros > 0 && root.x == 0 && root.error == 0) {
        if (root.crosses != (zeros % 2 == 1)) return false;
        zeros = 0;
        continue;
      }
      roots_.push_back(root);
    }
    if (zeros > 0) return false;
    tally_.roots += static_cast<long>(roots_.size());
    tally_.beyond += found_.beyond;
    return errors_are_narrow() && (each_root_has_its_own() || every_sign_change_is_near());
  }

 private:
  static Dyadic end(const QuarticRoot& root, int side) {
    return sum(dyadic(root.x), dyadic(side * root.error));
  }

  /// An upper bound of the number of real roots not 0: Descartes' rule, for p(x) and p(-x).
  int most_roots() const {
    int most = 0;
    for (const int side : {1, -1}) {
      int before = 0;
      for (std::size_t k = 0; k < p_.size(); ++k) {
        const int here = sgn(p_[k]) * (k % 2 == 1 ? side : 1);
        if (here == 0) continue;
        if (before != 0 && here != before) ++most;
        before = here;
      }
    }
    return most;
  }

  /// Is the number of those beyond the greatest double odd, on either side?
  int beyond_at_least() const {
    const int end = sgn(p_.back());
    return (sign_at(p_, kLimit) != end ? 1 : 0) +
           (sign_at(p_, minus(kLimit)) != (p_.size() % 2 == 1 ? end : -end) ? 1 : 0);
  }

  /// The quick way: as many disjoint enclosures, each with a change of sign, as roots at most.
  bool each_root_has_its_own() const {
    for (std::size_t i = 0; i < roots_.size(); ++i) {
      if (!roots_[i].crosses || !std::isfinite(roots_[i].error)) return false;
      const Dyadic low = end(roots_[i], -1), high = end(roots_[i], 1);
      if (sign_at(p_, low) * sign_at(p_, high) >= 0) return false;
      if (i > 0 && !less(end(roots_[i - 1], 1), low)) return false;
    }
    if (found_.beyond != beyond_at_least()) return false;
    const int found = static_cast<int>(roots_.size()) + found_.beyond;
    if (found == most_roots()) return true;
    const Sturm sturm(p_);
    return sturm.is_square_free() && found == sturm.count();
  }

  bool is_within(const Crossing& c, const QuarticRoot& root) const {
    if (!std::isfinite(root.error)) return true;
    return !less(c.high, end(root, -1)) && !less(end(root, 1), c.low);
  }

  bool every_sign_change_is_near() {
    ++tally_.closely;
    std::vector<Enclosure> enclosures;
    for (const QuarticRoot& root : roots_) {
      if (std::isfinite(root.error)) enclosures.emplace_back(end(root, -1), end(root, 1));
    }
    const std::vector<Crossing> exact = crossings(p_, enclosures);
    for (const QuarticRoot& root : roots_) {
      const auto is_its = [&](const Crossing& c) { return is_within(c, root); };
      if (root.crosses && std::none_of(exact.begin(), exact.end(), is_its)) return false;
    }
    int beyond = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const Crossing& c = exact[i];
      const auto has_it = [&](const QuarticRoot& root) { return is_within(c, root); };
      if (std::any_of(roots_.begin(), roots_.end(), has_it)) continue;
      if (less(kLimit, c.low) || less(c.high, minus(kLimit))) {
        ++beyond;
        continue;
      }
      ++tally_.missed;
      const bool left = i > 0 && is_lost_between(exact[i - 1].high, c.low);
      const bool right = i + 1 < exact.size() && is_lost_between(c.high, exact[i + 1].low);
      if (!left && !right) return false;
    }
    return beyond == found_.beyond;
  }

  bool is_lost_between(const Dyadic& low, const Dyadic& high) const {
    const Dyadic middle = half(sum(low, high));
    return is_lost(p_, half(sum(low, middle))) && is_lost(p_, middle) &&
           is_lost(p_, half(sum(middle, high)));
  }

  /// Of a root that rounding leaves well determined: a few units of what it must be.
  bool errors_are_narrow() {
    for (const QuarticRoot& root : roots_) {
      if (!root.crosses || std::abs(root.x) < 0x1p-1000) continue;
      const auto x = static_cast<long double>(root.x);
      long double all = 0, slope = 0;
      for (std::size_t k = 5; k-- > 0;) {
        all = all * std::abs(x) + std::abs(static_cast<long double>(a_[k]));
        if (k > 0) slope = slope * x + static_cast<long double>(k) * a_[k];
      }
      const long double least = kU * (all / std::abs(slope) + std::abs(x));
      if (!(least < 0x1p-40L * std::abs(x))) continue;
      const double ratio = static_cast<double>(root.error / least);
      tally_.widest = std::max(tally_.widest, ratio);
      if (!(ratio <= 64)) return false;
    }
    return true;
  }

  const Coefficients& a_;
  Polynomial p_;
  QuarticRoots found_;
  std::vector<QuarticRoot> roots_;
  Tally& tally_;
};

/// Reproducible across standard libraries.
class Source {
 public:
  explicit Source(std::uint64_t seed) : random_(seed) {}

  /// 0: any exponents, 1: within 1e+-140, 2: two or three terms, 3: products of roots of any
  /// exponents, 4: close roots in any unit.
  Coefficients next(int kind) {
    Coefficients a{};
    if (kind < 3) {
      for (double& c : a) {
        if (below(kind == 2 ? 2 : 6) != 0) c = number(kind == 1 ? 465 : 1100);
      }
      return a;
    }
    const int reach = kind == 3 ? 400 : 0;
    std::vector<double> p{number(reach)}, root{number(reach)};
    while (root.size() < 4 && below(6) != 0) {
      const bool close = below(kind == 4 ? 2 : 8) == 0;
      root.push_back(close ? root.back() * (1 + std::ldexp(number(0), -below(60))) : number(reach));
    }
    for (const double r : root) {
      std::vector<double> q(p.size() + 1, 0.0);
      for (std::size_t k = 0; k < p.size(); ++k) {
        q[k + 1] += p[k];
        q[k] -= r * p[k];
      }
      p = q;
    }
    const int unit = below(kind == 3 ? 1 : 400) - 200, factor = below(200) - 100;
    for (std::size_t k = 0; k < p.size(); ++k) {
      const double c = std::ldexp(p[k], unit * static_cast<int>(k) + factor);
      a[k] = std::isfinite(c) ? c : 0.0;
    }
    return a;
  }

 private:
  int below(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }
  /// 1 to 2, times 2^-reach to 2^reach as far as that is a double, subnormal ones included.
  double number(int reach) {
    const int bits = below(8) == 0 ? below(52) : 52;
    const double m = 1 + std::ldexp(std::floor(std::ldexp(unit(), bits)), -bits);
    const int exponent = std::clamp(below(2 * reach + 1) - reach, -1074, 1023);
    return (below(2) == 0 ? 1 : -1) * std::ldexp(m, exponent);
  }
  double unit() { return static_cast<double>(random_() >> 11) * kU; }
  std::mt19937_64 random_;
};

constexpr const char* kKinds[] = {"any exponents", "within 1e+-140", "few terms",
                                  "roots of any exponents", "close roots in any unit"};

bool agree(std::uint64_t seed, long count) {
  std::printf("%-24s %11s %9s %8s %12s %7s %10s %16s\n", "kind", "polynomials", "roots", "closely",
              "missed", "beyond", "violations", "error, at most");
  long violations = 0;
  for (int kind = 0; kind < 5; ++kind) {
    Source source(seed + static_cast<std::uint64_t>(kind));
    Tally t;
    for (long i = 0; i < count / 5; ++i) {
      const Coefficients a = source.next(kind);
      ++t.polynomials;
      if (Check(a, t).holds()) continue;
      if (++t.violations > 5) continue;
      std::printf("  broken: {%a,%a,%a,%a,%a}\n", a[0], a[1], a[2], a[3], a[4]);
    }
    std::printf("%-24s %11ld %9ld %8ld %12ld %7ld %10ld %16.3g\n", kKinds[kind], t.polynomials,
                t.roots, t.closely, t.missed, t.beyond, t.violations, t.widest);
    std::fflush(stdout);
    violations += t.violations;
  }
  return violations == 0;
}

}  // namespace

int main(int argc, char** argv) {
  tangency::testing::AgreementProgram program(
      "quartic_agreement",
      "Hold the real roots of quartics against Sturm's count in exact integers");
  long count = 1'000'000;
  program.option("--count", count, "polynomials in all");
  return program.run(argc, argv, [&](std::uint64_t seed) { return agree(seed, count); });
}
