// SPDX-License-Identifier: GPL-3.0-or-later
/// Cells that are too thin for their particles: the geometry, and runs that come to them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <tangency/dem/contact/thin_cell.hpp>
#include <tangency/dem/saved/state_file.hpp>

#include "../tool/process.hpp"
#include "assembly.hpp"
#include "scenes.hpp"

namespace tangency::testing {
namespace {

using namespace tangency::dem;

/// Turns this axis of a body along the line of this direction: half a turn about what bisects them.
Quaternion turn_along(Eigen::Index axis, const Vec3& direction) {
  const Vec3 from = Vec3::Unit(axis), to = direction.normalized();
  const Vec3 between = (from + (from.dot(to) < 0.0 ? Vec3(-to) : to)).normalized();
  return Quaternion(0.0, between.x(), between.y(), between.z());
}

/// The length of the shortest period among those of at most `most` edges along each axis.
double shortest_by_force(const Cell& cell, std::int32_t most) {
  double least = 1e300;
  Image m;
  for (m[0] = -most; m[0] <= most; ++m[0])
    for (m[1] = -most; m[1] <= most; ++m[1])
      for (m[2] = -most; m[2] <= most; ++m[2]) {
        bool is_period = m != Image{};
        for (std::size_t k = 0; k < 3; ++k)
          is_period = is_period &&
                      (m[k] == 0 || (!cell.walled[k] && static_cast<int>(k) < cell.dimensions));
        if (is_period) least = std::min(least, cell.translation(m).norm());
      }
  return least;
}

/// A box strained by a random matrix, not too flat.
Cell strained_cell(std::mt19937_64& random, int dimensions = 3) {
  for (;;) {
    Cell cell = Cell::box({1.0 + uniform(random), 1.0 + uniform(random), 1.0}, dimensions);
    for (int row = 0; row < dimensions; ++row)
      for (int column = 0; column < dimensions; ++column)
        cell.edges(row, column) += 0.6 * (2.0 * uniform(random) - 1.0);
    if (std::abs(cell.edges.determinant()) > 0.5) return cell;
  }
}

/// The same lattice by other edges: each is moved by up to three of the next.
Cell by_other_edges(Cell cell, std::mt19937_64& random) {
  for (int k = 0; k < cell.dimensions; ++k)
    cell.edges.col(k) +=
        std::floor(7.0 * uniform(random) - 3.0) * cell.edges.col((k + 1) % cell.dimensions);
  return cell;
}

TEST(ShortestPeriod, IsThatOfBruteForceForCellsOfAnySkew) {
  std::mt19937_64 random(71);
  int along_no_edge = 0;
  for (int k = 0; k < 300; ++k) {
    const int dimensions = k % 4 == 0 ? 2 : 3;
    const Cell plain = strained_cell(random, dimensions);
    const double shortest = shortest_by_force(plain, 13);
    const Cell skewed = by_other_edges(plain, random);
    for (const Cell& cell : {plain, skewed}) {
      ASSERT_NEAR(cell.translation(cell.shortest_period()).norm(), shortest, 1e-10) << k;
      EXPECT_LE(cell.heights().head(dimensions).minCoeff(), shortest * (1.0 + 1e-12));
    }
    along_no_edge += skewed.edges.colwise().norm().minCoeff() > 1.01 * shortest ? 1 : 0;
  }
  EXPECT_GT(along_no_edge, 100);
}

TEST(ShortestPeriod, IsAlongAnAxisWithoutWallsAndNotAlongTheThirdOfThePlane) {
  const Vec3 edges(3.0, 2.0, 1.0);
  EXPECT_EQ(Cell::box(edges).shortest_period(), (Image{0, 0, 1}));
  EXPECT_EQ(Cell::box(edges, 2).shortest_period(), (Image{0, 1, 0}));
  EXPECT_EQ(Cell::box(edges, 3, {false, true, true}).shortest_period(), (Image{1, 0, 0}));
  EXPECT_EQ(Cell::box(edges, 3, {true, true, true}).shortest_period(), (Image{}));
}

/// A period of the square lattice written with a long edge: its heights are a fifth of the period.
TEST(ShortestPeriod, IsNotThatOfTheHeightsWhereEdgesAreMovedByOthers) {
  Cell cell = Cell::box(Vec3::Ones());
  cell.edges(0, 1) = 5.0;
  EXPECT_NEAR(cell.translation(cell.shortest_period()).norm(), 1.0, 1e-15);
  EXPECT_LT(cell.heights().minCoeff(), 0.2);
}

/// No edge is shorter by any number of one other, and all three together are.
TEST(ShortestPeriod, MayTakeAllThreeEdges) {
  Cell cell = Cell::box(Vec3::Ones());
  cell.edges << 10.0, -4.0, -4.0, 0.0, 9.0, -7.0, 0.0, 0.0, 6.0;
  EXPECT_EQ(cell.translation(cell.shortest_period()).cwiseAbs(), Vec3(2.0, 2.0, 6.0));
  EXPECT_NEAR(shortest_by_force(cell, 5), std::sqrt(44.0), 1e-12);
}

struct Touching {
  NeighbourList list;
  Contacts contacts;

