// SPDX-License-Identifier: GPL-3.0-or-later
/// `tangency-dem contacts` and `tangency-dem particles`: their tables against the state itself,
/// which is read here by the library and looked at pair by pair.
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/observe.hpp>
#include <tangency/dem/saved/state_file.hpp>
#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/vectors.hpp>

#include "../tool/process.hpp"
#include "csv_columns.hpp"
#include "scenes.hpp"

namespace tangency::testing {
namespace {

constexpr const char* kContactHeader =
    "a,b,ix,iy,iz,x,y,z,nx,ny,nz,gap,bx,by,bz,ax,ay,az,fn,fx,fy,fz,sliding,"
    "sx,sy,sz,vx,vy,vz,curvature_min,curvature_max";
constexpr const char* kParticleHeader =
    "id,type,x,y,z,r1,r2,r3,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,contacts,"
    "s_xx,s_yy,s_zz,s_xy,s_yz,s_zx";

/// Numbers of a table's rows, whose header is as wanted.
std::vector<std::vector<double>> numbers_of(const std::string& csv, const std::string& header) {
  std::istringstream in(csv);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, header);
  std::vector<std::vector<double>> rows;
  while (std::getline(in, line)) {
    auto& row = rows.emplace_back();
    for (const std::string& cell : cells_of(line)) row.push_back(std::stod(cell));
  }
  return rows;
}

Vec3 vector_at(const std::vector<double>& row, std::size_t first) {
  return {row[first], row[first + 1], row[first + 2]};
}

/// A sheared sample: spheroids that have friction and turned, in an order of space.
std::string sheared_scene(const std::string& stage_keys = "") {
  return with(small_scene(), "[output]\n",
              "[[stage]]\nkind = \"shear\"\nmean_stress = 10e6\naxial_strain_rate = 0.05\n"
              "axial_strain = 0.1\n" +
                  stage_keys + "[output]\ncontact_interval = 100000\n");
}

class Tables : public ::testing::Test {
 protected:
  /// Runs a scene and looks at the state of its end.
  void run(const std::string& scene) {
    const Finished ended = run_tool(
        {"run", folder_.write("scene.toml", scene), "--out", out_, "--quiet", "--replace"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    state_ = dem::load_state(file_);
  }
  std::string table(const std::string& command) const {
    const Finished ended = run_tool({command, file_});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(ended.err, "");
    return ended.out;
  }
  std::vector<std::vector<double>> contacts() const {
    return numbers_of(table("contacts"), kContactHeader);
  }
  const dem::Particles& particles() const { return state_.particles; }

  TemporaryFolder folder_;
  std::string out_ = folder_.path("out"), file_ = out_ + "/final.state";
  dem::State state_;
};

TEST_F(Tables, OfParticlesHoldTheirNumbersToTheBitByTheirIds) {
  run(sheared_scene());
  const auto rows = numbers_of(table("particles"), kParticleHeader);
  ASSERT_EQ(rows.size(), particles().size());
  EXPECT_FALSE(std::is_sorted(particles().id.begin(), particles().id.end()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& row = rows[static_cast<std::size_t>(particles().id[i])];
    EXPECT_EQ(row[0], particles().id[i]);
    EXPECT_EQ(row[1], particles().type[i]);
    EXPECT_EQ(vector_at(row, 2), particles().position[i]);
    EXPECT_EQ(vector_at(row, 5), particles().semi_axes[i]);
    const Quaternion& q = particles().orientation[i];
    EXPECT_EQ((std::vector<double>(row.begin() + 8, row.begin() + 12)),
              (std::vector<double>{q.w(), q.x(), q.y(), q.z()}));
    EXPECT_EQ(vector_at(row, 12), particles().velocity[i]);
    EXPECT_EQ(vector_at(row, 15), particles().angular_velocity[i]);
    EXPECT_EQ(row[18], state_.contacts.resultants().contacts[i]);
  }
}

// Every touching pair of the list, seen from the particle with the lower id, has its row, and no
// other row is there.
TEST_F(Tables, OfContactsHoldTheirNumbersToTheBit) {
  run(sheared_scene());
  const auto rows = contacts();
  using Name = std::array<double, 5>;
  std::map<Name, std::vector<double>> by_name;
  std::vector<Name> names;
  for (const auto& row : rows) {
    names.push_back({row[0], row[1], row[2], row[3], row[4]});
    by_name[names.back()] = row;
  }
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  std::size_t touching = 0, exchanged = 0;
  for (std::size_t k = 0; k < state_.list.pairs().size(); ++k) {
    const dem::Pair& pair = state_.list.pairs()[k];
    const dem::Contact contact = state_.contacts.records()[k];
    if (!contact.touches()) continue;
    ++touching;
    const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
    const bool turned = particles().id[a] > particles().id[b];
    exchanged += turned ? 1 : 0;
    const double sign = turned ? -1.0 : 1.0;
    Name name{static_cast<double>(particles().id[turned ? b : a]),
              static_cast<double>(particles().id[turned ? a : b])};
    for (std::size_t axis = 0; axis < 3; ++axis) name[2 + axis] = sign * pair.image[axis] + 0.0;
    ASSERT_TRUE(by_name.contains(name)) << k;
    const std::vector<double>& row = by_name[name];
    EXPECT_EQ(vector_at(row, 8), sign * contact.normal);
    EXPECT_EQ(row[11], -contact.overlap);
    EXPECT_EQ(vector_at(row, 12), sign * contact.branch);
    const Vec3 arm = turned ? Vec3(contact.arm - contact.branch) : contact.arm;
    EXPECT_EQ(vector_at(row, 15), arm);
    EXPECT_EQ(vector_at(row, 5), particles().position[turned ? b : a] + arm);
    EXPECT_EQ(row[18], contact.normal_force);
    EXPECT_EQ(vector_at(row, 19), sign * contact.force);
  }
  EXPECT_EQ(rows.size(), touching);
  EXPECT_GT(exchanged, 0u);
  EXPECT_LT(exchanged, touching);
}

// With the table of particles alone: where things are, and the stress.
TEST_F(Tables, BelongTogether) {
  run(sheared_scene());
  const auto bodies = numbers_of(table("particles"), kParticleHeader);
  Mat3 stress = Mat3::Zero();
  std::vector<double> counts(bodies.size(), 0.0);
  const double size = particles().semi_axes[0][0];
  for (const auto& row : contacts()) {
    const auto a = static_cast<std::size_t>(row[0]), b = static_cast<std::size_t>(row[1]);
    const Vec3 normal = vector_at(row, 8), branch = vector_at(row, 12), force = vector_at(row, 19);
    const Vec3 from_a =
        vector_at(bodies[b], 2) + state_.cell.edges * vector_at(row, 2) - vector_at(bodies[a], 2);
    EXPECT_LT((branch - from_a).norm(), 1e-12 * size);
    EXPECT_NEAR(normal.norm(), 1.0, 1e-14);
    EXPECT_NEAR(force.dot(normal), row[18], 1e-12 * force.norm());
    EXPECT_LT(row[11], 0.0);
    EXPECT_GT(row[18], 0.0);
    stress += force * branch.transpose() / state_.cell.volume();
    ++counts[a], ++counts[b];
  }
  for (std::size_t id = 0; id < bodies.size(); ++id) EXPECT_EQ(counts[id], bodies[id][18]) << id;
  const Mat3 wanted = dem::stress_of(state_.contacts, state_.cell).tensor;
  EXPECT_LT((0.5 * (stress + stress.transpose()) - wanted).norm(), 1e-12 * wanted.norm());
}

Mat3 symmetric_at(const std::vector<double>& row, std::size_t first) {
  Mat3 m;
  m << row[first], row[first + 3], row[first + 5],     //
      row[first + 3], row[first + 1], row[first + 4],  //
      row[first + 5], row[first + 4], row[first + 2];
  return m;
}

// dem/tool/contact_fields.hpp (3)
// Contacts with walls are in no row of contacts, and in the stresses of their particles.
TEST_F(Tables, HaveStressesOfParticlesThatAddUpToThatOfTheCell) {
  for (const std::string cell : {"[cell]\n", "[cell]\nwalls = \"xyz\"\n"}) {
    run(with(small_scene(), "[cell]\n", cell));
    Mat3 sum = Mat3::Zero();
    for (const auto& row : numbers_of(table("particles"), kParticleHeader))
      sum += dem::volume_of(vector_at(row, 5)) * symmetric_at(row, 19);
    const Mat3 wanted = dem::stress_of(state_.contacts, state_.cell).tensor;
    EXPECT_LT((sum / state_.cell.volume() - wanted).norm(), 1e-12 * wanted.norm()) << cell;
  }
}

// Of a row alone, and of two particles and the strain of the cell.
TEST_F(Tables, HaveTheShearForceAndTheVelocityAtTheContact) {
  run(sheared_scene());
  const auto bodies = numbers_of(table("particles"), kParticleHeader);
  ASSERT_FALSE(contacts().empty());
  for (const auto& row : contacts()) {
    EXPECT_LT((vector_at(row, 23) + row[18] * vector_at(row, 8) - vector_at(row, 19)).norm(),
              1e-12 * vector_at(row, 19).norm());
    EXPECT_LT(std::abs(vector_at(row, 23).dot(vector_at(row, 8))), 1e-12 * row[18]);
    const auto &a = bodies[static_cast<std::size_t>(row[0])],
               &b = bodies[static_cast<std::size_t>(row[1])];
    const Vec3 arm = vector_at(row, 15), branch = vector_at(row, 12);
    const Vec3 wanted = vector_at(b, 12) + state_.cell.rate * branch - vector_at(a, 12) +
                        vector_at(b, 15).cross(arm - branch) - vector_at(a, 15).cross(arm);
    EXPECT_LT((vector_at(row, 26) - wanted).norm(), 1e-12 * (1.0 + wanted.norm()));
  }
}

// dem/tool/contact_fields.hpp (2)
// Of spheres 1/r of both; of ellipsoids by Euler's formula, the surfaces' own curvatures add up.
TEST_F(Tables, HaveTheCurvatureOfTheDistance) {
  run(with(sheared_scene(), "elongation = 1.4\n", ""));
  for (const auto& row : contacts()) {
    EXPECT_NEAR(row[29], 0.2, 1e-14);
    EXPECT_NEAR(row[30], 0.2, 1e-14);
  }
  run(sheared_scene());
  const auto bodies = numbers_of(table("particles"), kParticleHeader);
  for (const auto& row : contacts()) {
    double sum = 0.0;  // of both surfaces' mean curvatures, twice
    for (const std::size_t which : {0u, 1u}) {
      const auto& body = bodies[static_cast<std::size_t>(row[which])];
      const Quaternion q(body[8], body[9], body[10], body[11]);
      const Vec3 axes = vector_at(body, 5), n = q.conjugate() * vector_at(row, 8);
      const Mat3 inverse = axes.cwiseAbs2().cwiseInverse().asDiagonal();
      const double support = axes.cwiseProduct(n).norm();
      sum += support * (inverse.trace() - n.dot(inverse * n));
    }
    EXPECT_NEAR(row[29] + row[30], sum, 1e-12 * sum);
    EXPECT_LE(row[29], row[30]);
  }
}

// Across the plane a disk is straight: of circles the outlines alone are curved.
TEST_F(Tables, HaveNoCurvatureAcrossThePlane) {
  run(with(with(sheared_scene(), "elongation = 1.4\n", ""), "[cell]\n",
           "[cell]\ndimensions = 2\n"));
  ASSERT_FALSE(contacts().empty());
  for (const auto& row : contacts()) {
    EXPECT_EQ(row[29], 0.0);
    EXPECT_NEAR(row[30], 0.2, 1e-14);
  }
}

// dem/tool/contact_fields.hpp (1)
// The gap of the two bodies a little later and a little earlier, as they move and turn.
TEST_F(Tables, HaveAVelocityWhoseNormalPartOpensTheGap) {
  run(sheared_scene());
  const auto bodies = numbers_of(table("particles"), kParticleHeader);
  double fastest = 0.0;
  for (const auto& row : contacts()) fastest = std::max(fastest, vector_at(row, 26).norm());
  ASSERT_GT(fastest, 0.0);
  const double step = 1e-5 * particles().semi_axes[0][0] / fastest;
  const auto moved = [&](double id, double time) {
    const auto& body = bodies[static_cast<std::size_t>(id)];
    const Vec3 turn = time * vector_at(body, 15);
    const Quaternion q(body[8], body[9], body[10], body[11]);
    const Eigen::AngleAxisd by(turn.norm(), turn.stableNormalized());
    return Ellipsoid(Vec3(0, 0, 0), vector_at(body, 5), Quaternion(by) * q.normalized());
  };
  for (const auto& row : contacts()) {
    const auto &a = bodies[static_cast<std::size_t>(row[0])],
               &b = bodies[static_cast<std::size_t>(row[1])];
    const Vec3 branch = vector_at(row, 12);
    const Vec3 parting = vector_at(b, 12) + state_.cell.rate * branch - vector_at(a, 12);
    const auto gap = [&](double time) {
      return signed_gap(moved(row[0], time), moved(row[1], time), branch + time * parting).gap;
    };
    EXPECT_NEAR((gap(step) - gap(-step)) / (2.0 * step), vector_at(row, 26).dot(vector_at(row, 8)),
                1e-5 * fastest);
  }
}

/// Sliding contacts and others; each is where its shear force says, by that coefficient.
std::pair<int, int> sliding_and_not(const std::vector<std::vector<double>>& rows, double friction) {
  std::pair<int, int> counts{0, 0};
  for (const auto& row : rows) {
    const Vec3 shear = vector_at(row, 19) - row[18] * vector_at(row, 8);
    const double share = shear.norm() / (friction * row[18]);
    EXPECT_LT(share, 1.0 + 1e-9);
    EXPECT_EQ(row[22], share > 1.0 - 1e-9 ? 1.0 : 0.0) << share;
    ++(row[22] == 1.0 ? counts.first : counts.second);
  }
  return counts;
}

TEST_F(Tables, TellWhichContactsSlide) {
  run(sheared_scene());
  const auto [sliding, sticking] = sliding_and_not(contacts(), 0.5);
  EXPECT_GT(sliding, 0);
  EXPECT_GT(sticking, 0);
}

// A state does not know the friction of a stage, and the run does.
TEST_F(Tables, OfARunTellWhichSlideByTheFrictionOfTheStage) {
  run(sheared_scene("friction_coefficient = 0.2\n"));
  const std::string table_of_run = out_ + "/contacts/" + std::to_string(state_.cycle) + ".csv";
  const std::string of_run = read_file(table_of_run);
  const auto rows = numbers_of(of_run, kContactHeader);
  EXPECT_GT(sliding_and_not(rows, 0.2).first, 0);
  EXPECT_EQ(sliding_and_not(contacts(), 0.5).first, 0);
  EXPECT_EQ(run_tool({"contacts", file_, "--friction", "0.2"}).out, of_run);
  for (const char* wrong : {"-0.1", "nan", "rough", ""}) {
    const Finished refused = run_tool({"contacts", file_, "--friction", wrong});
    EXPECT_EQ(refused.status, 2) << wrong;
    EXPECT_EQ(refused.out, "");
  }
  // A run that is over makes the same table elsewhere, and leaves it as it is.
  const std::string elsewhere = folder_.path("elsewhere");
  EXPECT_EQ(run_tool({"run", folder_.path("scene.toml"), "--out", elsewhere, "--quiet", "--resume",
                      file_})
                .status,
            0);
  EXPECT_EQ(read_file(elsewhere + "/contacts/" + std::to_string(state_.cycle) + ".csv"), of_run);
  const Finished again =
      run_tool({"run", folder_.path("scene.toml"), "--out", out_, "--quiet", "--resume", file_});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(read_file(table_of_run), of_run);
}

// dem/tool/contact_tables.hpp, laws_of(): on a ramp, at a stage's end, at its start and after the
// run.
TEST_F(Tables, OfAStateAreThoseOfTheRunByTheFrictionThatItsSceneTells) {
  const std::string text =
      with(sheared_scene("friction_coefficient = 0.1\nramp_strain = 0.06\nsave = true\n"
                         "save_strains = [0.03]\n"),
           "kind = \"relax\"\n", "kind = \"relax\"\nsave = true\nfriction_coefficient = 0.3\n");
  run(text);
  // Again, with a table of the very cycle of the state on the ramp.
  const auto half_way = dem::load_state(out_ + "/states/shear-0.03.state").cycle;
  run(with(text, "contact_interval = 100000", "contact_interval = " + std::to_string(half_way)));
  const std::string scene = folder_.path("scene.toml");
  for (const char* name :
       {"states/relax.state", "states/shear-0.03.state", "states/shear.state", "final.state"}) {
    const std::string state = out_ + "/" + name;
    const std::string cycle = std::to_string(dem::load_state(state).cycle);
    const std::string of_run = read_file(out_ + "/contacts/" + cycle + ".csv");
    EXPECT_EQ(run_tool({"contacts", state, "--scene", scene}).out, of_run) << name;
    EXPECT_NE(run_tool({"contacts", state}).out, of_run) << name;
    EXPECT_EQ(run_tool({"micro", state, "--scene", scene}).err, "") << name;
  }
  // Half of the ramp is done, from 0.3 to 0.1.
  const std::string half = out_ + "/states/shear-0.03.state";
  const auto rows = numbers_of(run_tool({"contacts", half, "--scene", scene}).out, kContactHeader);
  double friction = 0.0;
  for (const auto& row : rows)
    if (row[22] == 1.0) friction = std::max(friction, vector_at(row, 23).norm() / row[18]);
  EXPECT_NEAR(friction, 0.2, 1e-3);  // a cycle strains by 1e-4
  EXPECT_GT(sliding_and_not(rows, friction).first, 0);
}

TEST_F(Tables, KnowTheFrictionOfASceneThatTheRunChangedAndOfAStateFromAPipe) {
  run(sheared_scene("friction_coefficient = 0.2\n"));
  const std::string table_of_run = out_ + "/contacts/" + std::to_string(state_.cycle) + ".csv";
  const std::string of_run = read_file(table_of_run), state = read_file(file_);
  const std::string other = folder_.write("other.toml", sheared_scene());
  const std::vector<std::string> set{"--scene", other, "--set",
                                     "stage.shear.friction_coefficient=0.2"};
  for (const char* command : {"contacts", "micro"}) {
    std::vector<std::string> arguments{command, file_};
    arguments.insert(arguments.end(), set.begin(), set.end());
    const Finished of_file = run_tool(arguments);
    EXPECT_EQ(of_file.status, 0) << of_file.err;
    EXPECT_EQ(of_file.out == of_run, command == std::string("contacts"));
    arguments[1] = "/dev/stdin";
    const Finished of_pipe = run_tool(arguments, state);
    EXPECT_EQ(of_pipe.out, of_file.out) << command << of_pipe.err;
    EXPECT_EQ(of_pipe.err, "");
  }
  EXPECT_NE(run_tool({"contacts", file_, "--scene", other}).out, of_run);
  const Finished refused = run_tool({"contacts", file_, "--set", set.back()});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("--set: changes keys of a --scene"), refused.err.npos) << refused.err;
}

TEST_F(Tables, RefuseASceneThatIsNotTheStates) {
  run(sheared_scene());
  const std::string other =
      folder_.write("other.toml", with(sheared_scene(), "count = 27", "count = 28"));
  const Finished refused = run_tool({"contacts", file_, "--scene", other});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(
      refused.err.find("final.state: a state with particles.grain.count = 27; the scene has 28"),
      refused.err.npos)
      << refused.err;
  EXPECT_EQ(run_tool({"contacts", file_, "--scene", other, "--friction", "0.5"}).status, 2);
  EXPECT_EQ(run_tool({"micro", file_, "--scene", folder_.path("none.toml")}).status, 2);
}

TEST_F(Tables, LeaveOutContactsWithWalls) {
  run(with(small_scene(), "[cell]\n", "[cell]\nwalls = \"xyz\"\n"));
  std::size_t inner = 0, walls = 0;
  for (std::size_t k = 0; k < state_.list.pairs().size(); ++k)
    if (state_.contacts.touches(k))
      ++(static_cast<std::size_t>(state_.list.pairs()[k].b) < particles().size() ? inner : walls);
  EXPECT_GT(walls, 0u);
  EXPECT_EQ(contacts().size(), inner);
}

TEST_F(Tables, OfAStateWithoutContactsAreTheHeaderAlone) {
  run("schema = 1\n[particles.p]\ncount = 8\nmean_radius = 1.0\n[contact]\nnormal_stiffness = 1e6\n"
      "[[stage]]\nkind = \"place\"\n[[stage]]\nkind = \"servo\"\nduration = 1\n[output]\n");
  EXPECT_EQ(table("contacts"), std::string(kContactHeader) + "\n");
  EXPECT_EQ(numbers_of(table("particles"), kParticleHeader).size(), 8u);
}

TEST_F(Tables, GoToAFileWholeOrNotAtAll) {
  run(small_scene());
  const std::string file = folder_.path("table.csv");
  for (const std::string command : {"contacts", "particles"}) {
    const Finished ended = run_tool({command, file_, "--out", file});
    EXPECT_EQ(ended.status, 0);
    EXPECT_EQ(ended.out, "");
    EXPECT_EQ(read_file(file), table(command));
    const Finished full = [&] {
      const FileSizeLimit limit(100);
      return run_tool({command, file_, "--out", file});
    }();
    EXPECT_EQ(full.status, 2);
    EXPECT_EQ(full.err.find(file + ": "), 0u) << full.err;
    EXPECT_EQ(read_file(file), table(command));
  }
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"out", "scene.toml", "table.csv"}));
}

