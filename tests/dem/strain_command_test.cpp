// SPDX-License-Identifier: GPL-3.0-or-later
/// Average strain of packings that the simulator made, and what `tangency-dem micro` says of it.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/contact/contacts.hpp>
#include <tangency/dem/micromechanics/average_strain.hpp>
#include <tangency/dem/samples/sample.hpp>
#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/simulation.hpp>

#include "../tool/process.hpp"
#include "scenes.hpp"
#include "stages.hpp"

namespace tangency::testing {
namespace {

namespace mm = micromechanics;
using nlohmann::json;

constexpr double kExact = 1e-10;

/// A committed sample as particles.
dem::Particles plane_sample(const std::string& name) {
  std::ifstream file(std::string(TANGENCY_DATA) + "/plane_samples/" + name + ".csv");
  dem::Particles particles;
  particles.dimensions = 2;
  std::string line;
  while (std::getline(file, line)) {
    std::array<double, 6> x{};
    std::istringstream cells(line);
    std::size_t read = 0;
    for (std::string cell; read < 6 && std::getline(cells, cell, ','); ++read) {
      if (cell.empty() || (cell[0] != '-' && (cell[0] < '0' || cell[0] > '9'))) break;
      x[read] = std::stod(cell);
    }
    if (read < 6) continue;
    const double half = 0.5 * std::atan2(x[5], x[4]);
    particles.add(Vec3(x[0], x[1], 0.0), Quaternion(std::cos(half), 0.0, 0.0, std::sin(half)),
                  Vec3(x[2], x[3], x[3]), 1000.0, 0);
  }
  return particles;
}

struct Touching {
  std::vector<std::array<std::int64_t, 2>> bodies;
  std::vector<mm::PeriodicImage> image;
  std::vector<Vec3> arm;
};

Touching touching(const dem::Particles& particles, const dem::Cell& cell) {
  dem::NeighbourList list;
  list.build(particles, cell, 0.1);
  dem::Contacts contacts;
  contacts.update(particles, cell, list, {1, {{1.0, 0.0, 0.0, 0.0}}}, 0.0);
  Touching found;
  for (std::size_t k = 0; k < list.pairs().size(); ++k) {
    if (!contacts.touches(k)) continue;
    const dem::Pair& pair = list.pairs()[k];
    found.bodies.push_back({pair.a, pair.b});
    found.image.push_back(pair.image);
    found.arm.push_back(contacts.records()[k].arm);
  }
  return found;
}

struct Sample {
  const char* name;
  double cell;
  std::size_t contacts;
};
class PlaneSampleStrain : public ::testing::TestWithParam<Sample> {};

TEST_P(PlaneSampleStrain, PolygonsAndTrianglesOfDenseEllipsesHaveTheStrainOfTheCell) {
  const dem::Particles particles = plane_sample(GetParam().name);
  ASSERT_EQ(particles.size(), 1000u);
  const dem::Cell cell = dem::Cell::box(Vec3(GetParam().cell, GetParam().cell, 1.0), 2);
  const Touching contacts = touching(particles, cell);
  ASSERT_EQ(contacts.bodies.size(), GetParam().contacts);
  const mm::PeriodicCentres centres{particles.position, cell.edges, 2};
  std::mt19937_64 random(61);
  std::vector<Vec3> velocity;
  for (std::size_t i = 0; i < particles.size(); ++i)
    velocity.emplace_back(dem::uniform(random), dem::uniform(random), 0.0);
  Mat3 rate = Mat3::Zero();
  rate.topLeftCorner<2, 2>() << 0.3, -0.2, 0.7, -0.5;
  const mm::StrainMesh polygons =
      mm::polygon_mesh(centres, {contacts.bodies, contacts.image}, contacts.arm);
  const mm::StrainMesh triangles = mm::simplex_mesh(centres, mm::delaunay_simplices(centres));
  EXPECT_EQ(triangles.cells, 2000u);
  EXPECT_GT(polygons.centres, 900u);
  for (const mm::StrainMesh& mesh : {polygons, triangles})
    EXPECT_LT((mm::gradient_of(mesh, mm::velocity_differences(mesh, velocity, rate)) - rate).norm(),
              kExact);
}
INSTANTIATE_TEST_SUITE_P(Samples, PlaneSampleStrain,
                         ::testing::Values(Sample{"depth_5", 574.3903009547155, 2998},
                                           Sample{"depth_0_5", 589.288657624396, 2966},
                                           Sample{"depth_0_05", 590.7722960659952, 2960}),
                         [](const auto& sample) { return std::string(sample.param.name); });

/// Two states of one shear test, some cycles apart, as files.
struct TwoStates {
  TemporaryFolder folder;
  std::string older, later;

