// SPDX-License-Identifier: GPL-3.0-or-later
/// `tangency-dem micro`, and micro.csv of a run.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/saved/state_file.hpp>
#include <tangency/geometry/vectors.hpp>

#include "../tool/process.hpp"
#include "csv_columns.hpp"
#include "scenes.hpp"

namespace tangency::testing {
namespace {

using Json = nlohmann::json;

/// A run of a scene, and what the command makes of its final state.
class Made {
 public:
  explicit Made(const std::string& scene) {
    const Finished run = run_tool({"run", folder_.write("scene.toml", scene), "--out",
                                   folder_.path("out"), "--quiet", "--threads", "1"});
    EXPECT_EQ(run.status, 0) << run.err;
  }
  std::string file(const std::string& name) const { return folder_.path(name); }
  std::string state() const { return folder_.path("out/final.state"); }

  Finished micro(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"micro", state()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_tool(arguments);
  }
  Json json(std::vector<std::string> more = {}) const {
    more.insert(more.end(), {"--json", "-"});
    const Finished finished = micro(std::move(more));
    EXPECT_EQ(finished.status, 0) << finished.err;
    return Json::parse(finished.out);
  }

 private:
  TemporaryFolder folder_;
};

/// Spheroids of two sizes, compacted, grown, relaxed and sheared with friction, with rows of
/// micro.csv.
std::string sheared_scene() {
  return with(with(growing_scene(3), "elongation = 1.2\n", "elongation = 1.3\n"), "[output]\n",
              "[[stage]]\nkind = \"shear\"\nmean_stress = 50e6\naxial_strain_rate = 0.05\n"
              "axial_strain = 0.02\ntime_step_factor = 0.3\n[output]\nmicro_interval = 100\n"
              "history_interval = 100\n");
}

/// Some 200 contacts.
const Made& spheroids() {
  static const Made made(sheared_scene());
  return made;
}

double number(const std::string& cell) { return std::strtod(cell.c_str(), nullptr); }

std::vector<double> numbers_of(const Json& nested) {
  if (nested.is_number()) return {nested.get<double>()};
  std::vector<double> all;
  for (const Json& part : nested)
    for (const double x : numbers_of(part)) all.push_back(x);
  return all;
}

/// Fails where a number of `found` is off its fellow by more than 1e-12 of the largest beside it.
void expect_near(const Json& found, const Json& expected, const std::string& where) {
  if (found.is_object()) {
    for (const auto& [key, value] : found.items()) {
      ASSERT_TRUE(expected.contains(key)) << where << key;
      expect_near(value, expected[key], where + key + "/");
    }
    return;
  }
  if (found.is_null()) {
    EXPECT_TRUE(expected.is_null()) << where;
    return;
  }
  const std::vector<double> x = numbers_of(found), y = numbers_of(expected);
  ASSERT_EQ(x.size(), y.size()) << where;
  double largest = 0.0;
  for (const double value : y) largest = std::max(largest, std::abs(value));
  ASSERT_GT(largest, 0.0) << where;
  for (std::size_t k = 0; k < x.size(); ++k)
    EXPECT_LT(std::abs(x[k] - y[k]), 1e-12 * largest) << where << k;
}

TEST(MicroCommand, TablesOfContactsAndParticlesGiveEveryTensorBack) {
  const Made& made = spheroids();
  const std::string contacts = made.file("contacts.csv"), particles = made.file("particles.csv");
  ASSERT_EQ(run_tool({"contacts", made.state(), "--out", contacts}).status, 0);
  ASSERT_EQ(run_tool({"particles", made.state(), "--out", particles}).status, 0);
  const std::string out = made.file("example.json");
  const std::string command = std::string("python3 '") + TANGENCY_EXAMPLES +
                              "/tensors_of_contacts.py' '" + contacts + "' '" + particles +
                              "' > '" + out + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const Json found = Json::parse(read_file(out)), all = made.json();
  ASSERT_GT(all["contacts"].get<int>(), 100);
  expect_near(found, all, "");
  for (const auto& [key, value] : all.items()) {
    const bool is_tensor = value.is_object() && value.contains("second");
    EXPECT_TRUE(!is_tensor || found.contains(key)) << key;
  }
  for (const char* estimator : {"published", "contact_sums"})
    for (const auto& [key, value] : all[estimator].items())
      EXPECT_TRUE(key == "stress_force_fabric" || found[estimator].contains(key)) << key;
}

TEST(MicroCommand, StressAndCountsAreThoseOfTheTable) {
  const Made& made = spheroids();
  const Json all = made.json();
  const Columns contacts = columns_of(run_tool({"contacts", made.state()}).out);
  const std::size_t count = contacts.at("a").size();
  const double volume = all["volume"];
  EXPECT_EQ(all["contacts"], count);
  EXPECT_EQ(all["particles"], 40);
  EXPECT_DOUBLE_EQ(all["contact_density"], 2.0 * static_cast<double>(count) / volume);
  EXPECT_DOUBLE_EQ(all["coordination_number"], 2.0 * static_cast<double>(count) / 40.0);
  const std::string force[] = {"fx", "fy", "fz"}, branch[] = {"bx", "by", "bz"};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      double sum = 0.0;
      for (std::size_t c = 0; c < count; ++c)
        sum += number(contacts.at(force[i])[c]) * number(contacts.at(branch[j])[c]);
      EXPECT_NEAR(all["stress"][i][j], sum / volume,
                  1e-12 * all["stresses"]["measured"]["mean"].get<double>());
    }
  std::size_t bodies = 0;
  for (const auto& some : all["coordination"]["histogram"]) bodies += some.get<std::size_t>();
  EXPECT_EQ(bodies, 40u);
}

TEST(MicroCommand, PartsAddUpAndSharesAreOfTheShearStressRatio) {
  const Json all = spheroids().json();
  for (const Json& parts : {all["stress_force_fabric"], all["published"]["stress_force_fabric"]})
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        double sum = 0.0;
        for (const char* part : {"isotropic", "fabric", "branch", "force", "fabric_branch",
                                 "fabric_force", "force_branch", "fabric_force_branch"})
          sum += parts[part][i][j].get<double>();
        EXPECT_NEAR(parts["sum"][i][j], sum, 1e-14 * std::abs(parts["sum"][0][0].get<double>()));
      }
  const double ratio = all["stresses"]["seven"]["a_s"];
  EXPECT_NEAR(all["shares"]["sum"], ratio, 1e-12 * ratio);
  EXPECT_NEAR(all["shares_eight"]["sum"], all["stresses"]["eight"]["a_s"], 1e-12 * ratio);
  // The theory's stress is near that which is summed.
  EXPECT_NEAR(all["stresses"]["fourth"]["mean"].get<double>() /
                  all["stresses"]["measured"]["mean"].get<double>(),
              1.0, 0.1);
}

