// SPDX-License-Identifier: GPL-3.0-or-later
// gap_error of what lanes answer has in it what docs/derivations/gap-batch.md derives: recomputed
// here from the bodies and the answer, in extended doubles. No error of a lane comes near enough to
// its bound for a constant that is too small to be noticed by the error itself.
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <random>
#include <vector>

#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/moving_bodies.hpp>
#include <tangency/tests/geometry/batch_pairs.hpp>

namespace tangency {
namespace {

using testing::at_every_level;
using testing::Columns;
using testing::Family;
using testing::Indexed;
using testing::kSeed;
using testing::same_bits;

using Wide = long double;
constexpr Wide kU = kUnitRoundoff;

class Pairs {
 public:
  explicit Pairs(std::uint64_t seed) : random_(seed) {}

  double real(double from, double to) {
    return from + (to - from) * (static_cast<double>(random_() >> 11) * 0x1p-53);
  }
  double power(double from, double to) { return std::exp2(real(from, to)); }
  Vec3 direction() { return Vec3(real(-1, 1), real(-1, 1), real(-1, 1)).normalized(); }
  Quaternion orientation() { return {real(-1, 1), real(-1, 1), real(-1, 1), real(0.1, 1)}; }
  Ellipsoid body(const Vec3& axes) { return {Vec3::Zero(), axes, orientation()}; }

  /// At gap `gap` along n, to rounding.
  static void place(Family& f, const Ellipsoid& a, const Ellipsoid& b, const Vec3& n, double gap) {
    f.a.push_back(a);
    f.b.push_back(b.moved_to(a.support_point(n) + b.support_point(n) + gap * n));
  }

