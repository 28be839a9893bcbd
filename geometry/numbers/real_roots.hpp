// SPDX-License-Identifier: MIT
/// @file
/// Isolation of the real roots of integer polynomials, and the doubles around them. Internal (GMP).
///
/// (1) isolate_real_roots(p) has as many entries as p has distinct real roots, ascending.
/// (2) double_below(x) <= x <= double_above(x), with no double between the two but x itself.
/// (3) compare(a, b) is 0 if and only if a and b are the same number, whatever polynomials they are
///     roots of.
/// (4) sample_between(a, b) lies strictly between the two roots.
#pragma once

#include <gmpxx.h>

#include <vector>

#include <tangency/geometry/numbers/integer_polynomial.hpp>

namespace tangency::inline v0::exact {

/// A real root of a square-free polynomial p: equal to low = high, or the only root of p in
/// low < x < high. In the latter case an end may be another root of p.
class RealRoot {
 public:
  /// Keeps a reference to p.
  RealRoot(const IntegerPolynomial& p, mpq_class low, mpq_class high);

  const mpq_class& low() const noexcept { return low_; }
  const mpq_class& high() const noexcept { return high_; }
  bool is_exact() const { return low_ == high_; }

  /// Keeps the side of the cut that holds the root, or finds that the root is the cut.
  /// Requires low < cut < high.
  void cut(const mpq_class& at);
  /// In the exponent where the ends are far apart, which beyond the range of doubles they may be by
  /// thousands. Requires an inexact root.
  void halve();
  /// At least halved; in the end each time by twice as many digits as before.
  void narrow();

  /// The largest double <= the root and the smallest >= it, once refined; infinite where there is
  /// no finite one.
  double below() const;
  double above() const;
  /// A finite double nearest to the root.
  double nearest() const;

  friend int compare(RealRoot& a, RealRoot& b);

 private:
  const IntegerPolynomial* p_;
  mpq_class low_, high_;
  unsigned long digits_ = 1;  ///< how many more narrow() tries for
  int before_ = 0;            ///< p's sign between low and the root, once known
};

/// All of them, each refined until no double lies strictly inside its interval. They refer to
/// sturm.square_free().
std::vector<RealRoot> isolate_real_roots(const SturmSequence& sturm);

/// -1, 0 or 1 as a < b, a = b, a > b. Refines both until their intervals have no common inner point
/// or the roots are known to be equal.
int compare(RealRoot& a, RealRoot& b);

/// A rational number strictly between, a double where one lies between the intervals.
/// Requires compare(left, right) < 0, and done before. May refine the two.
mpq_class sample_between(RealRoot& left, RealRoot& right);

/// The largest double <= x, or minus infinity; zero is +0.
double double_below(const mpq_class& x);
/// The smallest double >= x, or infinity; zero is +0.
double double_above(const mpq_class& x);

}  // namespace tangency::inline v0::exact
