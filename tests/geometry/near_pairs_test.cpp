// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <tangency/geometry/near_pairs.hpp>

namespace tangency {
namespace {

constexpr std::uint64_t kSeed = 20261130;

/// Numbers that are alike on every machine.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {
    ::testing::Test::RecordProperty("seed", std::to_string(seed));
  }
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
  }
  Vec3 vector(double low, double high) {
    const double x = between(low, high), y = between(low, high);
    return {x, y, between(low, high)};
  }

 private:
  std::mt19937_64 random_;
};

struct Balls {
  std::vector<Vec3> centres;
  std::vector<double> reaches;
};

/// Balls in and around the cell, of reaches from 1 to `ratio` by their logarithm, times `reach`.
Balls balls(Draw& draw, std::size_t count, const Mat3& edges, double reach, double ratio) {
  Balls all;
  for (std::size_t i = 0; i < count; ++i) {
    all.centres.push_back(edges * draw.vector(-1.0, 2.0));
    all.reaches.push_back(reach * std::pow(ratio, draw.between(0.0, 1.0)));
  }
  return all;
}

/// Every pair of images whose balls are apart by less than `apart`, by looking at all.
std::vector<NearPair> brute_force(const Balls& all, const Lattice& lattice, double apart = 0.0) {
  const Mat3 inverse = lattice.edges.inverse();
  std::vector<NearPair> pairs;
  for (std::uint32_t a = 0; a < all.centres.size(); ++a)
    for (std::uint32_t b = a; b < all.centres.size(); ++b) {
      const double reach = all.reaches[a] + all.reaches[b] + apart;
      const Vec3 d = all.centres[b] - all.centres[a];
      const Vec3 middle = -(inverse * d);
      std::array<std::int32_t, 3> low{}, high{};
      for (std::size_t k = 0; k < 3; ++k) {
        if (!lattice.periodic[k]) continue;
        const int axis = static_cast<int>(k);
        const double half = reach * inverse.row(axis).norm() + 0.01;
        low[k] = static_cast<std::int32_t>(std::floor(middle[axis] - half));
        high[k] = static_cast<std::int32_t>(std::ceil(middle[axis] + half));
      }
      LatticeImage image;
      for (image[0] = low[0]; image[0] <= high[0]; ++image[0])
        for (image[1] = low[1]; image[1] <= high[1]; ++image[1])
          for (image[2] = low[2]; image[2] <= high[2]; ++image[2]) {
            if (a == b && image <= LatticeImage{}) continue;
            const Vec3 at = d + lattice.edges * Vec3(image[0], image[1], image[2]);
            if (at.norm() <= reach) pairs.push_back({a, b, image});
          }
    }
  return pairs;
}

/// (1) and (2): all that meet, none that are apart, each once, in order.
void expect_all_and_no_others(const Balls& all, const Lattice& lattice, std::size_t at_least) {
  const auto found = near_pairs(all.centres, all.reaches, lattice);
  const auto meeting = brute_force(all, lattice);
  const double margin = NearPairSearch(all.centres, all.reaches, lattice).margin();
  const auto near = brute_force(all, lattice, 2.0 * margin);
  EXPECT_GE(meeting.size(), at_least);
  EXPECT_EQ(std::adjacent_find(found.begin(), found.end(), std::greater_equal<>()), found.end());
  EXPECT_TRUE(std::includes(found.begin(), found.end(), meeting.begin(), meeting.end()))
      << found.size() << " found, " << meeting.size() << " meet";
  EXPECT_TRUE(std::includes(near.begin(), near.end(), found.begin(), found.end()))
      << found.size() << " found, " << near.size() << " are near";
}

Mat3 skewed(double xy, double yz, double zx) {
  Mat3 edges;
  edges << 9.0, xy, zx, 0.0, 8.0, yz, 0.0, 0.0, 10.0;
  return edges;
}

// geometry/near_pairs.hpp (1) (2)
TEST(NearPairs, AreAllThatMeetForSizesFrom1To50) {
  Draw draw(kSeed);
  for (const double ratio : {1.0, 2.0, 5.0, 20.0, 50.0}) {
    SCOPED_TRACE(ratio);
    const Mat3 edges = Vec3(30.0, 40.0, 35.0).asDiagonal();
    expect_all_and_no_others(balls(draw, 300, edges, 2.0 / std::sqrt(ratio), ratio), {edges}, 200);
  }
}