TEST(MicroCommand, SharesOfWhereBodiesAreTouchedAddUpAndTheirTurnIsOfContactNormals) {
  const Json all = spheroids().json();
  const Json& seen = all["contact_statistics"];
  for (const char* end : {"", "_model"}) {
    double sides = 0.0, pairs = 0.0;
    for (const char* length : {"f_short", "f_intermediate", "f_long"})
      sides += seen[length + std::string(end)].get<double>();
    const std::string head = *end == '\0' ? "pair_" : "pair_model_";
    for (const char* pair : {"ss", "si", "sl", "ii", "il", "ll"})
      pairs += seen[head + pair].get<double>();
    EXPECT_NEAR(sides, 1.0, 1e-12);
    EXPECT_NEAR(pairs, 1.0, 1e-12);
  }
  EXPECT_NEAR(seen["a1"], all["local_contacts"]["second"][0][0].get<double>(), 1e-12);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_NEAR(seen["r_rot"][i][j].get<double>() + seen["r_other"][i][j].get<double>(),
                  all["fabric"]["second"][i][j], 1e-12);
  EXPECT_LT(seen["P2"].get<double>(), 0.0);
  EXPECT_NEAR(seen["P2"], seen["P2_model"].get<double>(), 0.1);
}

TEST(MicroCommand, HelpNamesEveryKeyOfWhereBodiesAreTouched) {
  const std::string help = run_tool({"micro", "--help"}).out;
  const Made plane(growing_scene(2));
  std::size_t named = 0;
  for (const Json& seen :
       {spheroids().json()["contact_statistics"], plane.json()["contact_statistics"]})
    for (const auto& [key, value] : seen.items()) {
      std::string name = key;  // of families the first stands for all
      if (name.ends_with("_error") && name != "r_other_error") name.resize(name.size() - 6);
      if (name.starts_with("pair_model_")) name = "pair_model_ss";
      if (name.starts_with("correlation_orientation_")) name = "correlation_orientation_x";
      EXPECT_NE(help.find(name), help.npos) << key;
      ++named;
    }
  EXPECT_GT(named, 60u);
}

