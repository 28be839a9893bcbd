// SPDX-License-Identifier: MIT
#include <tangency/geometry/quadric.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <string>

#include <tangency/geometry/bodies/classify_coefficients.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>

namespace tangency::inline v0 {
namespace {

std::string describe(const QuadricFault& fault) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, fault.value).ptr;
  return std::string(fault.field) + " = " + std::string(digits, end) + ": " + fault.rule;
}

/// The polynomial x' block x + 2 column . x + constant.
struct Parts {
  Mat3 block;
  Vec3 column;
  double constant;
};

Parts parts_of(const Quadric& quadric) {
  const Quadric::Coefficients& c = quadric.coefficients();
  return {quadric.sub_discriminant(), Vec3(c[6], c[7], c[8]), c[9]};
}

Quadric quadric_of(const Parts& p) {
  return Quadric({p.block(0, 0), p.block(1, 1), p.block(2, 2), p.block(0, 1), p.block(1, 2),
                  p.block(2, 0), p.column[0], p.column[1], p.column[2], p.constant});
}

/// block -> R block R', filled symmetrically.
Mat3 turned(const Mat3& rotation, const Mat3& block) {
  const Mat3 product = rotation * block * rotation.transpose();
  return 0.5 * (product + product.transpose());
}

/// Binary exponent of the largest magnitude; far below every double's where all are zero.
template <typename Derived>
int largest_exponent(const Eigen::MatrixBase<Derived>& values) {
  const double largest = values.cwiseAbs().maxCoeff();
  return largest > 0.0 ? std::ilogb(largest) : -100000;
}

/// The same surface in the unit of length 2^unit_exponent, and multiplied by a power of two, with
/// no entry above 2 and the block's largest in [1, 2).
struct Normalised {
  Parts parts;
  int unit_exponent;
};

Normalised normalised(const Parts& p) {
  const int block = largest_exponent(p.block);
  const int column = largest_exponent(p.column);
  const int constant = largest_exponent(Eigen::Matrix<double, 1, 1>(p.constant));
  const int unit = std::max(column - block, (constant - block + 1) / 2);
  const auto shifted = [](int shift) { return [shift](double v) { return std::ldexp(v, shift); }; };
  return {{p.block.unaryExpr(shifted(-block)), p.column.unaryExpr(shifted(-block - unit)),
           std::ldexp(p.constant, -block - 2 * unit)},
          unit};
}

Parts surface_of(const Ellipsoid& e) {
  const double scale = std::ldexp(1.0, std::ilogb(e.smallest_semi_axis()));
  const Vec3& a = e.semi_axes();
  const Vec3 weights = (Vec3::Constant(scale).cwiseQuotient(a)).cwiseQuotient(a);
  const Mat3 block = turned(e.rotation(), weights.asDiagonal());
  const Vec3 column = -(block * e.centre());
  return {block, column, -column.dot(e.centre()) - scale};
}

// With x = R'(x' - t): Q_s' = R Q_s R', g' = R g - Q_s' t, K' = K - 2 t . R g + t . Q_s' t.
Parts moved(const Parts& p, const Mat3& r, const Vec3& translation) {
  const Mat3 block = turned(r, p.block);
  const Vec3 turned_column = r * p.column;
  const Vec3 column = turned_column - block * translation;
  return {block, column, p.constant - translation.dot(turned_column + column)};
}

std::optional<Ellipsoid> solid_of(const Quadric& quadric) {
  if (detail::classify_coefficients(quadric.coefficients()).type != QuadricType::real_ellipsoid)
    return std::nullopt;
  auto [p, unit_exponent] = normalised(parts_of(quadric));
  if (p.block.trace() < 0.0) p = {-p.block, -p.column, -p.constant};

  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(p.block);
  const Vec3 eigenvalues = eigen.eigenvalues().reverse();
  if (!(eigenvalues.minCoeff() > 0.0)) return std::nullopt;
  Mat3 axes = eigen.eigenvectors().rowwise().reverse();
  if (axes.determinant() < 0.0) axes.col(0) = -axes.col(0);

  const Vec3 centre = -(axes * (axes.transpose() * p.column).cwiseQuotient(eigenvalues));
  const double value_at_centre = p.column.dot(centre) + p.constant;
  if (!(value_at_centre < 0.0)) return std::nullopt;
  const Vec3 semi_axes = (eigenvalues.cwiseInverse() * -value_at_centre).cwiseSqrt();

  const auto rescaled = [unit = unit_exponent](double v) { return std::ldexp(v, unit); };
  const Vec3 true_centre = centre.unaryExpr(rescaled);
  const Vec3 true_axes = semi_axes.unaryExpr(rescaled);
  const Quaternion orientation(axes);
  if (Ellipsoid::find_fault(true_centre, true_axes, orientation)) return std::nullopt;
  return Ellipsoid(true_centre, true_axes, orientation);
}

}  // namespace

InvalidQuadric::InvalidQuadric(const QuadricFault& fault)
    : std::invalid_argument(describe(fault)), fault_(fault) {}

Quadric::Quadric(const Coefficients& coefficients) : coefficients_(coefficients) {
  if (const auto fault = find_fault(coefficients)) throw InvalidQuadric(*fault);
}

std::optional<QuadricFault> Quadric::find_fault(const Coefficients& coefficients) noexcept {
  static constexpr const char* kNames[] = {"A", "B", "C", "D", "E", "F", "G", "H", "J", "K"};
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    if (!std::isfinite(coefficients[i])) {
      return QuadricFault{kNames[i], coefficients[i], "a coefficient must be finite"};
    }
  }
  return std::nullopt;
}

Quadric Quadric::from_ellipsoid(const Ellipsoid& e) {
  return quadric_of(in_default_environment([&] { return surface_of(e); }));
}

Mat4 Quadric::discriminant() const noexcept {
  const auto& [a, b, c, d, e, f, g, h, j, k] = coefficients_;
  return (Mat4() << a, d, f, g, d, b, e, h, f, e, c, j, g, h, j, k).finished();
}

Mat3 Quadric::sub_discriminant() const noexcept { return discriminant().topLeftCorner<3, 3>(); }

double Quadric::evaluate(const Vec3& point) const noexcept {
  return in_default_environment([&] {
    const Parts p = parts_of(*this);
    return point.dot(p.block * point + 2.0 * p.column) + p.constant;
  });
}

Vec3 Quadric::gradient(const Vec3& point) const noexcept {
  return in_default_environment([&]() -> Vec3 {
    const Parts p = parts_of(*this);
    return 2.0 * (p.block * point + p.column);
  });
}

Quadric Quadric::negated() const noexcept {
  Coefficients result = coefficients_;
  for (double& c : result) c = -c;
  return Quadric(result);
}

Quadric Quadric::moved(const Quaternion& rotation, const Vec3& translation) const {
  return quadric_of(in_default_environment(
      [&] { return tangency::moved(parts_of(*this), rotation_of(rotation), translation); }));
}

Quadric Quadric::scaled(double factor) const {
  return quadric_of(in_default_environment([&] {
    assert(std::isfinite(factor) && factor > 0.0);
    Parts p = parts_of(*this);
    p.block /= factor;
    p.constant *= factor;
    return p;
  }));
}

std::optional<Ellipsoid> Quadric::to_ellipsoid() const {
  return in_default_environment([&] { return solid_of(*this); });
}

}  // namespace tangency::inline v0