TEST_F(Tables, RefuseWhatIsNoStateInOneLine) {
  run(small_scene());
  std::string newer = read_file(file_), damaged = newer;
  newer[8] = 99;  // the version, after the 8 letters at the start
  damaged[damaged.size() / 2] ^= 1;
  const std::vector<std::pair<std::string, std::string>> cases{
      {folder_.path("none"), ": cannot be read: No such file or directory\n"},
      {out_, ": cannot be read: Is a directory\n"},
      {folder_.path("scene.toml"),
       ": no state of tangency-dem: final.state or checkpoint.state of a run\n"},
      {folder_.write("damaged", damaged), ": damaged: its hash is wrong\n"},
      {folder_.write("newer", newer), ": state of version 99: this program reads version "}};
  const std::string table = folder_.write("table.csv", "earlier");
  for (const std::string command : {"contacts", "particles"})
    for (const auto& [file, message] : cases) {
      const Finished ended = run_tool({command, file, "--out", table});
      EXPECT_EQ(ended.status, 2) << file;
      EXPECT_EQ(ended.out, "");
      EXPECT_EQ(ended.err.find(file + message), 0u) << ended.err;
      EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
      EXPECT_EQ(read_file(table), "earlier");
    }
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"contacts"}, {"particles"}, {"contacts", file_, "--out", ""}})
    EXPECT_EQ(run_tool(words).status, 2);
}

}  // namespace
}  // namespace tangency::testing
