// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include <tangency/geometry/curvature.hpp>
#include <tangency/geometry/gap.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/manufactured.hpp>
#include <tangency/verify/oracles/gap.hpp>

namespace tangency {
namespace {

using verify::Real;
using verify::Real3;
using verify::to_ellipsoid;

constexpr double kU = kUnitRoundoff;
constexpr std::uint64_t kSeed = 20261122;
const Real kStep("1e-60");  // of differences, in units of the smallest semi-axis

Real dot(const Real3& a, const Real3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Real3 cross(const Real3& a, const Real3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Real3 real(const Vec3& v) { return {v[0], v[1], v[2]}; }
Real3 unit(const Real3& v) {
  const Real length = sqrt(dot(v, v));
  return {v[0] / length, v[1] / length, v[2] / length};
}

/// A surface at the point with outer normal n, in 200 digits.
struct Surface {
  Surface(const verify::Shape<Real>& s, const Real3& normal) : shape(s), n(normal) {
    Real hh = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Real along = shape.semi_axes[k] * dot(shape.axes[k], n);
      hh += along * along;
      for (std::size_t j = 0; j < 3; ++j) x[j] += shape.semi_axes[k] * along * shape.axes[k][j];
    }
    const Real h = sqrt(hh);
    for (Real& c : x) c /= h;
  }
  /// The bilinear form of the level function.
  Real form(const Real3& u, const Real3& v) const {
    Real sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      sum +=
          dot(shape.axes[k], u) * dot(shape.axes[k], v) / (shape.semi_axes[k] * shape.semi_axes[k]);
    }
    return sum;
  }
  /// The curvature towards e: how deep below the tangent plane the surface lies a small step away,
  /// times 2 / step^2.
  Real curvature(const Real3& e) const {
    const Real step =
        kStep * std::min({shape.semi_axes[0], shape.semi_axes[1], shape.semi_axes[2]});
    Real3 p = x;
    for (std::size_t j = 0; j < 3; ++j) p[j] += step * e[j];
    // The smaller root z of |p - z n|^2 = 1 in the form.
    const Real a = form(n, n), b = form(p, n), c = form(p, p) - 1;
    const Real z = c / (b + sqrt(b * b - a * c));
    return 2 * z / (step * step);
  }

  const verify::Shape<Real>& shape;
  Real3 n, x{};
};

/// Principal values and direction of a tensor of the plane with basis (e_1, e_2), in 200 digits.
struct Truth {
  Real larger, smaller;
  Real3 direction;
};

Truth principal(const Real& xx, const Real& yy, const Real& xy, const Real3& e1, const Real3& e2) {
  const Real difference = (xx - yy) / 2, spread = sqrt(difference * difference + xy * xy);
  const Real angle = atan2(xy, difference) / 2, c = cos(angle), s = sin(angle);
  Truth truth{(xx + yy) / 2 + spread, (xx + yy) / 2 - spread, {}};
  for (std::size_t j = 0; j < 3; ++j) truth.direction[j] = c * e1[j] + s * e2[j];
  return truth;
}

/// Largest errors in units of u beta, directions' times (k_0 - k_1) / (k_0 + k_1).
struct Worst {
  double curvature = 0, direction = 0;