  explicit TwoStates(int dimensions) {
    const std::string text = with(growing_scene(dimensions), "[output]\n",
                                  "[[stage]]\nkind = \"shear\"\nmean_stress = 50e6\n"
                                  "axial_strain_rate = 0.05\naxial_strain = 0.5\n"
                                  "time_step_factor = 0.3\ndamping = 0.1\n[output]\n");
    dem::Simulation run = at_stage(text, 4);
    const auto go_on_and_save = [&](int cycles, const char* name) {
      for (int k = 0; k < cycles; ++k) run.step();
      dem::save_state(run.state(), folder.path(name));
      return folder.path(name);
    };
    older = go_on_and_save(300, "older.state");
    later = go_on_and_save(900, "later.state");
  }
  json report() const {
    const Finished done = run_tool({"micro", later, "--since", older, "--json", "-"});
    EXPECT_EQ(done.status, 0) << done.err;
    return json::parse(done.out)["average_strain"];
  }
};

Mat3 tensor(const json& rows) {
  Mat3 m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      m(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)].get<double>();
  return m;
}

class StrainOfStates : public ::testing::TestWithParam<int> {};

TEST_P(StrainOfStates, PartsAddUpToTheStrainOfTheCell) {
  const TwoStates states(GetParam());
  const json report = states.report();
  const dem::State older = dem::load_state(states.older), later = dem::load_state(states.later);

  const json& velocities = report["velocities"];
  const Mat3 rate = -later.cell.rate;
  ASSERT_GT(rate.norm(), 0.01);
  EXPECT_EQ(tensor(velocities["rate"]), Mat3(Mat3::Zero() + rate));
  ASSERT_EQ(velocities["nets"].size(), GetParam() == 2 ? 2u : 1u);
  for (const json& net : velocities["nets"]) {
    ASSERT_TRUE(net["why_not"].is_null()) << net["why_not"];
    EXPECT_LT((tensor(net["sum"]) - rate).norm(), kExact * rate.norm());
    Mat3 sum = Mat3::Zero();
    for (const char* part : {"normal", "elastic", "sliding", "rotation", "apart"})
      sum += tensor(net[part]);
    EXPECT_LT((sum - rate).norm(), kExact * rate.norm());
    for (const char* part : {"normal", "elastic", "sliding", "rotation"})
      EXPECT_GT(tensor(net[part]).norm(), 1e-4 * rate.norm()) << part;
    // Of all that spins the published sum is not the strain.
    EXPECT_GT((tensor(net["published"]) - rate).norm(), 1e-3 * rate.norm());
    EXPECT_LE(net["centres"].get<std::size_t>(), later.particles.size());
  }

  const json& since = report["displacements"];
  const Mat3 gradient = Mat3::Identity() - later.cell.edges * older.cell.edges.inverse();
  ASSERT_GT(gradient.norm(), 1e-3);
  EXPECT_LT((tensor(since["gradient"]) - gradient).norm(), 1e-15);
  EXPECT_EQ(since["since_cycle"], older.cycle);
  for (const json& net : since["nets"]) {
    ASSERT_TRUE(net["why_not"].is_null()) << net["why_not"];
    EXPECT_LT((tensor(net["sum"]) - gradient).norm(), kExact);
    Mat3 sum = Mat3::Zero();
    std::size_t edges = 0;
    for (const char* part : {"kept", "lost", "gained", "apart"}) {
      sum += tensor(net[part]["gradient"]);
      edges += net[part]["edges"].get<std::size_t>();
    }
    EXPECT_LT((sum - gradient).norm(), kExact);
    EXPECT_EQ(edges, net["edges"]);
    EXPECT_GT(net["kept"]["edges"], 0);
    if (net["net"] != "polygons") {
      EXPECT_GT(net["apart"]["edges"], 0);
    }
  }
}
// A cell in simple shear is described by other edges of the same lattice in between.
TEST(StrainSince, AcrossNewEdgesIsTheShearOfTheCell) {
  const std::string text = with(small_scene(), "[output]\n",
                                "[[stage]]\nkind = \"servo\"\nsimple_shear_rate = [1.0, 0.0, 0.0]\n"
                                "duration = 1000\n[output]\n");
  dem::Simulation run = at_stage(text, 3);
  const TemporaryFolder folder;
  for (int k = 0; k < 100; ++k) run.step();
  const dem::State older = run.state();
  dem::save_state(older, folder.path("older.state"));
  while (run.state().description.xy == older.description.xy) run.step();
  for (int k = 0; k < 10; ++k) run.step();
  dem::save_state(run.state(), folder.path("later.state"));
  const Finished done = run_tool(
      {"micro", folder.path("later.state"), "--since", folder.path("older.state"), "--json", "-"});
  ASSERT_EQ(done.status, 0) << done.err;
  const json since = json::parse(done.out)["average_strain"]["displacements"];
  Mat3 gradient = Mat3::Zero();
  gradient(0, 1) = run.state().time - older.time;
  EXPECT_LT((tensor(since["gradient"]) - gradient).norm(), 1e-12);
  for (const json& net : since["nets"]) {
    ASSERT_TRUE(net["why_not"].is_null()) << net["why_not"];
    EXPECT_LT((tensor(net["sum"]) - gradient).norm(), kExact);
    EXPECT_GT(net["kept"]["edges"], 0);
  }
  // Both ways of a reset, on images.
  const dem::Reset one{2, -1, 3}, two{-4, 5, 1};
  const dem::Image image{7, -2, 3};
  EXPECT_EQ(one.then(two).image(image), two.image(one.image(image)));
  EXPECT_EQ(one.inverse().image(one.image(image)), image);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, StrainOfStates, ::testing::Values(2, 3));

/// Disks on a square lattice that touch their four neighbours, at rest; `edit` gives them motion.
/// @param friction  0: contacts have no spring in shear
template <class Edit>
json strain_of_lattice(double friction, const Edit& edit) {
  dem::Simulation run = at_stage(
      "schema = 1\n[cell]\ndimensions = 2\n[particles.disk]\ncount = 16\nmean_radius = 1.0\n"
      "[contact]\nnormal_stiffness = 1e6\nfriction_coefficient = " +
          std::to_string(friction) +
          "\n[[stage]]\nkind = \"place\"\njitter = 0.0\n"
          "[[stage]]\nkind = \"compress\"\nmean_stress = 1e4\nmax_strain_rate = 0.05\n",
      2);
  dem::State state = run.state();
  EXPECT_EQ(state.contacts.totals().contacts, 32);
  for (std::size_t i = 0; i < state.particles.size(); ++i) {
    state.particles.velocity[i].setZero();
    state.particles.angular_velocity[i].setZero();
  }
  state.cell.rate.setZero();
  edit(state);
  const TemporaryFolder folder;
  dem::save_state(state, folder.path("lattice.state"));
  const Finished done = run_tool({"micro", folder.path("lattice.state"), "--json", "-"});
  EXPECT_EQ(done.status, 0) << done.err;
  return json::parse(done.out)["average_strain"]["velocities"]["nets"][0];
}

/// Is a part the tensor, and are all others 0? The second part may be minus it.
void expect_alone(const json& net, const std::string& part, const Mat3& wanted,
                  const std::string& against = "") {
  EXPECT_EQ(net["net"], "polygons");
  for (const char* name : {"normal", "elastic", "sliding", "rotation", "apart"}) {
    const Mat3 expected = name == part      ? wanted
                          : name == against ? Mat3(-wanted)
                                            : Mat3(Mat3::Zero());
    EXPECT_LT((tensor(net[name]) - expected).norm(), 1e-9 * wanted.norm()) << name;
  }
}

// Contacts lie along x and y: whatever the motion, each part is known.
TEST(StrainCommand, OfALatticePartsAreThoseOfItsMotion) {
  Mat3 opening = Mat3::Zero(), shear = Mat3::Zero(), turn = Mat3::Zero();
  opening.diagonal() << 0.3, -0.2, 0.0;
  shear(0, 1) = 0.5;
  turn(0, 1) = -0.7;
  turn(1, 0) = 0.7;
  expect_alone(strain_of_lattice(0.5, [&](dem::State& state) { state.cell.rate = opening; }),
               "normal", -opening);
  expect_alone(strain_of_lattice(0.5, [&](dem::State& state) { state.cell.rate = shear; }),
               "elastic", -shear);
  expect_alone(strain_of_lattice(0.0, [&](dem::State& state) { state.cell.rate = shear; }),
               "sliding", -shear);
  const auto spin = [&](dem::State& state) {
    for (Vec3& w : state.particles.angular_velocity) w[2] = turn(1, 0);
  };
  expect_alone(strain_of_lattice(0.5, spin), "rotation", -turn, "elastic");
  expect_alone(strain_of_lattice(0.5,
                                 [&](dem::State& state) {
                                   spin(state);
                                   state.cell.rate = turn;
                                 }),
               "rotation", -turn);
}

TEST(StrainCommand, TableHasTheStrainOfTheCellAndItsSum) {
  const TwoStates states(2);
  const Finished done = run_tool({"micro", states.later, "--since", states.older});
  ASSERT_EQ(done.status, 0) << done.err;
  for (const char* words :
       {"Average strain rate", " polygons, ", " triangles, ", "  rotation of particles",
        "Since cycle ", "cell, logarithmic", "  lost, "})
    EXPECT_NE(done.out.find(words), std::string::npos) << words;
}

TEST(StrainCommand, RefusesAStateThatIsNoEarlierOneOfTheSameParticles) {
  const TwoStates states(3);
  const auto refused = [](const std::vector<std::string>& words) {
    const Finished done = run_tool(words);
    EXPECT_EQ(done.status, 2);
    EXPECT_EQ(done.out, "");
    return done.err;
  };
  EXPECT_NE(refused({"micro", states.older, "--since", states.later})
                .find("later.state: a state of cycle "),
            std::string::npos);
  const std::string missing = states.folder.path("missing.state");
  EXPECT_NE(refused({"micro", states.later, "--since", missing}).find("missing.state"),
            std::string::npos);
  const dem::Simulation other(dem::parse_scene(small_scene(), "scene.toml"));
  const std::string file = states.folder.path("other.state");
  dem::save_state(other.state(), file);
  EXPECT_NE(refused({"micro", states.later, "--since", file})
                .find("other.state: a state of 27 particles"),
            std::string::npos);
}

TEST(StrainCommand, RefusesAStateOfOtherMasses) {
  const TemporaryFolder folder;
  const auto saved = [&](const char* name, const std::string& scene) {
    dem::save_state(dem::Simulation(dem::parse_scene(scene, "scene.toml")).state(),
                    folder.path(name));
    return folder.path(name);
  };
  const std::string state = saved("a.state", small_scene());
  const std::string other =
      saved("b.state", with(small_scene(), "mean_radius = 10.0", "mean_radius = 20.0"));
  const Finished done = run_tool({"micro", state, "--since", other});
  EXPECT_EQ(done.status, 2);
  EXPECT_NE(done.err.find("b.state: particle 0 has the mass "), std::string::npos) << done.err;
}

TEST(StrainCommand, SaysThatCellsWithWallsHaveNone) {
  TemporaryFolder folder;
  const dem::Simulation run(
      dem::parse_scene(with(small_scene(), "[cell]\n", "[cell]\nwalls = \"xyz\"\n"), "scene.toml"));
  dem::save_state(run.state(), folder.path("a.state"));
  const Finished done = run_tool({"micro", folder.path("a.state"), "--json", "-"});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_EQ(json::parse(done.out)["average_strain"]["why_not"],
            "nets are of cells that are periodic along every axis");
}

}  // namespace
}  // namespace tangency::testing