  Touching(const Particles& particles, const Cell& cell) {
    list.build(particles, cell, 0.1);
    contacts.carry_over({}, list.pairs());
    contacts.update(particles, cell, list, laws({1.0, 0.0, 0.0, 0.0}), 0.0);
  }
};

Vec3 random_axes(std::mt19937_64& random) {
  return 0.3 * Vec3::Ones() + Vec3(uniform(random), uniform(random), uniform(random));
}

/// `cell` enlarged or made smaller so that its shortest period has that length.
Cell scaled_to(Cell cell, double period) {
  cell.edges *= period / cell.translation(cell.shortest_period()).norm();
  return cell;
}

// dem/contact/thin_cell.hpp (1)
TEST(ThinCell, DoublesNoContactFromTheFreePeriodOnAndDoesSoonBelow) {
  std::mt19937_64 random(72);
  std::size_t doubled = 0;
  for (int k = 0; k < 400; ++k) {
    Cell cell = strained_cell(random);
    Particles particles;
    LeastCell least;
    for (int i = 0; i < 2; ++i) {
      const Vec3 axes = random_axes(random);
      particles.add(Vec3::Zero(), uniform_rotation(random), axes, 1.0, 0);
      least.add(axes);
    }
    cell = scaled_to(cell, least.free_period());
    // Between two images of the other, or nearly: where a contact is doubled first.
    const Vec3 half = 0.5 * cell.translation(cell.shortest_period());
    particles.position[1] = half + 1e-3 * random_axes(random);
    for (std::size_t i = 0; i < 2; ++i)  // the longest axis along the period
      if (k % 2 == 0) {
        Eigen::Index longest = 0;
        particles.semi_axes[i].maxCoeff(&longest);
        particles.orientation[i] = turn_along(longest, half);
      }
    for (const double share : {1.0 + 1e-9, 0.98}) {
      Cell now = cell;
      now.edges *= share;
      Particles there = particles;
      for (Vec3& x : there.position) x *= share;
      const Touching seen(there, now);
      LeastCell none_is_free;  // so that the contacts are looked at in any case
      none_is_free.add(Vec3::Constant(1e3));
      const auto found = doubled_contact(particles, seen.contacts, seen.list, now, none_is_free);
      doubled += found.has_value() ? 1u : 0u;
      if (share < 1.0) continue;
      ASSERT_FALSE(found) << k << ": " << found->what;
      ASSERT_FALSE(thin_place(now, least));
    }
  }
  EXPECT_GT(doubled, 150u) << "the bound is sharp: bodies along the period touch it at once";
}

// dem/contact/thin_cell.hpp (2)
TEST(ThinCell, BelowThePeriodHasPlacesWhereAContactIsDoubled) {
  std::mt19937_64 random(73);
  int its_own = 0, of_two = 0;
  for (int k = 0; k < 200; ++k) {
    Particles particles;
    LeastCell least;
    const int count = k % 5 == 0 ? 1 : 2;
    for (int i = 0; i < count; ++i) {
      particles.add(Vec3::Zero(), uniform_rotation(random), random_axes(random), 1.0, 0);
      least.add(particles.semi_axes.back());
    }
    Cell cell = strained_cell(random);
    cell = scaled_to(cell, (1.0 - 1e-6) * least.period());
    const Vec3 period = cell.translation(cell.shortest_period());
    const auto thin = thin_place(cell, least);
    ASSERT_TRUE(thin);
    EXPECT_NEAR(thin->length, period.norm(), 1e-12);
    if (least.is_of_one()) {
      const std::size_t i =
          count == 2 && particles.semi_axes[1].maxCoeff() > particles.semi_axes[0].maxCoeff();
      Eigen::Index longest = 0;
      particles.semi_axes[i].maxCoeff(&longest);
      particles.orientation[i] = turn_along(longest, period);
      EXPECT_NE(thin->what.find("an image of its own"), thin->what.npos);
      ++its_own;
    } else {
      EXPECT_NE(thin->what.find("two images of another"), thin->what.npos);
      ++of_two;
    }
    for (std::size_t i = 1; i < particles.size(); ++i) particles.position[i] = 0.5 * period;
    const Touching seen(particles, cell);
    EXPECT_TRUE(doubled_contact(particles, seen.contacts, seen.list, cell, least)) << thin->what;
  }
  EXPECT_GT(its_own, 30);
  EXPECT_GT(of_two, 50);
}

// dem/contact/thin_cell.hpp (3)
TEST(ThinCell, NearerWallsLeaveNoPlaceHoweverABodyIsTurned) {
  std::mt19937_64 random(74);
  for (int k = 0; k < 100; ++k) {
    const Vec3 axes = random_axes(random);
    LeastCell least;
    least.add(axes);
    const double apart = (1.0 - 1e-9) * least.wall_distance();
    const Cell cell = Cell::box({9.0, 9.0, apart}, 3, {false, false, true});
    EXPECT_TRUE(thin_place(cell, least));
    EXPECT_FALSE(thin_place(cell, least, kMostSqueeze));
    Particles particles;
    particles.add({4.0, 4.0, apart * uniform(random)}, uniform_rotation(random), axes, 1.0, 0);
    const Touching seen(particles, cell);
    const auto& records = seen.contacts.records();
    EXPECT_TRUE(std::any_of(records.begin(), records.end(),
                            [](const Contact& one) { return one.touches(); }));
  }
  LeastCell least;
  least.add(Vec3(3.0, 2.0, 1.0));
  EXPECT_FALSE(thin_place(Cell::box({9.0, 9.0, 2.0}, 3, {false, false, true}), least))
      << "a body that lies flat fits";
}

/// Balls of radius 1 between the given lines of a scene and its last stage.
std::string balls(const std::string& cell, const std::vector<Vec3>& at, const std::string& stage,
                  const std::string& shape = "mean_radius = 1.0\n") {
  std::string text = "schema = 1\n[cell]\n" + cell +
                     "[particles.ball]\ncount = " + std::to_string(at.size()) + "\n" + shape +
                     "[contact]\nnormal_stiffness = 1e6\n[[stage]]\nkind = \"place\"\n"
                     "arrangement = \"explicit\"\n";
  for (const Vec3& x : at)
    text += "[[body]]\ntype = \"ball\"\nposition = [" + std::to_string(x[0]) + ", " +
            std::to_string(x[1]) + ", " + std::to_string(x[2]) + "]\n";
  return text + "[[stage]]\n" + stage + "[output]\nhistory_interval = 20\nframe_interval = 0\n";
}

struct Ran {
  Finished run;
  std::string history;
};
Ran ran(const TemporaryFolder& folder, const std::string& scene,
        const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{
      "run", folder.write("scene.toml", scene), "--out", folder.path("out"), "--quiet", "--threads",
      "1"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  Ran result{run_tool(arguments), ""};
  if (std::filesystem::exists(folder.path("out/history.csv")))
    result.history = read_file(folder.path("out/history.csv"));
  return result;
}

/// Runs a scene whose cell becomes too thin; the one line that says so.
std::string stop_of(const std::string& scene) {
  const TemporaryFolder folder;
  const Ran stopped = ran(folder, scene);
  EXPECT_EQ(stopped.run.status, 1);
  EXPECT_EQ(std::count(stopped.run.err.begin(), stopped.run.err.end(), '\n'), 1) << stopped.run.err;
  EXPECT_GT(std::count(stopped.history.begin(), stopped.history.end(), '\n'), 2);
  EXPECT_FALSE(std::filesystem::exists(folder.path("out/summary.json")));
  // What is kept is sound, and going on from it ends in the same place with the same word.
  const std::string state = folder.path("out/checkpoint.state");
  EXPECT_NO_THROW(load_state(state));
  const std::string bytes = read_file(state);
  const Ran again = ran(folder, scene, {"--resume", state});
  EXPECT_EQ(again.run.status, 1);
  EXPECT_EQ(again.run.err, stopped.run.err);
  EXPECT_EQ(again.history, stopped.history);
  EXPECT_TRUE(read_file(state) == bytes);
  return stopped.run.err;
}

/// Is what one line says between these?
void expect_line(const std::string& line, const std::string& start, const std::string& end) {
  EXPECT_EQ(line.find("tangency-dem: stage " + start), 0u) << line;
  EXPECT_NE(line.find(end), line.npos) << line;
}

const std::vector<Vec3> kTwo = {{1.5, 1.5, 1.5}, {4.5, 4.5, 4.5}};

TEST(RunToAThinCell, ByServoStopsAtTheAxisThatShrinks) {
  expect_line(stop_of(balls("size = [6.0, 7.0, 8.0]\n", kTwo,
                            "kind = \"servo\"\nduration = 4000\nstrain_rate = [0.5, 0.0, 0.1]\n")),
              "servo stopped in cycle ",
              "the cell's period along x, 3.9856 m, is below 4 m, where a particle could touch two "
              "images of another; lower duration to 61\n");
}

// ln(6 sqrt(2) / 4) = 0.752: each edge is then longer than 9, and a diagonal is 4.
TEST(RunToAThinCell, ByShearOfTheCellStopsAtADiagonalThoughEachEdgeIsLong) {
  const std::string line =
      stop_of(balls("size = [6.0, 6.0, 9.0]\n", kTwo,
                    "kind = \"servo\"\nduration = 9000\nshear_rate = [0.5, 0.0, 0.0]\n"));
  expect_line(line, "servo stopped in cycle ", " of its edges, 3.99");
  EXPECT_TRUE(line.find("along (1, 1, 0)") != line.npos ||
              line.find("along (-1, -1, 0)") != line.npos)
      << line;
}

TEST(RunToAThinCell, OfThePlaneStopsAtTwoDiameters) {
  expect_line(
      stop_of(balls("dimensions = 2\nsize = [6.0, 7.0, 1.0]\n", {{1.5, 1.5, 0.0}, {4.5, 4.5, 0.0}},
                    "kind = \"shear\"\naxial_strain_rate = 0.5\naxial_strain = 2.0\n")),
      "shear stopped in cycle ", "the cell's period along y, 3.9");
}

TEST(RunToAThinCell, ByCompressionStopsWithTheNumberThatFillsAThickCell) {
  const std::string line = stop_of(balls("size = [6.0, 6.0, 6.0]\n", kTwo,
                                         "kind = \"compress\"\nmean_stress = 1e3\n"
                                         "max_strain_rate = 0.5\n"));
  expect_line(line, "compress stopped in cycle ", "is below 4 m, where");
  EXPECT_NE(line.find("; raise particles.ball.count to 16\n"), line.npos) << line;
}

TEST(RunToAThinCell, OfOneParticleStopsAtItsOwnImage) {
  expect_line(stop_of(balls("size = [6.0, 6.0, 6.0]\n", {{1.0, 1.0, 1.0}},
                            "kind = \"compress\"\nmean_stress = 1e3\nmax_strain_rate = 0.5\n")),
              "compress stopped in cycle ",
              " is below 2 m, where a particle could touch an image of its own; raise ");
}

// A ball may be squeezed, as it is by any load, but not to less than nine tenths.
TEST(RunToAThinCell, BetweenWallsStopsBelowNineTenthsOfAParticle) {
  const std::string walls = "size = [6.0, 6.0, 2.1]\nwalls = \"z\"\n";
  const std::string line =
      stop_of(balls(walls, {{3.0, 3.0, 1.05}},
                    "kind = \"servo\"\nduration = 9000\nstrain_rate = [0.0, 0.0, 0.5]\n"));
  expect_line(line, "servo stopped in cycle ",
              "the walls along z, 1.797 m apart, are nearer than 1.8 m, where the thickest "
              "particle has no place; lower duration to ");
  const TemporaryFolder folder;
  const Ran held = ran(folder, balls(walls, {{3.0, 3.0, 1.05}},
                                     "kind = \"servo\"\nduration = 9000\nstress_zz = 1e3\n"
                                     "max_strain_rate = 0.05\n"));
  EXPECT_EQ(held.run.status, 0) << held.run.err;
}

// Needles: none of the lengths says anything before they meet.
TEST(RunToAThinCell, StopsAtOnceWhereAContactIsDoubled) {
  const std::string line =
      stop_of(balls("size = [12.0, 6.5, 6.5]\n", {{3.0, 1.0, 1.0}, {9.0, 1.0, 1.0}},
                    "kind = \"servo\"\nduration = 9000\nstrain_rate = [0.5, 0.0, 0.0]\n",
                    "mean_radius = 1.0\nelongation = 4.0\n"));
  expect_line(line, "servo stopped in cycle ",
              ": particle 0 touches two images of particle 1, 10.0");
}

/// Particles compacted, then given other shapes by the keys of `growth`.
std::string grown(const std::string& cell, const std::string& particles,
                  const std::string& growth) {
  const std::string motion =
      "mean_stress = 50e6\nmax_strain_rate = 0.5\ntime_step_factor = 0.3\ndamping = 0.3\n"
      "stress_tolerance = 0.1\n";
  return "schema = 1\n[cell]\n" + cell + "[particles.grain]\nmean_radius = 10.0\n" + particles +
         "[contact]\nnormal_stiffness = 1.5e10\n[[stage]]\nkind = \"place\"\n"
         "[[stage]]\nkind = \"compress\"\n" +
         motion + "[[stage]]\nkind = \"grow\"\nincrements = 900\nmax_inertial_fraction = 0.1\n" +
         growth + motion + "[output]\nhistory_interval = 50\nframe_interval = 0\n";
}

// Disks into needles.
TEST(RunToAThinCell, ByGrowthStopsAndNamesTheElongationReached) {
  const std::string line =
      stop_of(grown("dimensions = 2\n", "count = 7\n", "elongation = 9.0\nflatness = 1.0\n"));
  expect_line(line, "grow stopped in cycle ", "; lower elongation to ");
  EXPECT_NE(line.find("or raise particles.grain.count to "), line.npos) << line;
  EXPECT_EQ(line.find("flatness"), line.npos) << line << ": as it is, 1, and in the plane no other";
}

TEST(RunToAThinCell, ByGrowthOfOneRatioWhileTheOtherShrinksNamesBoth) {
  const std::string line =
      stop_of(grown("", "count = 27\nelongation = 2.0\n", "elongation = 1.0\nflatness = 9.0\n"));
  expect_line(line, "grow stopped in cycle ", "; raise elongation to 1.");
  EXPECT_NE(line.find(" and lower flatness to "), line.npos) << line;
}

TEST(RunToAThinCell, ByShearKeepsTheResultsBeforeAndGoesOnUnderASceneThatEndsThere) {
  const TemporaryFolder folder;
  const std::string scene =
      read_file(std::string(TANGENCY_TEST_DATA) + "/scenes/shear-to-a-thin-cell.toml");
  const Ran stopped = ran(folder, scene);
  EXPECT_EQ(stopped.run.status, 1);
  const std::size_t at = stopped.run.err.find("tangency-dem: stage shear stopped in cycle ");
  ASSERT_NE(at, std::string::npos) << stopped.run.err;
  const std::string line = stopped.run.err.substr(at);
  EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1) << line;
  EXPECT_NE(line.find("the cell's period along z, 3.999"), line.npos) << line;
  EXPECT_NE(line.find(" at axial strain 0.8"), line.npos) << line;
  EXPECT_EQ(stopped.run.err.find("too soft"), std::string::npos);

  Simulation kept(parse_scene(scene, "scene.toml"),
                  load_state(folder.path("out/checkpoint.state")));
  EXPECT_GE(kept.state().cell.edges(2, 2), 4.0);
  EXPECT_LT(kept.state().cell.edges(2, 2), 4.001);
  EXPECT_LT(kept.observe().porosity, 0.5);
  EXPECT_EQ(state_hash(kept.state()), [&] {
    EXPECT_THROW(kept.step(), CellTooThin);
    return state_hash(kept.state());
  }());

  const Ran shorter = ran(folder, with(scene, "axial_strain = 3.0", "axial_strain = 0.81"),
                          {"--resume", folder.path("out/checkpoint.state")});
  EXPECT_EQ(shorter.run.status, 0) << shorter.run.err;
  EXPECT_EQ(shorter.history, stopped.history);
}

TEST(ThinStart, IsRefusedInOneLineThatNamesTheLength) {
  struct Case {
    std::string cell, message;
    std::vector<Vec3> at = kTwo;
    std::string shape = "mean_radius = 1.0\n";
  };
  const std::string servo = "kind = \"servo\"\nduration = 10\n";
  const std::string two = " is below 4 m, where a particle could touch two images of another";
  const std::vector<Case> cases{
      {"size = [9.0, 3.5, 9.0]\n",
       "scene.toml:3: cell.size = [ 9.0, 3.5, 9.0 ]: the cell's period along y, 3.5 m," + two},
      {"dimensions = 2\nsize = [3.9, 9.0, 1.0]\n",
       "scene.toml:4: cell.size = [ 3.9, 9.0, 1.0 ]: the cell's period along x, 3.9 m," + two,
       {{1.5, 1.5, 0.0}, {4.5, 4.5, 0.0}}},
      {"size = [9.0, 9.0, 1.9]\n",
       "scene.toml:3: cell.size = [ 9.0, 9.0, 1.9 ]: the cell's period along z, 1.9 m, is below 2 "
       "m, where a particle could touch an image of its own",
       {{1.0, 1.0, 1.0}}},
      {"size = [9.0, 9.0, 1.9]\nwalls = \"z\"\n",
       "scene.toml:3: cell.size = [ 9.0, 9.0, 1.9 ]: the walls along z, 1.9 m apart, are nearer "
       "than 2 m, where the thickest particle has no place"},
      {"size = [3.0, 9.0, 9.0]\nwalls = \"yz\"\n",
       "scene.toml:3: cell.size = [ 3.0, 9.0, 9.0 ]: the cell's period along x, 3 m," + two},
      {"size = [6.0, 9.0, 9.0]\n",
       "scene.toml:3: cell.size = [ 6.0, 9.0, 9.0 ]: the cell's period along x, 6 m, is below 8 m, "
       "where a particle could touch an image of its own",
       kTwo, "mean_radius = 1.0\nelongation = 8.0\n"}};
  for (const Case& one : cases)
    EXPECT_EQ(refusal(balls(one.cell, one.at, servo, one.shape)), one.message);
  EXPECT_EQ(refusal(balls("size = [3.0, 4.0, 4.0]\nwalls = \"x\"\n", kTwo, servo)), "");
  EXPECT_EQ(refusal("schema = 1\n[particles.p]\ncount = 2\nmean_radius = 1.0\n[contact]\n"
                    "normal_stiffness = 1e6\n[[stage]]\nkind = \"place\"\n"
                    "arrangement = \"random\"\n"),
            "scene.toml:7: stage[0]: the cell's period along x, 3.224 m," + two +
                "; bounding_fraction can be 0.13");
}

TEST(ThinStart, WithADoubledContactIsRefused) {
  const TemporaryFolder folder;
  const Ran refused = ran(
      folder, balls("size = [10.0, 6.5, 6.5]\n", {{2.5, 1.0, 1.0}, {7.5, 1.0, 1.0}},
                    "kind = \"servo\"\nduration = 10\n", "mean_radius = 1.0\nelongation = 4.0\n"));
  EXPECT_EQ(refused.run.status, 2);
  EXPECT_EQ(refused.run.err, folder.path("scene.toml") +
                                 ": particle 0 touches two images of particle 1, 10 m from each "
                                 "other\n");
  EXPECT_FALSE(std::filesystem::exists(folder.path("out")));
}

}  // namespace
}  // namespace tangency::testing