// geometry/near_pairs.hpp (3)
TEST(NearPairs, AreAllThatMeetInSkewedCells) {
  Draw draw(kSeed + 1);
  for (const Mat3& edges : {skewed(3.0, -2.0, 4.0), skewed(-30.0, 5.0, 17.0),
                            Mat3(-skewed(100.0, 0.0, 0.0).transpose())}) {
    expect_all_and_no_others(balls(draw, 100, edges, 0.3, 4.0), {edges}, 20);
  }
}

// Turned as a whole, so that no edge lies along an axis.
TEST(NearPairs, AreAllThatMeetInATurnedCell) {
  Draw draw(kSeed + 2);
  const Mat3 edges =
      Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, -1.0).normalized()) * skewed(1.0, 2.0, 3.0);
  expect_all_and_no_others(balls(draw, 150, edges, 0.3, 5.0), {edges}, 50);
}

// geometry/near_pairs.hpp (3)
TEST(NearPairs, HoldOwnImagesInCellsSmallerThanABall) {
  Draw draw(kSeed + 3);
  for (const std::size_t count : {1u, 2u, 7u}) {
    const Mat3 edges = Vec3(0.8, 1.1, 5.0).asDiagonal();
    const Balls all = balls(draw, count, edges, 1.0, 3.0);
    expect_all_and_no_others(all, {edges}, 5);
    const auto found = near_pairs(all.centres, all.reaches, {edges});
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), [](const NearPair& p) {
      return p.a == p.b && p.image[2] == 0 && p.image > LatticeImage{};
    }));
  }
}

// geometry/near_pairs.hpp (3)
TEST(NearPairs, HaveNoImagesAlongOpenAxes) {
  Draw draw(kSeed + 4);
  for (unsigned bits = 0; bits < 8; ++bits) {
    SCOPED_TRACE(bits);
    Lattice lattice{skewed(1.0, 2.0, -1.0)};
    for (std::size_t k = 0; k < 3; ++k) lattice.periodic[k] = (bits >> k & 1u) != 0;
    const Balls all = balls(draw, 150, lattice.edges, 0.5, 8.0);
    expect_all_and_no_others(all, lattice, 50);
    for (const NearPair& pair : near_pairs(all.centres, all.reaches, lattice))
      for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(lattice.periodic[k] || pair.image[k] == 0);
  }
}

TEST(NearPairs, AreFoundInThePlane) {
  Draw draw(kSeed + 5);
  const Mat3 edges = Vec3(20.0, 30.0, 1.0).asDiagonal();
  Balls all = balls(draw, 200, edges, 0.5, 6.0);
  for (Vec3& centre : all.centres) centre[2] = 0.0;
  expect_all_and_no_others(all, {edges, {true, true, false}}, 50);
}

// Most boxes are empty, so that a table of all of them would not fit: those with bodies are hashed.
TEST(NearPairs, AreFoundInAHugeEmptyCell) {
  Draw draw(kSeed + 6);
  for (const double size : {1e3, 1e6, 1e12}) {
    SCOPED_TRACE(size);
    const Mat3 edges = size * Mat3::Identity();
    Balls all = balls(draw, 300, 10.0 * Mat3::Identity(), 0.5, 20.0);
    for (std::size_t i = 0; i < 100; ++i) {  // a second heap in the far corner
      all.centres.push_back(draw.vector(size - 4.0, size));
      all.reaches.push_back(draw.between(0.3, 0.5));
    }
    expect_all_and_no_others(all, {edges}, 300);
    expect_all_and_no_others(all, {edges, {false, true, false}}, 300);
    expect_all_and_no_others(all, Lattice::open(), 300);
  }
}

TEST(NearPairs, AreFoundFarFromTheCell) {
  Draw draw(kSeed + 7);
  const Mat3 edges = skewed(2.0, -3.0, 1.0);
  Balls all = balls(draw, 100, edges, 0.5, 4.0);
  for (Vec3& centre : all.centres)
    centre += edges * (1e6 * draw.vector(-1.0, 1.0)).array().round().matrix();
  expect_all_and_no_others(all, {edges}, 100);
}

TEST(NearPairs, OfBallsThatJustTouchAreListed) {
  Balls all;
  for (int x = 0; x < 6; ++x)
    for (int y = 0; y < 6; ++y) {
      all.centres.emplace_back(x, y, 0.0);
      all.reaches.push_back(0.5);
    }
  EXPECT_EQ(near_pairs(all.centres, all.reaches, {6.0 * Mat3::Identity()}).size(), 72u);
  EXPECT_EQ(near_pairs(all.centres, all.reaches).size(), 60u);
}

