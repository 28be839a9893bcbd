// SPDX-License-Identifier: MIT
/// @file
/// Coefficients of a linear model from weighted data, and what each datum did to them. Internal.
///
/// A datum has the basis B, one number a coefficient; the model is B.c. Weights add up to 1. A
/// vector is a datum a component.
#pragma once

#include <array>
#include <cstddef>

namespace tangency::inline v0::micromechanics {

inline constexpr std::size_t kMostCoefficients = 15;  ///< 1 of order 0, 5 of order 2, 9 of order 4

/// The first ones count, the rest is 0.
using Coefficients = std::array<double, kMostCoefficients>;
using CoefficientMatrix = std::array<Coefficients, kMostCoefficients>;

class Regression {
 public:
  explicit Regression(std::size_t size) : size_(size) {}

  void add(const Coefficients& basis, double value, double weight);

  /// The weighted least squares. False where the data leave a coefficient open.
  bool least_squares();
  /// Sums of weight times basis times value, each times its factor: exact for data in all
  /// directions alike and a basis that is orthogonal over them.
  void project(const Coefficients& factors);

  const Coefficients& coefficients() const { return coefficients_; }
  /// What a datum that is `residual` off the model adds to the error of the coefficients.
  Coefficients influence(const Coefficients& basis, double residual, double weight) const;

 private:
  Coefficients applied(const Coefficients& right) const;

  std::size_t size_;
  CoefficientMatrix normal_{}, operator_{};
  Coefficients right_{}, coefficients_{};
};

/// The covariance of coefficients, from what each datum adds to their error.
class Covariance {
 public:
  void add(const Coefficients& influence);
  /// Accounts for the coefficients that followed the data: times data/(data - followed), NaN
  /// without spare data.
  void correct(std::size_t data, std::size_t followed);
  /// The standard deviation of direction . coefficients.
  double deviation(const Coefficients& direction) const;

 private:
  CoefficientMatrix sum_{};
};

}  // namespace tangency::inline v0::micromechanics
