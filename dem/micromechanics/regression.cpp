// SPDX-License-Identifier: MIT
#include "regression.hpp"

#include <Eigen/Cholesky>

#include <cmath>
#include <limits>

#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::micromechanics {

void Regression::add(const Coefficients& basis, double value, double weight) {
  for (std::size_t i = 0; i < size_; ++i) {
    for (std::size_t j = 0; j < size_; ++j) normal_[i][j] += weight * basis[i] * basis[j];
    right_[i] += weight * basis[i] * value;
  }
}

bool Regression::least_squares() {
  // Chosen: where a combination of coefficients is seen a million times worse than another, in
  // amplitude 1e-5, rounding and no datum would decide it.
  constexpr double kLeastSeen = 1e-10;
  const auto size = static_cast<Eigen::Index>(size_);
  Eigen::VectorXd scale(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (!(normal_[at][at] > 0.0)) return false;
    scale[i] = 1.0 / std::sqrt(normal_[at][at]);
  }
  Eigen::MatrixXd unit(size, size);
  for (Eigen::Index i = 0; i < size; ++i)
    for (Eigen::Index j = 0; j < size; ++j)
      unit(i, j) =
          scale[i] * scale[j] * normal_[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  const Eigen::LDLT<Eigen::MatrixXd> solved(unit);
  if (!(solved.vectorD().minCoeff() > kLeastSeen)) return false;
  Eigen::VectorXd column(size);
  for (Eigen::Index j = 0; j < size; ++j) {
    column = solved.solve(Eigen::VectorXd::Unit(size, j));
    for (Eigen::Index i = 0; i < size; ++i)
      operator_[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
          scale[i] * scale[j] * column[i];
  }
  coefficients_ = applied(right_);
  return true;
}

void Regression::project(const Coefficients& factors) {
  for (std::size_t i = 0; i < size_; ++i) operator_[i][i] = factors[i];
  coefficients_ = applied(right_);
}

Coefficients Regression::influence(const Coefficients& basis, double residual,
                                   double weight) const {
  Coefficients scaled{};
  for (std::size_t i = 0; i < size_; ++i) scaled[i] = weight * residual * basis[i];
  return applied(scaled);
}

Coefficients Regression::applied(const Coefficients& right) const {
  Coefficients result{};
  for (std::size_t i = 0; i < size_; ++i)
    for (std::size_t j = 0; j < size_; ++j) result[i] += operator_[i][j] * right[j];
  return result;
}

void Covariance::add(const Coefficients& influence) {
  for (std::size_t i = 0; i < kMostCoefficients; ++i)
    for (std::size_t j = 0; j < kMostCoefficients; ++j) sum_[i][j] += influence[i] * influence[j];
}

void Covariance::correct(std::size_t data, std::size_t followed) {
  const double factor = data > followed
                            ? static_cast<double>(data) / static_cast<double>(data - followed)
                            : std::numeric_limits<double>::quiet_NaN();
  for (Coefficients& row : sum_)
    for (double& entry : row) entry *= factor;
}

double Covariance::deviation(const Coefficients& direction) const {
  double square = 0.0;
  for (std::size_t i = 0; i < kMostCoefficients; ++i)
    for (std::size_t j = 0; j < kMostCoefficients; ++j)
      square += direction[i] * sum_[i][j] * direction[j];
  return std::sqrt(square);
}

}  // namespace tangency::inline v0::micromechanics
