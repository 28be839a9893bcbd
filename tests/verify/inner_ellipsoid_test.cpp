// SPDX-License-Identifier: GPL-3.0-or-later
// What inner_ellipsoid.hpp proves beside 150 digits, from good normals and from poor ones, which no
// ascent has mended.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>

#include <tangency/verify/families/families.hpp>
#include <tangency/verify/oracles/gap.hpp>
#include <tangency/verify/oracles/inner_ellipsoid.hpp>

namespace tangency::testing {
namespace {

using verify::Ball;
using verify::Ball3;
using verify::EllipsoidPair;
using verify::ProvenBody;
using verify::Real;
using verify::Real3;

constexpr std::uint64_t kSeed = 20261202;

class Draw {
 public:
  double real(double from, double to) { return from + (to - from) * unit_(engine_); }
  std::array<double, 3> direction() {
    std::array<double, 3> n{real(-1, 1), real(-1, 1), real(-1, 1)};
    const double length = std::hypot(n[0], n[1], n[2]);
    for (double& v : n) v /= length;
    return n;
  }

 private:
  std::mt19937_64 engine_{kSeed};
  std::uniform_real_distribution<double> unit_{0, 1};
};

Ball3 balls(const std::array<double, 3>& v) { return {Ball(v[0]), Ball(v[1]), Ball(v[2])}; }

// A symmetric matrix, exactly its doubles.
struct Symmetric {
  std::array<std::array<double, 3>, 3> rows{};

  std::array<Ball3, 3> ball_rows() const {
    return {balls(rows[0]), balls(rows[1]), balls(rows[2])};
  }
  // Of least * thin thin' and what is 1 across it.
  static Symmetric of(const std::array<double, 3>& thin, double least) {
    Symmetric k;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = i; j < 3; ++j) {
        k.rows[i][j] = k.rows[j][i] = (i == j ? 1 : 0) + (least - 1) * (thin[i] * thin[j]);
      }
    }
    return k;
  }
  // K^-1 d by Cramer's rule.
  Real3 solved(const Real3& d) const {
    const auto cross = [](const Real3& a, const Real3& b) -> Real3 {
      return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    std::array<Real3, 3> k;
    for (std::size_t i = 0; i < 3; ++i) std::ranges::copy(rows[i], k[i].begin());
    const std::array<Real3, 3> adjugate{cross(k[1], k[2]), cross(k[2], k[0]), cross(k[0], k[1])};
    const Real determinant =
        k[0][0] * adjugate[0][0] + k[0][1] * adjugate[0][1] + k[0][2] * adjugate[0][2];
    Real3 x;
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] = (adjugate[i][0] * d[0] + adjugate[i][1] * d[1] + adjugate[i][2] * d[2]) / determinant;
    }
    return x;
  }
};

TEST(InverseForm, IsBoundedFromWhateverVectorAndCloseNearTheRightOne) {
  Draw draw;
  for (int i = 0; i < 300; ++i) {
    const auto thin = draw.direction(), direction = draw.direction();
    const Symmetric k = Symmetric::of(thin, std::exp2(draw.real(-20, 2)));
    const Real3 d{direction[0], direction[1], direction[2]};
    const Real3 solution = k.solved(d);
    const Real form = solution[0] * d[0] + solution[1] * d[1] + solution[2] * d[2];
    for (const double off : {0.0, 0x1p-30, 0x1p-4, 1.0}) {
      Ball3 v;
      for (std::size_t j = 0; j < 3; ++j) {
        v[j] =
            Ball(solution[j].convert_to<double>() * (1 + off * draw.real(-1, 1)) + off * thin[j]);
      }
      const auto bound = verify::inverse_form(k.ball_rows(), balls(direction), v);
      ASSERT_TRUE(bound) << "seed " << kSeed << ", matrix " << i;
      EXPECT_GE(Real(bound->most()), form) << "seed " << kSeed << ", matrix " << i;
      if (off == 0) {
        EXPECT_LT(Real(bound->most()), form * (1 + Real(0x1p-50))) << i;
      }
    }
  }
}

TEST(InverseForm, IsNotSaidOfWhatIsNotProvenDefinite) {
  Draw draw;
  for (const double least : {-0x1p-3, -1.0, -0x1p-60, 0x1p-60}) {
    const auto thin = draw.direction(), d = draw.direction();
    const Symmetric k = Symmetric::of(thin, least);
    std::array<Ball3, 3> wide = k.ball_rows();
    for (std::size_t i = 0; i < 3; ++i) wide[i][i] = wide[i][i] + Ball(0, 0x1p-50);
    EXPECT_FALSE(verify::inverse_form(wide, balls(d), balls(d))) << least;
  }
  const std::array<Ball3, 3> opposite{balls({-1, 0, 0}), balls({0, -1, 0}), balls({0, 0, 1})};
  EXPECT_FALSE(verify::inverse_form(opposite, balls({0, 0, 1}), balls({0, 0, 1})));
}

// The bound of a pair at a normal as it stands, from a depth as it stands.
struct Deep {
  explicit Deep(const EllipsoidPair& pair)
      : truth(verify::signed_gap(pair.a, pair.b)), a(pair.a, 0), b(pair.b, 0) {
    for (std::size_t i = 0; i < 3; ++i) {
      d[i] = verify::in_unit(pair.b.centre[i], 0) - verify::in_unit(pair.a.centre[i], 0);
      best[i] = truth.normal[i].convert_to<double>();
    }
  }
  std::optional<Ball> depth_at(const std::array<double, 3>& n, double share) const {
    const Ball3 along = balls(n);
    const Ball depth = a.support(along) + b.support(along) - verify::inner(along, d);
    return verify::depth_by_inner_ellipsoid(a, b, d, along, Ball(share) * depth);
  }

  verify::GapTruth truth;
  ProvenBody a, b;
  Ball3 d;
  std::array<double, 3> best{};
};

TEST(InnerEllipsoid, IsNeverDeeperThanThePairWhateverNormalAndDepthAreSaid) {
  Draw draw;
  std::size_t bounds = 0, tight = 0, pairs = 0;
  for (const auto& family : verify::pair_families("deep")) {
    const auto next = family.sequence(kSeed);
    for (int i = 0; i < 3; ++i) {
      const Deep deep(next());
      ++pairs;
      const Real least = -deep.truth.gap - deep.truth.unproven;
      for (const double off : {0.0, 0x1p-20, 0x1p-8, 0x1p-3, 4.0}) {
        std::array<double, 3> n = deep.best;
        const auto away = draw.direction();
        for (std::size_t k = 0; k < 3; ++k) n[k] += off * away[k];
        const double length = std::hypot(n[0], n[1], n[2]);
        for (double& v : n) v /= length;
        for (const double share : {1.0, 1.25, 0.5, 0x1p-10}) {
          const auto depth = deep.depth_at(n, share);
          if (!depth) continue;
          ++bounds;
          EXPECT_LE(Real(depth->least()), -deep.truth.gap)
              << "seed " << kSeed << ", " << family.name << ", off " << off;
          tight += off == 0 && share == 1 && Real(depth->least()) >= least * (1 - Real(0x1p-50));
        }
      }
    }
  }
  EXPECT_GT(bounds, 2 * pairs);
  EXPECT_GT(2 * tight, pairs) << tight << " of " << pairs;
}

}  // namespace
}  // namespace tangency::testing