  void add(const PrincipalCurvatures& k, const Truth& truth, const Vec3& outward, double beta) {
    const auto relative = [](double value, const Real& t) {
      return std::abs(static_cast<double>(Real((value - t) / t)));
    };
    curvature = std::max({curvature, relative(k.curvature[0], truth.larger) / (kU * beta),
                          relative(k.curvature[1], truth.smaller) / (kU * beta)});
    const Real3 off = cross(real(k.direction[0]), truth.direction);
    const Real distinct = (truth.larger - truth.smaller) / (truth.larger + truth.smaller);
    direction = std::max(direction,
                         static_cast<double>(Real(sqrt(dot(off, off)) * distinct)) / (kU * beta));
    EXPECT_LE((k.direction[0].cross(k.direction[1]) - outward).norm(), 16 * kU);
    EXPECT_LE(std::abs(k.direction[0].norm() - 1), 8 * kU);
    EXPECT_GE(k.curvature[0], k.curvature[1] * (1 - 16 * kU));
  }
};

Worst compare(double aspect, double size_ratio, int count) {
  verify::ManufacturedContacts contacts({"curvature", verify::ContactFamily::Shape::drawn, aspect,
                                         size_ratio, verify::ContactFamily::GapUnit::rho, 0.5},
                                        kSeed);
  Worst worst;
  for (int i = 0; i < count; ++i) {
    const verify::ManufacturedContact c = contacts.next();
    const Ellipsoid a = to_ellipsoid(c.a), b = to_ellipsoid(c.b);
    const Vec3 n(c.normal[0], c.normal[1], c.normal[2]);
    const ContactCurvature k = contact_curvature(a, b, n);
    const double beta =
        std::max(a.largest_semi_axis() / a.support(n), b.largest_semi_axis() / b.support(n));

    const verify::Separation<Real> shapes = separation(real(c.a), real(c.b));
    const Real3 up = unit(real(n)), e1 = unit(real(Vec3(n.unitOrthogonal()))),
                e2 = unit(cross(up, e1));
    const Real3 f1 = cross(e2, up);  // e1 made tangent to 200 digits
    Real3 half, down;
    for (std::size_t j = 0; j < 3; ++j) half[j] = (f1[j] + e2[j]) / sqrt(Real(2)), down[j] = -up[j];
    const Surface sa(shapes.a, up), sb(shapes.b, down);
    std::array<Real, 3> sum{};
    for (const Surface* s : {&sa, &sb}) {
      const Real xx = s->curvature(f1), yy = s->curvature(e2),
                 xy = s->curvature(half) - (xx + yy) / 2;
      worst.add(s == &sa ? k.a : k.b, principal(xx, yy, xy, f1, e2), s == &sa ? n : Vec3(-n), beta);
      sum[0] += xx, sum[1] += yy, sum[2] += xy;
    }
    worst.add(k.relative, principal(sum[0], sum[1], sum[2], f1, e2), n, beta);
  }
  std::printf(
      "aspect to %g, size ratio to %g, %d contacts: curvatures %.3g u beta, directions %.3g u "
      "beta\n",
      aspect, size_ratio, count, worst.curvature, worst.direction);
  return worst;
}

TEST(Curvature, IsThatOfTheDepthBelowTheTangentPlaneForEveryAspectTo1e8) {
  for (const double aspect : {1.43, 5.0, 1e3, 1e8}) {
    const Worst worst = compare(aspect, aspect > 10 ? 1e3 : 3, 500);
    EXPECT_LT(worst.curvature, 64) << aspect;
    EXPECT_LT(worst.direction, 8) << aspect;
  }
}

TEST(Curvature, AtTheEndsOfTheAxesIsTheSemiAxisOverTheSquaresOfTheOthers) {
  // Rotation and normal are exact here, so that aspect 1e8 costs no digit.
  const Vec3 r(1e8, 3, 1);
  const Ellipsoid body({7, 8, 9}, r);
  for (int k = 0; k < 3; ++k) {
    const PrincipalCurvatures c = surface_curvature(body, Vec3::Unit(k));
    const int l = (k + 1) % 3, m = (k + 2) % 3, sharp = r[l] < r[m] ? l : m,
              flat = r[l] < r[m] ? m : l;
    const double larger = r[k] / (r[sharp] * r[sharp]), smaller = r[k] / (r[flat] * r[flat]);
    EXPECT_NEAR(c.curvature[0] / larger, 1, 16 * kU) << k;
    EXPECT_NEAR(c.curvature[1] / smaller, 1, 16 * kU) << k;
    EXPECT_NEAR(std::abs(c.direction[0][sharp]), 1, 16 * kU) << k;
  }
}

TEST(Curvature, OfRimsAtASmallAngleIsThatOfTheAngle) {
  // Discs of radius 1 that touch rim to rim, their planes turned from each other about the normal
  // by an angle of tangent of half t: the sum of two tensors diag(1/c^2, 1), one turned, has the
  // smaller value 2 (1 + t^2/c^2) / (1 + t^2).
  for (int thin = 2; thin <= 60; thin += 5) {
    const double c = std::exp2(-thin);
    for (int half = 1; half <= 50; half += 7) {
      const double t = std::exp2(-half);
      const Vec3 axes(1, 1, c);
      const Ellipsoid a({0, 0, 0}, axes, {1, 2, 3, 4});
      // (1, 2, 3, 4) times (1, t, 0, 0), exactly.
      const Ellipsoid b({0, 0, 0}, axes, {1 - 2 * t, 2 + t, 3 + 4 * t, 4 - 3 * t});
      const Vec3 n = a.rotation().col(0);
      const double truth = 2 * (1 + (t / c) * (t / c)) / (1 + t * t);
      const double found = contact_curvature(a, b, n).relative.curvature[1];
      EXPECT_NEAR(found / truth, 1, 64 * kU) << "c = 2^-" << thin << ", t = 2^-" << half;
    }
  }
}

TEST(Curvature, OfTwoDiscsOfAspect1000WhoseRelativeCurvatureWasOffByRoundingOfRotations) {
  const Vec3 axes(1, 1, 0x1.0624dd2f1a9fcp-10);
  const Ellipsoid a(
      {0, 0, 0}, axes,
      {-0x1.00694062990dbp+0, -0x1.d74f97b178a0dp-2, 0x1.5a34d752e81e9p-2, 0x1.8fd36f9b6e3b4p-5});
  const Ellipsoid b(
      {0, 0, 0}, axes,
      {-0x1.bc15b3f65d8bap-1, -0x1.99b329a92b4c6p-2, 0x1.2c108d9b61ff7p-2, 0x1.56fb5a6cdbd5dp-5});
  const Vec3 n(0x1.a646c8360ed76p-1, -0x1.3a7b59e47b32bp-2, 0x1.e637ac14e37b5p-2);
  // in 100 digits.
  EXPECT_NEAR(contact_curvature(a, b, n).relative.curvature[1] / 6.2132069379195170, 1, 16 * kU);
}

TEST(Curvature, OfASphereIsOneOverItsRadiusInAnyTwoDirections) {
  const Ellipsoid ball({1, 2, 3}, {4, 4, 4}, {0.1, 0.9, -0.3, 0.4});
  const Vec3 n = Vec3(1, -2, 2) / 3;
  const PrincipalCurvatures c = surface_curvature(ball, n);
  for (const double k : c.curvature) EXPECT_NEAR(k, 0.25, 8 * kU);
  for (const Vec3& e : c.direction) EXPECT_LE(std::abs(e.dot(n)), 4 * kU);
  EXPECT_LE((c.direction[0].cross(c.direction[1]) - n).norm(), 8 * kU);
}

TEST(Curvature, OfTwoSpheresWhoseSmallerOneWasAboveTheLargerByRounding) {
  const Ellipsoid a({0, 0, 0}, Vec3::Constant(1.9896196208960126)),
      b({0.0940035504951506, 0.5979359294512615, 0.40012381397581454},
        Vec3::Constant(2.3872977182929884));
  const PrincipalCurvatures c = contact_curvature(a, b, signed_gap(a, b).normal).relative;
  EXPECT_GE(c.curvature[0], c.curvature[1]);
  for (const double k : c.curvature)
    EXPECT_NEAR(k, 1 / a.semi_axes()[0] + 1 / b.semi_axes()[0], 8 * kU);
}

TEST(Curvature, OfCrossedCylinderLikeBodiesIsThatOfASphereRelatively) {
  // Hertz: equal cylinders crossed at right angles touch in a circle.
  const Ellipsoid a({0, 0, 0}, {1e6, 1, 1}), b({0, 0, 2}, {1, 1e6, 1});
  const ContactCurvature c = contact_curvature(a, b, Vec3::UnitZ());
  for (const double k : c.relative.curvature) EXPECT_NEAR(k, 1 + 1e-12, 16 * kU);
  EXPECT_NEAR(std::abs(c.a.direction[0].y()), 1, 16 * kU);
  EXPECT_NEAR(std::abs(c.b.direction[0].x()), 1, 16 * kU);
}

// geometry/curvature.hpp (3)
TEST(Curvature, IsThatOfTheScaledBodiesAtScalesBeyondSquaresOfDoubles) {
  const Vec3 ra(1, 2, 3), rb(5, 1, 4), n = Vec3(2, 3, 6) / 7;
  const Eigen::Quaterniond q(0.3, 0.5, -0.2, 0.7);
  const ContactCurvature one = contact_curvature({{0, 0, 0}, ra, q}, {{0, 0, 0}, rb}, n);
  for (const double unit_length : {0x1p-600, 0x1p600}) {
    const ContactCurvature other =
        contact_curvature({{0, 0, 0}, unit_length * ra, q}, {{0, 0, 0}, unit_length * rb}, n);
    for (int i = 0; i < 2; ++i) {
      EXPECT_EQ(other.a.curvature[i] * unit_length, one.a.curvature[i]);
      EXPECT_EQ(other.relative.curvature[i] * unit_length, one.relative.curvature[i]);
      EXPECT_EQ(other.relative.direction[i], one.relative.direction[i]);
    }
  }
}

// Found by a fuzzer: a semi-axis of 2^-1074 was 0 in the unit of the other body, and ended the
// process.
TEST(Curvature, OfSemiAxesBeyondWhatIsPromisedIsNoNumberBelowZero) {
  const Ellipsoid a({0, 0, 0}, {3, 2, 1}), b({0, 0, 4}, {3, 0x1p-1074, 1});
  const Ellipsoid turned({0, 0, 4}, {3, 0x1p-1074, 1}, Eigen::Quaterniond(1, 2, 3, 4));
  for (const Ellipsoid& thin : {b, turned}) {
    const Vec3 normal = Vec3(2, 3, 6) / 7;
    for (const ContactCurvature& c :
         {contact_curvature(a, thin, normal), contact_curvature(thin, a, normal)}) {
      for (const double k : c.relative.curvature) EXPECT_GE(k, 0);
    }
  }
}

}  // namespace
}  // namespace tangency
