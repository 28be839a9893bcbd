// SPDX-License-Identifier: MIT
#include <tangency/dem/micromechanics/direction_integrals.hpp>

#include <algorithm>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <vector>

namespace tangency::inline v0::micromechanics {
namespace {

/// The product of (p - 1)!! of all exponents over the first factors of `first`, `first` + 2, ...,
/// as many as the numerator has. Numerators and denominators take turns, so that no partial product
/// overflows.
double double_factorials(std::initializer_list<int> exponents, int first) {
  for (const int exponent : exponents)
    if (exponent < 0)
      throw std::invalid_argument("exponent = " + std::to_string(exponent) + ": must be >= 0");
  double value = 1.0;
  int denominator = first;
  for (const int exponent : exponents) {
    if (exponent % 2 == 1) return 0.0;
    for (int numerator = 1; numerator < exponent; numerator += 2, denominator += 2)
      value *= static_cast<double>(numerator) / static_cast<double>(denominator);
  }
  return value;
}

}  // namespace

double pairing_sum(std::span<const int> indices) {
  std::vector<int> sorted(indices.begin(), indices.end());
  std::ranges::sort(sorted);
  double value = 1.0;
  for (auto at = sorted.begin(); at != sorted.end();) {
    const auto end = std::upper_bound(at, sorted.end(), *at);
    const auto times = end - at;
    if (times % 2 == 1) return 0.0;
    for (auto factor = times - 1; factor > 1; factor -= 2) value *= static_cast<double>(factor);
    at = end;
  }
  return value;
}

double sphere_average(int p, int q, int r) { return double_factorials({p, q, r}, 3); }

double circle_average(int p, int q) { return double_factorials({p, q}, 2); }

Mat3 average_with(const Mat3& a) { return 2.0 / 15.0 * a; }

Mat3 average_with(const Mat3& a, const Mat3& b) {
  return (2.0 * contracted(a, b) * Mat3::Identity() + 4.0 * (a * b + b * a)) / 105.0;
}

Mat3 average_with(const Mat3& a, const Mat3& b, const Mat3& c) {
  const Mat3 isotropic = 8.0 * (a * b * c).trace() * Mat3::Identity();
  const Mat3 single = contracted(b, c) * a + contracted(a, c) * b + contracted(a, b) * c;
  return (isotropic + 4.0 * single + 8.0 * sum_of_products(a, b, c)) / 945.0;
}

Mat3 sum_of_products(const Mat3& a, const Mat3& b, const Mat3& c) {
  // The transpose of a product of symmetric matrices is the product in the other order; written
  // out, since these need not be symmetric.
  return a * (b * c + c * b) + b * (a * c + c * a) + c * (a * b + b * a);
}

double contracted(const Mat3& a, const Mat3& b) { return a.cwiseProduct(b).sum(); }

}  // namespace tangency::inline v0::micromechanics