// dem/tool/histogram.hpp (1)
TEST(MicroCommand, HistogramsOfBothPartitionsAddUpAndAgreeOnTheMeanForce) {
  const Made& made = spheroids();
  std::vector<double> means, errors;
  for (const std::string partition : {"near-uniform", "polar"}) {
    const Json all = made.json({"--partition", partition});
    const Columns table =
        columns_of(made.micro({"--partition", partition, "--histogram", "-"}).out);
    double density = 0.0, sides = 0.0, filled = 0.0, force = 0.0;
    std::size_t empty = 0;
    const std::size_t classes = table.at("class").size();
    EXPECT_EQ(classes, partition == "polar" ? 648u : 384u);
    for (std::size_t g = 0; g < classes; ++g) {
      const double area = number(table.at("area")[g]);
      density += number(table.at("E")[g]) * area;
      sides += number(table.at("sides")[g]);
      EXPECT_EQ(table.at("fn")[g].empty(), table.at("sides")[g] == "0");
      EXPECT_EQ(table.at("fl_zz")[g].empty(), table.at("sides")[g] == "0");
      EXPECT_FALSE(table.at("zt4z")[g].empty());
      if (table.at("sides")[g] == "0") {
        ++empty;
        continue;
      }
      filled += area;
      force += area * number(table.at("fn")[g]);
    }
    EXPECT_NEAR(density, 1.0, 1e-12);
    EXPECT_EQ(sides, 2.0 * all["contacts"].get<double>());
    EXPECT_EQ(empty, all["empty_classes"].get<std::size_t>());
    means.push_back(force / filled);
    errors.push_back(all["normal_force"]["mean_error"]);
    EXPECT_NEAR(all["published"]["f0"], force / filled, 1e-10 * force / filled);
  }
  EXPECT_LT(std::abs(means[0] - means[1]), 4.0 * std::hypot(errors[0], errors[1]));
}

TEST(MicroCommand, RingsOfAPolarPartitionAreThereAndOfAnotherNot) {
  EXPECT_TRUE(spheroids().json()["radial_rings"].is_null());
  const Json rings = spheroids().json({"--partition", "polar", "--classes", "6"})["radial_rings"];
  ASSERT_EQ(rings.size(), 6u);
  // Of both sides of contacts the component away from the axis is one, and compression turns
  // forces towards the axis.
  const double largest = std::abs(rings[1]["value"].get<double>());
  EXPECT_LT(rings[1]["value"].get<double>(), 0.0);
  for (const char* name : {"value", "model2", "model4"})
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(rings[k][name], rings[5 - k][name].get<double>(), 1e-9 * largest);
}

TEST(MicroCommand, OfThePlaneHasThePlanesTensors) {
  const Made made(growing_scene(2));
  const Json all = made.json();
  EXPECT_EQ(all["dimensions"], 2);
  EXPECT_TRUE(all["fabric"]["fourth"].is_null());
  EXPECT_TRUE(all["stress_force_fabric"].is_null());
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(all["normal_force"]["second"][2][k], 0.0);
  EXPECT_NEAR(all["fabric"]["magnitude"].get<double>(),
              std::sqrt(2.0) * all["plane"]["amplitudes"]["r"].get<double>(), 1e-12);
  EXPECT_NEAR(all["stresses"]["eight"]["mean"].get<double>() /
                  all["stresses"]["measured"]["mean"].get<double>(),
              1.0, 0.15);
  EXPECT_FALSE(all["local_contacts"].is_null());
  EXPECT_NEAR(all["contact_statistics"]["a_L"], all["local_contacts"]["second"][0][0].get<double>(),
              1e-12);
  EXPECT_TRUE(all["contact_statistics"]["f_short"].is_null());
  const Finished table = made.micro();
  EXPECT_EQ(table.status, 0) << table.err;
  EXPECT_NE(table.out.find("sin(phi), coaxial"), table.out.npos) << table.out;
  const Finished refused = made.micro({"--histogram", made.file("h.csv")});
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1);
  EXPECT_FALSE(std::filesystem::exists(made.file("h.csv")));
}