// 4 L - 1 is exact for L in [6, 7), and 3 L, which takes it into the cell, is not.
// geometry/near_pairs.hpp (1)
TEST(NearPairs, OfBallsThatJustTouchAreListedWhateverRounds) {
  Draw draw(kSeed + 9);
  const std::vector<double> halves(2, 0.5);
  for (int k = 0; k < 200; ++k) {
    const double length = draw.between(6.0, 7.0);
    const std::vector<Vec3> centres{{4.0 * length - 1.0, 0.0, 0.0}, Vec3::Zero()};
    const auto found = near_pairs(centres, halves, {length * Mat3::Identity()});
    ASSERT_EQ(found.size(), 1u) << length;
    EXPECT_EQ(found[0], (NearPair{0, 1, {4, 0, 0}}));
  }
}

// As of a run that blows up: coordinates along x are rounded to more than bodies and periods.
TEST(NearPairs, AreStillFoundWhereOneEdgeIsAsLongAsDoublesGo) {
  for (const double length : {1e20, 1e100, 1e300}) {
    const Mat3 edges = Vec3(length, 40.0, 40.0).asDiagonal();
    const std::vector<Vec3> centres{{0.5 * length, 1.0, 20.0}, {0.5 * length, 39.0, 20.0}};
    const auto found = near_pairs(centres, std::vector<double>(2, 1.5), {edges});
    // And nothing else, though the margin is as long as many cells.
    EXPECT_EQ(found, (std::vector<NearPair>{{0, 1, {0, -1, 0}}}));
  }
}

// A power of two changes no pair, whatever the squares of lengths would come to.
TEST(NearPairs, AreTheSameInAnyUnitOfLength) {
  Draw draw(kSeed + 10);
  const Mat3 edges = skewed(3.0, -2.0, 4.0);
  const Balls all = balls(draw, 200, edges, 0.5, 4.0);
  const Lattice half_open{edges, {true, false, true}};
  const auto closed = near_pairs(all.centres, all.reaches, {edges});
  const auto half = near_pairs(all.centres, all.reaches, half_open);
  const auto open = near_pairs(all.centres, all.reaches);
  EXPECT_GE(open.size(), 20u);
  for (const int power : {-1000, -700, -365, 365, 700, 1000}) {
    SCOPED_TRACE(power);
    const double unit = std::ldexp(1.0, power);
    Balls other = all;
    for (Vec3& centre : other.centres) centre *= unit;
    for (double& reach : other.reaches) reach *= unit;
    EXPECT_EQ(near_pairs(other.centres, other.reaches, {unit * edges}), closed);
    EXPECT_EQ(near_pairs(other.centres, other.reaches, {unit * edges, half_open.periodic}), half);
    EXPECT_EQ(near_pairs(other.centres, other.reaches), open);
    EXPECT_GE(NearPairSearch(other.centres, other.reaches, {unit * edges}).margin(), 0x1p-1022);
  }
}

// As the example before, in units in which a cell's volume is no double.
TEST(NearPairs, OfTwoBallsAcrossTheFaceOfATinyOrHugeCell) {
  for (const double length : {1e-300, 1e-110, 1e110, 1e300}) {
    SCOPED_TRACE(length);
    const std::vector<Vec3> centres{Vec3::Constant(0.5 * length), length * Vec3(0.5, 0.5, 0.9),
                                    length * Vec3(0.5, 0.5, 0.15)};
    const std::vector<double> reaches(3, 0.13 * length);
    const std::vector<NearPair> expected{{1, 2, {0, 0, 1}}};
    EXPECT_EQ(near_pairs(centres, reaches, {length * Mat3::Identity()}), expected);
  }
}

TEST(NearPairs, OfPointsAreThoseThatCoincide) {
  const std::vector<Vec3> points{{1.0, 2.0, 3.0}, {1.0, 2.0, 3.5}, {1.0, 2.0, 3.0}};
  const std::vector<double> none(3, 0.0);
  const auto found = near_pairs(points, none);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0], (NearPair{0, 2, {}}));
  EXPECT_TRUE(near_pairs({}, {}).empty());
  EXPECT_TRUE(near_pairs(std::span(points).first(1), std::span(none).first(1)).empty());
}

