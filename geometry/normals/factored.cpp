// SPDX-License-Identifier: MIT
#include <tangency/geometry/normals/factored.hpp>

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace tangency::inline v0::detail {
namespace {

constexpr int kClimbSteps = 200;       // chosen: far beyond the 5 to 30 steps seen
constexpr int kHalvings = 50;          // a step of 2^-50 no longer moves a unit vector noticeably
constexpr double kEscape = 0.25;       // rad; chosen: the step off a saddle, before backtracking
constexpr double kLastStep = 0x1p-20;  // rad; chosen: what a converged ascent may still move by
constexpr double kLongestStep = 1;     // tangent of the largest turn in one step

/// |y| where squares may underflow: an axis 1e-162 times as long as the pair is enough for that.
double length(const Vec3& y) {
  const double square = y.squaredNorm();
  return square >= 0x1p-900 ? std::sqrt(square) : y.stableNorm();
}

struct Bodyside {
  Vec3 y;      ///< unit vector diag(a) R' n / h
  double h;    ///< support function
  Vec3 point;  ///< support point
};

Bodyside side(const Mat3& factor, const Vec3& n) {
  const Vec3 y = factor.transpose() * n;
  const double h = length(y);
  const Vec3 unit = y / h;
  return {unit, h, factor * unit};
}

/// Two unit vectors that complete n to a right-handed frame.
Eigen::Matrix<double, 3, 2> tangent_basis(const Vec3& n) {
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = n.unitOrthogonal();
  basis.col(1) = n.cross(basis.col(0));
  return basis;
}

}  // namespace

/// The function f near a normal: slope along two principal directions of the tangent
/// plane, and minus its second derivatives along them, the larger first.
struct FactoredPair::Tangent {
  double gap;
  Vec3 direction[2];
  double slope[2];
  double curvature[2];
  double curvature_noise;
};

FactoredPair::FactoredPair(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d,
                           bool nested) noexcept
    : factor_a_(a.rotation() * a.semi_axes().asDiagonal()),
      factor_b_(b.rotation() * b.semi_axes().asDiagonal()),
      d_(d),
      size_(d.norm() + a.largest_semi_axis() + b.largest_semi_axis()),
      sign_b_(nested ? -1.0 : 1.0) {}

double FactoredPair::value(const Vec3& normal) const noexcept {
  return normal.dot(d_) - length(factor_a_.transpose() * normal) -
         sign_b_ * length(factor_b_.transpose() * normal);
}

Vec3 FactoredPair::axis(int i) const noexcept {
  const Vec3 direction = (i < 3 ? factor_a_.col(i) : factor_b_.col(i - 3)).stableNormalized();
  return direction.dot(d_) < 0.0 ? Vec3(-direction) : direction;
}

Vec3 FactoredPair::perram_wertheim_normal() const noexcept {
  // v(l) = (M_A + l M_B)^-1 d from the QR decomposition of [A'; sqrt(l) B']; the level |A'v|^2 of A
  // falls below the level l^2 |B'v|^2 of B where l passes the maximiser.
  const auto solve = [&](double log2_l) -> Vec3 {
    Eigen::Matrix<double, 6, 3> stacked;
    stacked.topRows<3>() = factor_a_.transpose();
    stacked.bottomRows<3>() = std::exp2(0.5 * log2_l) * factor_b_.transpose();
    const Eigen::HouseholderQR<Eigen::Matrix<double, 6, 3>> qr(stacked);
    const auto r = qr.matrixQR().topRows<3>().triangularView<Eigen::Upper>();
    return r.solve(r.transpose().solve(d_)).stableNormalized();
  };
  const auto beyond = [&](double log2_l) {
    const Vec3 v = solve(log2_l);
    return (factor_a_.transpose() * v).norm() <
           std::exp2(log2_l) * (factor_b_.transpose() * v).norm();
  };
  constexpr double kWidest = 1000.0;      // of log2 l: beyond it exp2 leaves the range of doubles
  constexpr double kNarrowest = 0x1p-10;  // chosen: the ascent that follows does the rest
  double width = 4.0, low = -width, high = width;
  while (low > -kWidest && beyond(low)) high = low, low -= (width *= 2.0);
  while (high < kWidest && !beyond(high)) low = high, high += (width *= 2.0);
  while (high - low > kNarrowest) {
    const double middle = 0.5 * (low + high);
    (beyond(middle) ? high : low) = middle;
  }
  return solve(0.5 * (low + high));
}

FactoredPair::Tangent FactoredPair::tangent(const Vec3& n) const noexcept {
  const Bodyside a = side(factor_a_, n), b = side(factor_b_, n);
  const Vec3 rest = d_ - a.point - sign_b_ * b.point;
  Tangent t;
  t.gap = n.dot(d_) - a.h - sign_b_ * b.h;
  // Hess h = (A P A')/h with P = I - y y'; on the tangent basis E that is |P A' E|^2 / h, which
  // keeps its relative accuracy where M/h - x x'/h would cancel.
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(n);
  const auto hessian_of = [&](const Mat3& factor, const Bodyside& s) {
    Eigen::Matrix<double, 3, 2> e = factor.transpose() * basis;
    e -= s.y * (s.y.transpose() * e).eval();
    return Eigen::Matrix2d(e.transpose() * e / s.h);
  };
  const Eigen::Matrix2d of_a = hessian_of(factor_a_, a), of_b = hessian_of(factor_b_, b);
  const Eigen::Matrix2d hessian = of_a + sign_b_ * of_b;
  const double mean = 0.5 * hessian.trace();
  const double difference = 0.5 * (hessian(0, 0) - hessian(1, 1));
  const double spread = std::hypot(difference, hessian(0, 1));
  const double angle = 0.5 * std::atan2(hessian(0, 1), difference);
  const double c = std::cos(angle), s = std::sin(angle);
  t.direction[0] = c * basis.col(0) + s * basis.col(1);
  t.direction[1] = c * basis.col(1) - s * basis.col(0);
  t.curvature[0] = mean + spread + t.gap;
  t.curvature[1] = mean - spread + t.gap;
  const double bend = sign_b_ > 0.0 ? 2.0 * mean : of_a.trace() + of_b.trace();
  t.curvature_noise = 16.0 * kUnitRoundoff * (bend + std::abs(t.gap));
  for (int i = 0; i < 2; ++i) t.slope[i] = t.direction[i].dot(rest);
  return t;
}

Stationary FactoredPair::climb(const Vec3& start) const noexcept {
  Vec3 n = start;
  const double enough = 0.25 * kUnitRoundoff * size_;  // a quarter of the rounding of the values
  for (int step = 0; step < kClimbSteps; ++step) {
    const Tangent t = tangent(n);
    Vec3 move = Vec3::Zero();
    double gain = 0.0;
    for (int i = 0; i < 2; ++i) {
      const double length = t.slope[i] / std::max(std::abs(t.curvature[i]), t.curvature_noise);
      gain += 0.5 * t.slope[i] * length;
      const bool saddle = t.curvature[i] < -t.curvature_noise && std::abs(length) < kEscape;
      move += (saddle ? std::copysign(kEscape, length) : length) * t.direction[i];
    }
    const bool concave = t.curvature[1] > -t.curvature_noise;
    if (concave && gain <= enough) {
      // Along a curve of ties a step is rounding over next to nothing: no improvement.
      return {move.norm() < kLastStep ? Vec3((n + move).normalized()) : n, true};
    }
    if (move.norm() > kLongestStep) move *= kLongestStep / move.norm();
    int halving = 0;
    for (; halving < kHalvings; ++halving, move *= 0.5) {
      const Vec3 next = (n + move).normalized();
      if (value(next) > t.gap) {
        n = next;
        break;
      }
    }
    // No step gains: the slope is rounding error, 8 u L wide, or n is no maximum.
    if (halving == kHalvings) return {n, concave && gain <= 16.0 * kUnitRoundoff * size_};
  }
  return {n, false};
}

}  // namespace tangency::inline v0::detail