TEST(MicroCommand, OfSpheresHasNoTensorOfBodyAxes) {
  const std::string spheres =
      with(with(growing_scene(3), "elongation = 1.2\n", "elongation = 1.0\n"), "increments = 20\n",
           "increments = 1\n");
  const Made made(spheres);
  const Json all = made.json();
  EXPECT_TRUE(all["long_axes"].is_null());
  EXPECT_TRUE(all["local_contacts"].is_null());
  EXPECT_TRUE(all["coaxiality"]["E"].is_null());
  EXPECT_TRUE(all["contact_statistics"]["P2"].is_null());
  EXPECT_FALSE(all["contact_vectors"].is_null());
  EXPECT_LT(all["branch_tangential"]["magnitude"].get<double>(), 1e-9);
  EXPECT_LT(all["vector_normal_angle_largest_deg"].get<double>(), 1e-5);
  EXPECT_EQ(made.micro().status, 0);
}

TEST(MicroCommand, OfNoFrictionHasNoAxesOrSignsOfTangentialForces) {
  const Made made(
      with(with(growing_scene(3), "friction_coefficient = 0.5", "friction_coefficient = 0"),
           "[output]\n", "[output]\nmicro_interval = 1000000\n"));
  const Json all = made.json();
  ASSERT_GT(all["contacts"].get<int>(), 50);
  EXPECT_LT(all["tangential_force"]["magnitude"].get<double>(), 1e-12);
  EXPECT_EQ(all["signs"]["t"], 0);
  EXPECT_EQ(all["joint_signs"]["r_t"], 0);
  EXPECT_NE(all["signs"]["n"], 0);
  EXPECT_TRUE(all["coaxiality"]["t"]["axial_deg"].is_null());
  EXPECT_FALSE(all["coaxiality"]["n"]["axial_deg"].is_null());
  for (const Json& none :
       {all["force_asymmetry"], all["axisymmetry"]["t"], all["tangential_force"]["unexplained2"]})
    EXPECT_TRUE(none.is_null());
  const Rows rows = rows_of(read_file(made.file("out/micro.csv")));
  for (const char* column :
       {"asymmetry_t", "axial_deg_t", "commutator_t", "axisymmetry_t", "unexplained2_t"})
    EXPECT_EQ(rows.back().at(column), "") << column;
  EXPECT_EQ(rows.back().at("sign_t"), "0");
}

TEST(MicroCommand, KnowsWhatSlidesByTheFrictionOfTheStage) {
  const auto made_with = [](const std::string& of_contacts, const std::string& of_stage) {
    return Made(with(with(sheared_scene(), "friction_coefficient = 0.5",
                          "friction_coefficient = " + of_contacts),
                     "kind = \"shear\"\n",
                     "kind = \"shear\"\nfriction_coefficient = " + of_stage + "\n"));
  };
  const auto sliding = [](const Json& all) {
    double size = 0.0;
    for (const double x : numbers_of(all["average_strain"]["velocities"]["nets"][0]["sliding"]))
      size = std::max(size, std::abs(x));
    return size;
  };
  const Made smooth = made_with("0.5", "0.1"), rough = made_with("0.1", "0.5");
  EXPECT_EQ(sliding(smooth.json()), 0.0);
  EXPECT_GT(sliding(smooth.json({"--friction", "0.1"})), 1e-4);
  EXPECT_GT(sliding(rough.json()), sliding(rough.json({"--friction", "0.5"})));
  EXPECT_NE(rough.micro().err.find(" contacts bear more shear than their friction lets them"),
            std::string::npos);
  EXPECT_EQ(rough.micro({"--friction", "0.5"}).err, "");
}

