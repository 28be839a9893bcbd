// SPDX-License-Identifier: GPL-3.0-or-later
//
// The corpora of points, walls, rays, matrices and floats say the truth: by second ways.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include <tangency/geometry/tables/csv.hpp>
#include <tangency/verify/answers/truth_table.hpp>
#include <tangency/verify/families/draw.hpp>
#include <tangency/verify/families/placing.hpp>
#include <tangency/verify/oracles/newton_ascent.hpp>
#include <tangency/verify/oracles/shape_matrix.hpp>

namespace tangency::verify {
namespace {

const std::string kFolder = TANGENCY_CORPORA "/";

struct Inputs {
  const tables::RowCursor& line;
  const tables::Header& header;

  double number(const std::string& column) const { return line.number(header.require(column)); }
  template <std::size_t n>
  std::array<double, n> numbers(const std::string& prefix,
                                const std::array<const char*, n>& names) const {
    std::array<double, n> all{};
    for (std::size_t k = 0; k < n; ++k) all[k] = number(prefix + names[k]);
    return all;
  }
  RawEllipsoid body() const {
    return {numbers<3>("a.", {"x", "y", "z"}), numbers<3>("a.", {"r1", "r2", "r3"}),
            numbers<4>("a.", {"qw", "qx", "qy", "qz"})};
  }
};

template <class Use>
void for_each_row(const std::string& corpus, const Use& use) {
  const TruthTable truth =
      read_truth(tables::Reader(kFolder + corpus + ".truth.csv"), Definition::common_normal);
  tables::Reader reader(kFolder + corpus + ".csv");
  std::size_t rows = 0;
  tables::for_each_row(reader, [&](const tables::RowCursor& line) {
    use(Inputs{line, reader.header()}, truth, truth.rows.at(line.index()));
    ++rows;
  });
  EXPECT_EQ(rows, truth.rows.size());
}

Real3 minus(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {Real(a[0]) - b[0], Real(a[1]) - b[1], Real(a[2]) - b[2]};
}

Real support(const RawEllipsoid& body, const Real3& n) {
  const RealEllipsoid exact = real(body);
  const Shape<Real> shape = separation(exact, exact).a;
  Real square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Real along = shape.semi_axes[k] * ascent::dot(shape.axes[k], n);
    square += along * along;
  }
  return sqrt(square);
}

// |diag(1/a) R' v|^2.
Real level(const RawEllipsoid& body, const Real3& v) {
  const RealEllipsoid exact = real(body);
  const Shape<Real> shape = separation(exact, exact).a;
  Real square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Real along = ascent::dot(shape.axes[k], v) / shape.semi_axes[k];
    square += along * along;
  }
  return square;
}

Real3 unit(const std::array<double, 3>& n) { return ascent::normalised(Real3{n[0], n[1], n[2]}); }

// The signed distance is the largest of n.(p - c) - h(n), outside as inside. A normal that is right
// to 1e-16 loses up to that squared times the bend, the radius of curvature or the distance.
TEST(PointCorpus, EveryTrueNormalReachesTheGapAndNoneOfAGridExceedsIt) {
  Draw draw(3);
  std::size_t ties = 0;
  for_each_row("points", [&](const Inputs& in, const TruthTable& truth, const TruthRow& row) {
    const RawEllipsoid body = in.body();
    const Real3 p = minus(in.numbers<3>("p.", {"x", "y", "z"}), body.centre);
    const Real gap = Real(row.gap.value().high) + row.gap->low;
    const auto f = [&](const Real3& n) { return Real(ascent::dot(n, p) - support(body, n)); };
    ties += row.every_normal || row.normals > 1;
    ASSERT_TRUE(row.every_normal || row.normals > 0);
    const double aspect = std::ranges::max(body.semi_axes) / std::ranges::min(body.semi_axes);
    for (std::size_t i = 0; i < row.normals; ++i) {
      const Real off = f(unit(truth.maximisers.at(row.first_normal + i).normal)) - gap;
      EXPECT_LT(abs(off), 1e-30 * aspect * aspect * row.size) << in.line.index();
    }
    for (int i = 0; i < 20; ++i) {
      EXPECT_LE(f(drawn_direction(draw)), gap + 1e-30 * row.size) << in.line.index();
    }
  });
  EXPECT_GT(ties, 30U);
}

TEST(WallCorpus, TheGapIsTheLowestPointsHeightAndItsSignIsTheRelations) {
  for_each_row("walls", [&](const Inputs& in, const TruthTable& truth, const TruthRow& row) {
    const RawEllipsoid body = in.body();
    const auto raw = in.numbers<3>("w.", {"nx", "ny", "nz"});
    const Real3 n{raw[0], raw[1], raw[2]};
    const Real length = sqrt(ascent::dot(n, n));
    const Real3 away = ascent::scaled(Real(1 / length), n);
    Real height = -Real(in.number("w.offset"));
    for (std::size_t k = 0; k < 3; ++k) height += n[k] * body.centre[k];
    const Real gap = height / length - support(body, away);
    EXPECT_LT(abs(gap - row.gap.value().high - row.gap->low), 1e-30 * row.size);
    EXPECT_EQ(row.gap->high > 0, row.relation == Relation::separate) << in.line.index();
    EXPECT_EQ(row.gap->high < 0, interiors_meet(row.relation)) << in.line.index();
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LT(abs(truth.maximisers.at(row.first_normal).normal[k] + away[k]), 1e-15);
  });
}