 private:
  std::mt19937_64 random_;
};

double rho(const Ellipsoid& a, const Ellipsoid& b) { return a.least_radius() + b.least_radius(); }

/// Thin bodies, a/h of A from 2^11 on, on their faces: small gaps and wide ones.
Family faces(std::size_t count) {
  Family f{"faces", {}, {}};
  Pairs draw(kSeed);
  while (f.a.size() < count) {
    const double thin = draw.power(-18, -11);
    const Ellipsoid a = draw.body({draw.real(0.5, 1), 1, thin});
    const Ellipsoid b = draw.body({draw.real(0.3, 1), draw.real(0.3, 1), draw.real(0.3, 1)});
    const Vec3 n = (a.rotation().col(2) + 0.3 * thin * draw.direction()).normalized();
    Pairs::place(f, a, b, n, draw.power(-20, f.a.size() % 2 == 0 ? -2 : 8));
  }
  return f;
}

/// As deep as (B) proves anything, and above that by 2^low to 2^high of rho, log-uniformly.
Family at_the_edge(std::size_t count, double low, double high) {
  Family f{"at the edge", {}, {}};
  Pairs draw(kSeed + 1);
  while (f.a.size() < count) {
    const auto axes = [&] { return Vec3(1, draw.real(1, 2), draw.real(1, 2)); };
    const Ellipsoid a = draw.body(axes()), b = draw.body(axes());
    const double ball = draw.power(low, high);
    Pairs::place(f, a, b, draw.direction(), -rho(a, b) * (1 - ball));
  }
  return f;
}

/// The same of thin bodies on their faces, a/h of A from 2^11 to 2^14, where all but radii of
/// curvature is small.
Family faces_at_the_edge(std::size_t count, double low, double high) {
  Family f{"faces at the edge", {}, {}};
  Pairs draw(kSeed + 2);
  while (f.a.size() < count) {
    const double thin = draw.power(-14, -11);
    const Ellipsoid a = draw.body({1, draw.real(0.5, 1), thin});
    const Ellipsoid b = draw.body({draw.real(0.3, 0.4), draw.real(0.3, 0.4), 0.3});
    const Vec3 n = (a.rotation().col(2) + 0.3 * thin * draw.direction()).normalized();
    Pairs::place(f, a, b, n, -rho(a, b) * (1 - draw.power(low, high) / (thin * thin)));
  }
  return f;
}

/// What is asked of a pair and how: F of the derivation, and whether d is rounded inside.
struct Form {
  const char* name;
  Wide rotation;
  bool by_centres;
};

Wide largest_component(const Vec3& v, const Vec3& w) {
  Wide most = 0;
  for (int k = 0; k < 3; ++k) most = std::max(most, std::abs(Wide(v[k]) - w[k]));
  return most;
}

struct Derived {
  Wide value;  ///< (V)
  Wide above;  ///< what (B) adds: half of (9/16 |across|^2 + 9/2 e^2) / ball
};

/// The square of what of p_B - p_A is across the normal.
Wide across_squared(const Vec3& d, const Gap& gap) {
  Wide rest[3], along = 0, square = 0;
  for (int k = 0; k < 3; ++k) {
    rest[k] = Wide(d[k]) - gap.arm_a[k] + gap.arm_b[k];
    along += rest[k] * gap.normal[k];
  }
  for (int k = 0; k < 3; ++k) {
    const Wide part = rest[k] - along * gap.normal[k];
    square += part * part;
  }
  return square;
}

// What the radii of curvature are rounded down by in rows (geometry/batch/body_rows.hpp).
constexpr Wide kBelow = 1 - 0x1p-40L;

Derived derived(const Ellipsoid& a, const Ellipsoid& b, const Gap& gap, const Form& form) {
  const Vec3 d = b.centre() - a.centre();
  const Wide axes = Wide(a.largest_semi_axis()) + b.largest_semi_axis();
  const Wide size = std::abs(Wide(gap.gap)) - gap.gap_error;
  const Wide centres = form.by_centres ? 1.75L * largest_component(d, Vec3::Zero()) : 0;
  const Wide value = kU * ((13 + form.rotation) * axes + 2 * largest_component(d, gap.arm_a) +
                           10.8L * size + centres);
  const auto radius = [&](const Ellipsoid& e) {
    return Wide(e.largest_semi_axis()) * e.largest_semi_axis() / e.support(gap.normal);
  };
  const Wide e = kU * ((8 + form.rotation) * (radius(a) + radius(b)) + 32 * (axes + size));
  // The value less its error: the answer lies half of what (B) adds above the value.
  const Wide ball =
      (Wide(gap.gap) - gap.gap_error) + kBelow * (Wide(a.least_radius()) + b.least_radius());
  const Wide reach2 = 0.5L * (1.125L * across_squared(d, gap) + 9 * e * e);
  return {value, ball > 0 ? 0.5L * reach2 / ball : 0};
}

struct Seen {
  std::size_t lanes = 0;
  Wide least = 1e9L;    ///< gap_error over what is derived
  Wide most_above = 0;  ///< the share of (B) in it
};

/// Holds the answers that are not the single call's against the derivation.
Seen expect_bounds(const Family& f, const Columns& answers, const Form& form,
                   const std::vector<Gap>& single) {
  Seen seen;
  for (std::size_t i = 0; i < f.a.size(); ++i) {
    const Gap gap = answers[i];
    if (gap.status != GapStatus::ok || same_bits(gap, single[i])) continue;
    ++seen.lanes;
    const Derived least = derived(f.a[i], f.b[i], gap, form);
    const Wide sum = least.value + least.above;
    // Inverses in (B) are rough to 2^-13.
    EXPECT_GE(gap.gap_error, sum * (1 - 0x1p-10L)) << form.name << ' ' << i;
    seen.least = std::min(seen.least, gap.gap_error / sum);
    seen.most_above = std::max(seen.most_above, least.above / sum);
  }
  return seen;
}

void expect_bounds_in_every_form(const Family& f, const Accuracy& accuracy,
                                 const std::function<void(const Seen&)>& enough) {
  const Indexed in(f);
  std::vector<Vec3> axes, centres;
  std::vector<Quaternion> turns;
  for (const Ellipsoid& body : in.bodies) {
    axes.push_back(body.semi_axes());
    turns.push_back(body.orientation());
    centres.push_back(body.centre());
  }
  const PairList placed{in.pairs, {}}, apart{in.pairs, in.separations};
  std::vector<Gap> of_centres, of_separations;
  for (std::size_t i = 0; i < f.a.size(); ++i) {
    of_centres.push_back(signed_gap(f.a[i], f.b[i]));
    of_separations.push_back(signed_gap(f.a[i], f.b[i], in.separations[i]));
  }
  at_every_level([&] {
    const BodyArray array(in.bodies);
    const MovingBodies moving(axes, PoseColumns{turns, centres});
    const auto ask = [&](const auto& bodies, const PairList& list, const Form& form,
                         const std::vector<Gap>& single) {
      Columns answers(f.a.size());
      signed_gaps(bodies, list, answers.all(), accuracy);
      SCOPED_TRACE(form.name);
      enough(expect_bounds(f, answers, form, single));
    };
    ask(array, placed, {"array by centres", 0, true}, of_centres);
    ask(array, apart, {"array by separations", 0, false}, of_separations);
    ask(moving, placed, {"moving by centres", 10, true}, of_centres);
    ask(moving, apart, {"moving by separations", 10, false}, of_separations);
  });
}

// docs/derivations/gap-batch.md (V)
TEST(LaneBounds, HaveTheRoundingsOfTheValueOnFacesAndFarAway) {
  expect_bounds_in_every_form(faces(400), Accuracy::certified(), [](const Seen& seen) {
    EXPECT_GE(seen.lanes, 300u);
    EXPECT_LE(seen.least, 1.1);  // so nothing but what is derived makes gap_error large enough
  });
}

TEST(LaneBounds, HaveTheRoundingsOfTheValueAtTheEdgeOfTheProof) {
  expect_bounds_in_every_form(at_the_edge(600, -26, -22), Accuracy::certified(),
                              [](const Seen& seen) {
                                EXPECT_GE(seen.lanes, 200u);
                                EXPECT_LE(seen.least, 1.1);
                              });
}

// docs/derivations/gap-batch.md (R), (B): where a tolerance leaves room for it. Round bodies have
// in it their sizes, thin ones their radii of curvature.
TEST(LaneBounds, HaveTheErrorOfTheRestWhereTheBallIsSmall) {
  const auto expect_share = [](const Family& f, Wide share) {
    expect_bounds_in_every_form(f, {0.0, 0x1p-42, true}, [share](const Seen& seen) {
      EXPECT_GE(seen.lanes, 50u);
      EXPECT_LE(seen.least, 1.2L);
      EXPECT_GE(seen.most_above, share);
    });
  };
  expect_share(at_the_edge(600, -40, -38), 0.1L);
  expect_share(faces_at_the_edge(600, -54, -48), 0.9L);
}

// docs/derivations/gap-batch.md (B): where a tolerance leaves normals as they are found, and the
// ball is hardly more than the error of the value that is taken off it.
TEST(LaneBounds, HaveWhatABetterNormalMayGain) {
  for (const Family& f : {at_the_edge(600, -39.9, -38.5), at_the_edge(600, -30, -22)}) {
    expect_bounds_in_every_form(f, Accuracy::within(0x1p-30), [](const Seen& seen) {
      EXPECT_GE(seen.lanes, 50u);
      EXPECT_LE(seen.least, 1.1L);
      EXPECT_GE(seen.most_above, 0.9L);
    });
  }
}

/// Where a followed branch is, deeper than -rho: (D) of the derivation.
struct Branch {
  double least;  ///< G_1, of H + f across the normal
  double radii;  ///< R
  double thin;   ///< the larger a/h
};

Branch branch_at(const Ellipsoid& a, const Ellipsoid& b, const Vec3& n, double gap) {
  Mat3 bend = Mat3::Zero();
  Branch branch{0, 0, 0};
  for (const Ellipsoid* body : {&a, &b}) {
    const Vec3 x = body->support_point(n);
    const double h = body->support(n), most = body->largest_semi_axis();
    const Mat3 factor = body->rotation() * body->semi_axes().asDiagonal();
    bend += (factor * factor.transpose() - x * x.transpose()) / h;
    branch.radii += most * most / h;
    branch.thin = std::max(branch.thin, most / h);
  }
  Eigen::Matrix<double, 3, 2> across;
  across << n.unitOrthogonal(), n.cross(n.unitOrthogonal());
  const Eigen::Matrix2d flat = across.transpose() * bend * across;
  branch.least = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(flat).eigenvalues()[0] + gap;
  return branch;
}

/// Maxima deeper than -rho, and normals that have turned from there by 2^-30 to 2^-3.
Family branches(std::size_t count, std::vector<Vec3>& previous) {
  Family f{"branches", {}, {}};
  Pairs draw(kSeed + 3);
  while (f.a.size() < count) {
    const auto axes = [&] { return Vec3(1, draw.power(0, 3), draw.power(0, 3)); };
    const Ellipsoid a = draw.body(axes()), b = draw.body(axes());
    const Vec3 n = draw.direction();
    const double flattest = branch_at(a, b, n, 0).least, deepest = rho(a, b);
    if (flattest < 1.2 * deepest) continue;
    Pairs::place(f, a, b, n, -deepest - draw.real(0.1, 0.9) * (flattest - deepest));
    previous.push_back(n + draw.power(-30, -3) * n.cross(draw.direction()));
  }
  return f;
}

// docs/derivations/gap-batch.md (D)
TEST(LaneBounds, OfFollowedBranchesHoldOnlyInTheirCapAndHaveItsBound) {
  std::vector<Vec3> previous, axes;
  std::vector<Quaternion> turns;
  const Family f = branches(2000, previous);
  const Indexed in(f);
  for (const Ellipsoid& body : in.bodies) {
    axes.push_back(body.semi_axes());
    turns.push_back(body.orientation());
  }
  std::vector<Gap> single;
  for (std::size_t i = 0; i < f.a.size(); ++i)
    single.push_back(follow_gap(f.a[i], f.b[i], in.separations[i], previous[i]));
  at_every_level([&] {
    const MovingBodies bodies(axes, turns);
    Columns answers(f.a.size());
    follow_gaps(bodies, {in.pairs, in.separations}, previous, answers.all(),
                Accuracy::within(0x1p-3));
    Wide lanes = 0, nearest = 0, least = 1e9L;
    for (std::size_t i = 0; i < f.a.size(); ++i) {
      const Gap gap = answers[i];
      if (gap.status != GapStatus::local || same_bits(gap, single[i])) continue;
      const Branch branch = branch_at(f.a[i], f.b[i], gap.normal, gap.gap - gap.gap_error);
      const Wide rest2 = across_squared(in.separations[i], gap);
      const Wide g = 0.75L * branch.least;
      // 2 |r| a/h <= g G_1 / (4 R)
      const Wide share = 8 * std::sqrt(rest2) * branch.thin * branch.radii / (g * branch.least);
      EXPECT_LE(share, 1) << i;
      const Derived value = derived(f.a[i], f.b[i], gap, {"followed", 10, false});
      const Wide sum = value.value + 0.5L * 0.5625L * rest2 / g;
      EXPECT_GE(gap.gap_error, sum * (1 - 0x1p-10L)) << i;
      ++lanes;
      nearest = std::max(nearest, share), least = std::min(least, gap.gap_error / sum);
    }
    EXPECT_GE(lanes, 500);
    EXPECT_GE(nearest, 0.5L);
    EXPECT_LE(least, 1.3L);
    std::printf("%Lf %Lf %Lf\n", lanes, nearest, least);
  });
}

}  // namespace
}  // namespace tangency