TEST(MicroCommand, OfNoContactHasEmptyValuesAndNoCrash) {
  for (const char* dimensions : {"2", "3"}) {
    const Made made("schema = 1\n[cell]\ndimensions = " + std::string(dimensions) +
                    "\n[particles.p]\ncount = 27\nmean_radius = 1.0\nelongation = 1.5\n[contact]\n"
                    "normal_stiffness = 1e6\n[[stage]]\nkind = \"place\"\njitter = 0.0\n"
                    "[[stage]]\nkind = \"servo\"\nduration = 1\n[output]\nmicro_interval = 1\n");
    const Json all = made.json();
    EXPECT_EQ(all["contacts"], 0);
    for (const char* key : {"fabric", "normal_force", "tangential_force", "branch_normal",
                            "branch_tangential", "branch_length", "local_contacts", "f0", "z0",
                            "stress_force_fabric", "stress_asymmetry", "plane"})
      EXPECT_TRUE(all[key].is_null()) << key;
    EXPECT_FALSE(all["long_axes"].is_null());
    EXPECT_EQ(all["coordination_number"], 0.0);
    EXPECT_EQ(made.micro().status, 0);
    EXPECT_EQ(made.micro().out.find("nan"), std::string::npos);
    const Columns rows = columns_of(read_file(made.file("out/micro.csv")));
    ASSERT_EQ(rows.at("cycle").size(), 2u);
    EXPECT_EQ(rows.at("contacts").back(), "0");
    for (const char* column : {"f0", "A_r", "a_s", "share_r", "fraction_x", "axial_deg_fabric"})
      EXPECT_EQ(rows.at(column).back(), "") << column;
    EXPECT_NE(rows.at("a_axial_E").back(), "");
  }
}

/// Particles and walls that touch in a state, one by one.
std::size_t walls_touched(const std::string& file) {
  const dem::State state = dem::load_state(file);
  std::size_t touched = 0;
  for (std::size_t i = 0; i < state.particles.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      if (!state.cell.walled[static_cast<std::size_t>(axis)]) continue;
      // Half the height of the body along the axis: |S R' e|.
      const Vec3 along = state.particles.orientation[i].conjugate() * Vec3::Unit(axis);
      const double half = state.particles.semi_axes[i].cwiseProduct(along).norm();
      const double place = state.particles.position[i][axis];
      touched += place < half ? 1u : 0u;
      touched += place > state.cell.edges(axis, axis) - half ? 1u : 0u;
    }
  return touched;
}

TEST(MicroCommand, OfAWalledPackingCountsItsWalls) {
  const Made made(with(growing_scene(3), "[cell]\n", "[cell]\nwalls = \"z\"\n"));
  const Json all = made.json();
  EXPECT_EQ(all["wall_contacts"].get<std::size_t>(), walls_touched(made.state()));
  EXPECT_NE(made.micro().out.find("contacts with walls"), std::string::npos);
  const Rows history = rows_of(read_file(made.file("out/history.csv")));
  const double mean = number(history.back().at("mean_stress"));
  ASSERT_GT(mean, 0.0);
  EXPECT_NEAR(all["stresses"]["measured"]["mean"], mean, 1e-12 * mean);
  EXPECT_NEAR(all["stress"][2][2], number(history.back().at("s_zz")), 1e-12 * mean);
  EXPECT_EQ(all["contacts"].get<std::size_t>(),
            columns_of(run_tool({"contacts", made.state()}).out).at("a").size());
}

TEST(MicroCommand, RefusesWhatIsNoStateOrNoPartitionWithOneLine) {
  const Made& made = spheroids();
  const TemporaryFolder folder;
  const std::string none = folder.write("no.state", "not a state of any run");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"micro", none},
        {"micro", folder.path("missing.state")},
        {"micro", made.state(), "--partition", "cubic"},
        {"micro", made.state(), "--classes", "0"},
        {"micro", made.state(), "--classes", "101"},
        {"micro", made.state(), "--partition", "polar", "--classes", "1"},
        {"micro", made.state(), "--json", "-", "--histogram", "-"},
        {"micro", made.state(), "--json", folder.path("x"), "--histogram", folder.path("x")},
        {"micro", made.state(), "--json", folder.path("x"), "--histogram", folder.path("no/h")},
        {"micro", made.state(), "--friction", "-1"},
        {"micro", made.state(), "--json", folder.path("no/where.json")}}) {
    const Finished refused = run_tool(arguments);
    EXPECT_EQ(refused.status, 2) << refused.out;
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
    EXPECT_EQ(refused.out, "");
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{"no.state"});
}

