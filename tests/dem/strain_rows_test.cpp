// SPDX-License-Identifier: GPL-3.0-or-later
/// Rows of history.csv and frames at equal strains.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "../tool/process.hpp"
#include "csv_columns.hpp"
#include "scenes.hpp"

namespace tangency::testing {
namespace {

constexpr double kStep = 0.01, kRate = 0.05;

/// A shear to 0.1 and a simple shear of 500 cycles, with rows and frames at each hundredth.
std::string sheared_twice() {
  return with(
      small_scene(), "[output]\nframe_interval = 1000000\n",
      "[[stage]]\nkind = \"shear\"\nmean_stress = 10e6\naxial_strain_rate = 0.05\n"
      "axial_strain = 0.1\n"
      "[[stage]]\nkind = \"servo\"\nname = \"simple\"\nsimple_shear_rate = [0.05, 0.0, 0.0]\n"
      "duration = 500\n"
      "[output]\nhistory_interval = 1000\nframe_interval = 1000\nhistory_strain = 0.01\n"
      "frame_strain = 0.02\n");
}

Finished run_quietly(const std::string& scene, const std::string& out,
                     std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"run", scene, "--out", out, "--quiet", "--threads", "1"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_tool(arguments);
}

/// The rows of a stage, its end's last.
Rows rows_of_stage(const std::string& folder, const std::string& stage) {
  Rows rows;
  for (const auto& row : rows_of(read_file(folder + "/history.csv")))
    if (row.at("stage") == stage) rows.push_back(row);
  return rows;
}

class StrainRows : public ::testing::Test {
 protected:
  void SetUp() override {
    scene_ = folder_.write("scene.toml", sheared_twice());
    const Finished run = run_quietly(scene_, folder_.path("out"));
    ASSERT_EQ(run.status, 0) << run.err;
  }
  const TemporaryFolder folder_;
  std::string scene_;
};

TEST_F(StrainRows, AreWhereAShearFirstComesToEachMultiple) {
  const Rows rows = rows_of_stage(folder_.path("out"), "shear");
  ASSERT_EQ(rows.size(), 10u);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double strain = std::stod(rows[k].at("axial_strain"));
    const double wanted = kStep * static_cast<double>(k + 1);
    EXPECT_GE(strain, wanted * (1.0 - 1e-9));
    EXPECT_LT(strain, wanted + 0.05 * kStep) << "within a cycle's strain";
  }
}

TEST_F(StrainRows, AreWhereASimpleShearFirstComesToEachMultiple) {
  const Rows rows = rows_of_stage(folder_.path("out"), "simple");
  const double start = std::stod(rows_of_stage(folder_.path("out"), "shear").back().at("time"));
  ASSERT_GT(rows.size(), 3u);
  const double step = (std::stod(rows.back().at("time")) - start) / 500.0;
  for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
    const double strain = kRate * (std::stod(rows[k].at("time")) - start);
    const double wanted = kStep * static_cast<double>(k + 1);
    EXPECT_GE(strain, wanted * (1.0 - 1e-9));
    EXPECT_LT(strain, wanted + kRate * step * (1.0 + 1e-9));
  }
}

TEST_F(StrainRows, OfFramesAreEveryOtherOneOfTheHistorys) {
  for (const auto& stage : {"shear", "simple"}) {
    const Rows rows = rows_of_stage(folder_.path("out"), stage);
    for (std::size_t k = 0; k + 1 < rows.size(); ++k)
      EXPECT_EQ(std::filesystem::exists(folder_.path("out/frames/" + rows[k].at("cycle") + ".vtp")),
                k % 2 == 1)
          << stage << " " << k;
  }
}

// In stages without a given rate rows come by cycles.
TEST_F(StrainRows, LeaveOtherStagesTheirCycles) {
  long begin = 0;
  for (const char* stage : {"compress", "relax"}) {
    std::vector<long> cycles, wanted;
    for (const auto& row : rows_of_stage(folder_.path("out"), stage))
      cycles.push_back(std::stol(row.at("cycle")));
    const long end = cycles.back();
    for (long at = (begin / 1000 + 1) * 1000; at < end; at += 1000) wanted.push_back(at);
    EXPECT_FALSE(wanted.empty()) << stage;
    wanted.push_back(end);
    EXPECT_EQ(cycles, wanted) << stage;
    begin = end;
  }
}

// From a checkpoint at the very cycle of a row, and from one between two.
TEST_F(StrainRows, AreTheSameInARunThatWasInterrupted) {
  const Rows rows = rows_of_stage(folder_.path("out"), "shear");
  const long at = std::stol(rows[4].at("cycle"));
  for (const long cycle : {at, at + 2}) {
    const std::string parts = folder_.path("parts");
    const Finished stopped = run_quietly(
        scene_, parts,
        {"--replace", "--set", "output.checkpoint_interval=" + std::to_string(cycle), "--set",
         "stage.shear.max_cycles=" +
             std::to_string(
                 cycle -
                 std::stol(rows_of_stage(folder_.path("out"), "relax").back().at("cycle")))});
    ASSERT_EQ(stopped.status, 1) << stopped.err;
    ASSERT_EQ(run_quietly(scene_, parts, {"--resume", parts + "/checkpoint.state"}).status, 0);
    EXPECT_TRUE(read_file(parts + "/history.csv") == read_file(folder_.path("out/history.csv")));
    EXPECT_TRUE(read_file(parts + "/final.state") == read_file(folder_.path("out/final.state")));
  }
}

}  // namespace
}  // namespace tangency::testing