// A t of 106 bits is off by 2^-106 of itself, and the level by that over the least half-width.
TEST(RayCorpus, EveryTrueTIsOnTheSurfaceAndAMissIsOutside) {
  std::size_t on_surface = 0;
  for_each_row("rays", [&](const Inputs& in, const TruthTable&, const TruthRow& row) {
    const RawEllipsoid body = in.body();
    const Real3 from = minus(in.numbers<3>("r.", {"ox", "oy", "oz"}), body.centre);
    const auto d = in.numbers<3>("r.", {"dx", "dy", "dz"});
    const auto level_at = [&](const Real& t) {
      return level(body, {from[0] + t * d[0], from[1] + t * d[1], from[2] + t * d[2]});
    };
    const double widest = std::hypot(d[0], d[1], d[2]) * row.size;
    const Real allowed = 1e-30 * widest / std::ranges::min(body.semi_axes);
    EXPECT_EQ(row.times[0].has_value(), row.word != "miss");
    for (const auto& t : row.times) {
      if (!t) continue;
      EXPECT_GE(t->high, 0);
      EXPECT_LT(abs(level_at(Real(t->high) + t->low) - 1), allowed) << in.line.index();
      on_surface += t->high == 0;
    }
    if (row.word == "miss") {
      for (int i = 0; i <= 20; ++i) EXPECT_GT(level_at(Real(row.size) * i / 10), 1);
    }
  });
  EXPECT_GT(on_surface, 20U);
}

TEST(FloatCorpus, EveryNumberIsAFloat) {
  tables::Reader reader(kFolder + "float32.csv");
  tables::for_each_row(reader, [&](const tables::RowCursor& line) {
    for (std::size_t k = 0; k < reader.header().size(); ++k) {
      const double v = line.number(tables::Column{k});
      EXPECT_EQ(v, static_cast<double>(static_cast<float>(v))) << line.index();
    }
  });
}

/// R diag(a^2) R' without rounding: semi-axes are multiplied by |q|^2, with which the entries are
/// integers.
RawShapeMatrix shape_matrix(RawEllipsoid& body) {
  const auto& [w, x, y, z] = body.orientation;
  const double square = w * w + x * x + y * y + z * z;
  const std::array<std::array<double, 3>, 3> r{
      {{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
       {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
       {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}}};
  RawShapeMatrix shape{body.centre, {}};
  const std::array<std::array<std::size_t, 2>, 6> places{
      {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
  for (std::size_t k = 0; k < 6; ++k) {
    for (std::size_t e = 0; e < 3; ++e) {
      const double a = body.semi_axes[e];
      shape.entries[k] += a * a * r[places[k][0]][e] * r[places[k][1]][e];
    }
  }
  for (double& a : body.semi_axes) a *= square;
  return shape;
}

TEST(ShapeMatrix, ItsAxesGiveTheMatrixBackAndItsRelationIsThatOfTheEllipsoids) {
  Draw draw(4);
  int skewed = 0;
  for (int i = 0; i < 200; ++i) {
    std::array<RawEllipsoid, 2> body;
    std::array<RawShapeMatrix, 2> m;
    const bool upright = i % 2 == 0;  // of these many touch
    for (std::size_t k = 0; k < 2; ++k) {
      if (!upright) {
        do {
          for (double& part : body[k].orientation) part = draw.integer(-1, 2);
        } while (body[k].orientation == std::array<double, 4>{});
      }
      const int scale = upright ? 1 : 3;
      for (std::size_t j = 0; j < 3; ++j) {
        body[k].centre[j] = k == 0 ? 0 : scale * draw.integer(-4, 4);
        body[k].semi_axes[j] = draw.integer(1, 4);
      }
      m[k] = shape_matrix(body[k]);
    }
    EXPECT_EQ(exact_relation(m[0], m[1]), exact_relation(body[0], body[1])) << i;
    skewed += m[0].entries[3] != 0 && m[1].entries[3] != 0;
  }
  EXPECT_GT(skewed, 30);
  const RawShapeMatrix turned{{1, 2, 3}, {5, 7, 9, 1, -2, 3}};
  const Shape<Real> shape = separation(real(turned), real(turned)).a;
  const std::array<std::array<std::size_t, 2>, 6> places{
      {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
  for (std::size_t k = 0; k < 6; ++k) {
    const auto& [i, j] = places[k];
    Real sum = 0;
    for (std::size_t e = 0; e < 3; ++e)
      sum += shape.semi_axes[e] * shape.semi_axes[e] * shape.axes[e][i] * shape.axes[e][j];
    EXPECT_LT(abs(sum - turned.entries[k]), Real("1e-140"));
  }
}

TEST(ShapeMatrix, RefusesWhatIsNotPositiveDefinite) {
  const RawShapeMatrix sound{{0, 0, 0}, {1, 1, 1, 0, 0, 0}}, flat{{0, 0, 0}, {1, 1, 1, 1, 0, 0}};
  EXPECT_THROW(exact_relation(sound, flat), std::invalid_argument);
  EXPECT_THROW(real(flat), std::invalid_argument);
}

}  // namespace
}  // namespace tangency::verify