// A distance whose square is 0 in double is one all the same.
TEST(NearPairs, OfPointsThatAreCloseButApartAreNone) {
  const std::vector<double> none(2, 0.0);
  for (const double apart : {1e-320, 1e-200, 1e-170, 1.0, 1e170, 1e300}) {
    const std::vector<Vec3> points{Vec3::Zero(), Vec3(apart, 0.0, 0.0)};
    EXPECT_TRUE(near_pairs(points, none).empty()) << apart;
  }
}

// Nearer to each other than rounding: boxes of the width of a point would number 2^20 on each axis.
TEST(NearPairs, OfPointsWithinRoundingAreFoundAtOnce) {
  const double next = 1.0 + 0x1p-52;
  const std::vector<Vec3> two{Vec3::Ones(), Vec3::Constant(next)};
  const std::vector<double> none(400, 0.0);
  const std::vector<NearPair> pair{{0, 1, {}}};
  EXPECT_EQ(near_pairs(two, std::span(none).first(2)), pair);
  EXPECT_EQ(near_pairs(two, std::span(none).first(2), {3.0 * Mat3::Identity()}), pair);

  Draw draw(kSeed + 11);
  for (const double spread : {0.0, 1.0, 30.0, 1000.0}) {  // in units in the last place
    SCOPED_TRACE(spread);
    Balls all{{}, none};
    for (std::size_t i = 0; i < none.size(); ++i)
      all.centres.push_back(Vec3::Ones() + 0x1p-52 * draw.vector(0.0, spread));
    all.centres[7] = all.centres[300];
    expect_all_and_no_others(all, Lattice::open(), 1);
    expect_all_and_no_others(all, {3.0 * Mat3::Identity()}, 1);
  }
}

// geometry/near_pairs.hpp (4)
TEST(NearPairs, DoNotDependOnTheDivisionOfTheSearch) {
  Draw draw(kSeed + 8);
  const Mat3 edges = 20.0 * Mat3::Identity();
  const Balls all = balls(draw, 500, edges, 0.4, 20.0);
  const NearPairSearch search(all.centres, all.reaches, {edges});
  for (const std::size_t part : {1u, 7u, 100u}) {
    std::vector<std::vector<NearPair>> parts;
    for (std::size_t first = 0; first < search.size(); first += part)
      search.find(first, first + part, parts.emplace_back());
    EXPECT_EQ(sorted_pairs(parts, search.size()), near_pairs(all.centres, all.reaches, {edges}));
  }
}

TEST(NearPairs, RefuseWhatIsNoBallOrNoLattice) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec3> points{{0.0, 0.0, 0.0}, {1.0, nan, 0.0}};
  const std::vector<Vec3> sound(2, Vec3::Zero());
  const auto message = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  const std::vector<double> ones(2, 1.0), three(3, 1.0), negative{1.0, -1.0};
  EXPECT_EQ(message([&] { near_pairs(points, ones); }), "centres[1]: must be finite");
  EXPECT_EQ(message([&] { near_pairs(sound, negative); }), "reaches[1]: must be finite and >= 0");
  EXPECT_EQ(message([&] { near_pairs(sound, three); }),
            "reaches: 3 entries, and there are 2 centres");
  EXPECT_EQ(message([&] { near_pairs(sound, ones, {Mat3::Ones()}); }),
            "edges: must be finite and linearly independent");
  EXPECT_EQ(message([&] { near_pairs(sound, ones, {0x1p-30 * Mat3::Identity()}); }),
            "edges: the cell is 9.31323e-10 high, and a ball 2: at most 2^20 images");
  const Mat3 uneven = Vec3(1e300, 1e-20, 1.0).asDiagonal();
  EXPECT_EQ(message([&] { near_pairs(sound, ones, {uneven}); }),
            "edges: edge 1 is below 2^-1000 of the largest length");
  for (const double x : {1e9, -1e9}) {
    const std::vector<Vec3> far{{1.0, 0.0, 0.0}, {x, 0.0, 0.0}};
    EXPECT_EQ(message([&] { near_pairs(far, ones, {Mat3::Identity()}); }),
              "centres[1]: 1e+09 edges away: at most 2^29");
  }
  Mat3 steep = Mat3::Identity();
  steep.col(0) = Vec3(1e17, 1e17, 0.0);
  const std::vector<Vec3> lost(2, 0.5 * steep.col(0));
  EXPECT_TRUE(message([&] { near_pairs(lost, ones, {steep}); }).ends_with("by a cell"));
}

}  // namespace
}  // namespace tangency