TEST(MicroCsv, HasARowAtTheIntervalAndAtTheEndsOfStages) {
  const Made& made = spheroids();
  const Columns rows = columns_of(read_file(made.file("out/micro.csv")));
  const Columns history = columns_of(read_file(made.file("out/history.csv")));
  for (const char* column : {"cycle", "time", "stage", "stage_cycle", "axial_strain", "contacts",
                             "shear_strain_xy", "shear_strain_yz", "shear_strain_zx"})
    EXPECT_EQ(rows.at(column), history.at(column)) << column;
  ASSERT_GT(rows.at("cycle").size(), 10u);
  std::map<std::string, std::string> end_of;  // last cycle of each stage
  for (std::size_t k = 0; k < rows.at("cycle").size(); ++k)
    end_of[rows.at("stage")[k]] = rows.at("cycle")[k];
  EXPECT_EQ(end_of.size(), 5u);
  std::size_t between = 0;
  for (std::size_t k = 0; k < rows.at("cycle").size(); ++k) {
    const std::string& cycle = rows.at("cycle")[k];
    if (cycle == end_of.at(rows.at("stage")[k])) continue;
    EXPECT_EQ(std::stoll(cycle) % 100, 0) << cycle;
    ++between;
  }
  // None is left out, but one that is the end of a stage.
  const auto last_cycle = static_cast<std::size_t>(std::stoull(rows.at("cycle").back()));
  EXPECT_GE(between + end_of.size(), last_cycle / 100);
  // The last row is what the command makes of the final state.
  const Json all = made.json();
  const auto last = [&](const std::string& column) { return number(rows.at(column).back()); };
  EXPECT_EQ(last("f0"), all["f0"].get<double>());
  EXPECT_EQ(last("A_n"), all["signed_magnitudes"]["n"].get<double>());
  EXPECT_EQ(last("A_z"), all["signed_magnitudes"]["z"].get<double>());
  EXPECT_EQ(last("a_axial_t"), all["tangential_force"]["second"][2][2].get<double>());
  EXPECT_EQ(last("a1"), all["local_contacts"]["second"][0][0].get<double>());
  EXPECT_EQ(last("b_r"), all["fabric"]["fourth_magnitude"].get<double>());
  EXPECT_EQ(last("unexplained2_t"), all["tangential_force"]["unexplained2"].get<double>());
  EXPECT_EQ(last("s1"), all["stresses"]["measured"]["principal"][0].get<double>());
  EXPECT_EQ(last("a_s_seven"), all["stresses"]["seven"]["a_s"].get<double>());
  EXPECT_EQ(last("share_rf"), all["shares"]["rf"].get<double>());
  EXPECT_EQ(last("axisymmetric_n"), all["axisymmetric_shares"]["n"].get<double>());
  EXPECT_EQ(last("fabric_force_zz"),
            all["stress_force_fabric"]["fabric_force"][2][2].get<double>());
  EXPECT_EQ(last("joint_df_dz"), all["joint_signs"]["df_dz"].get<double>());
  EXPECT_EQ(last("fraction_z"), all["direction_groups"]["z"]["fraction"].get<double>());
  EXPECT_EQ(last("P2"), all["contact_statistics"]["P2"].get<double>());
  EXPECT_EQ(last("axial_deg_n"), all["coaxiality"]["n"]["axial_deg"].get<double>());
  EXPECT_NEAR(last("mean_stress"), number(history.at("mean_stress").back()),
              1e-12 * last("mean_stress"));
}

TEST(MicroCsv, TakesThePartitionOfTheScene) {
  const Made made(with(sheared_scene(), "micro_interval = 100\n",
                       "micro_interval = 100\npartition = \"polar\"\nclasses = 6\n"));
  const Columns rows = columns_of(read_file(made.file("out/micro.csv")));
  const Json all = made.json({"--partition", "polar", "--classes", "6"});
  EXPECT_EQ(number(rows.at("f0").back()), all["f0"].get<double>());
  EXPECT_NE(number(rows.at("f0").back()), made.json()["f0"].get<double>());
}

TEST(MicroCsv, IsNotThereWithoutAnInterval) {
  const Made made(with(sheared_scene(), "micro_interval = 100\n", ""));
  EXPECT_FALSE(std::filesystem::exists(made.file("out/micro.csv")));
}

}  // namespace
}  // namespace tangency::testing
