// SPDX-License-Identifier: GPL-3.0-or-later
/// Frames of contacts against the table of contacts of the same state, by readers of their own.
/// `frames_check.py` reads them with VTK.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <tangency/dem/saved/state_file.hpp>
#include <tangency/geometry/vectors.hpp>

#include "../tool/process.hpp"
#include "csv_columns.hpp"
#include "scenes.hpp"
#include "vtp_arrays.hpp"

namespace tangency::testing {
namespace {

/// A sheared sample with frames of contacts at the ends of its stages.
class ContactFrames : public ::testing::Test {
 protected:
  std::string scene(const std::string& more = "") const {
    return with(small_scene(), "[output]\n",
                "[[stage]]\nkind = \"servo\"\nduration = 40\nshear_rate = [0.05, 0.0, 0.0]\n"
                "friction_coefficient = 0.2\n" +
                    more + "[output]\ncontact_frames = true\n");
  }
  Finished run(const std::string& text, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"run", folder_.write("scene.toml", text), "--out", out_,
                                   "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    return run_tool(words);
  }
  std::string last(const std::string& ending) const {
    const auto cycle = dem::load_state(out_ + "/final.state").cycle;
    return read_file(out_ + "/frames/" + std::to_string(cycle) + ending);
  }
  /// Of the last cycle, by the friction of the last stage.
  std::vector<std::map<std::string, double>> rows() const {
    std::istringstream in(run_tool({"contacts", out_ + "/final.state", "--friction", "0.2"}).out);
    std::string line;
    std::getline(in, line);
    const std::vector<std::string> names = cells_of(line);
    std::vector<std::map<std::string, double>> all;
    while (std::getline(in, line)) {
      const std::vector<std::string> cells = cells_of(line);
      for (auto& row = all.emplace_back(); const std::string& name : names)
        row[name] = std::stod(cells[row.size()]);
    }
    return all;
  }

  TemporaryFolder folder_;
  std::string out_ = folder_.path("out");
};

TEST_F(ContactFrames, HoldTheTableOfContactsAsPoints) {
  ASSERT_EQ(run(scene()).status, 0);
  auto arrays = arrays_of_vtp(last(".contacts.vtp"));
  const auto table = rows();
  ASSERT_FALSE(table.empty());
  const auto compare = [&](const std::string& array, const std::vector<std::string>& columns) {
    const std::vector<double>& numbers = arrays["PointData/" + array];
    ASSERT_EQ(numbers.size(), columns.size() * table.size()) << array;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const double wanted = table[k / columns.size()].at(columns[k % columns.size()]);
      EXPECT_EQ(static_cast<float>(numbers[k]), static_cast<float>(wanted)) << array;
    }
  };
  compare("a", {"a"});
  compare("b", {"b"});
  compare("sliding", {"sliding"});
  compare("normal_force", {"fn"});
  compare("normal", {"nx", "ny", "nz"});
  compare("force", {"fx", "fy", "fz"});
  compare("shear_force", {"sx", "sy", "sz"});
  compare("velocity", {"vx", "vy", "vz"});
  compare("gap", {"gap"});
  compare("curvature", {"curvature_min", "curvature_max"});
  const dem::Cell cell = dem::load_state(out_ + "/final.state").cell;
  const std::vector<double>& places = arrays["Points/Points"];
  ASSERT_EQ(places.size(), 3 * table.size());
  for (std::size_t k = 0; k < table.size(); ++k) {
    const Vec3 place(places[3 * k], places[3 * k + 1], places[3 * k + 2]);
    const Vec3 point(table[k].at("x"), table[k].at("y"), table[k].at("z"));
    const Vec3 inside = cell.reduced(place), edges = cell.reduced(point - place);
    EXPECT_TRUE((inside.array() > -1e-9).all() && (inside.array() < 1.0 + 1e-9).all());
    EXPECT_LT((edges - edges.array().round().matrix()).norm(), 1e-9) << "whole edges away";
  }
}

TEST_F(ContactFrames, HaveALineAlongEachBranchVectorFromWithinTheCell) {
  ASSERT_EQ(run(scene()).status, 0);
  auto arrays = arrays_of_vtp(last(".chains.vtp"));
  const auto table = rows();
  const std::vector<double>& ends = arrays["Points/Points"];
  ASSERT_EQ(ends.size(), 6 * table.size());
  ASSERT_EQ(arrays["Lines/connectivity"].size(), 2 * table.size());
  ASSERT_EQ(arrays["PointData/normal_force"].size(), 2 * table.size());
  for (std::size_t k = 0; k < table.size(); ++k) {
    const auto& row = table[k];
    const char* branch[] = {"bx", "by", "bz"};
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(ends[6 * k + 3 + axis] - ends[6 * k + axis], row.at(branch[axis]), 1e-11);
    EXPECT_EQ(arrays["Lines/offsets"][k], 2.0 * static_cast<double>(k + 1));
    const double size = std::hypot(row.at("fx"), row.at("fy"), row.at("fz"));
    EXPECT_NEAR(arrays["CellData/force_size"][k], size, 1e-6 * size);
    for (const std::size_t end : {2 * k, 2 * k + 1})
      EXPECT_EQ(arrays["PointData/normal_force"][end], arrays["CellData/normal_force"][k]);
  }
}

// OVITO puts both particles where frames.xyz has them, and the second in the image that px, py, pz
// say.
TEST_F(ContactFrames, ForOvitoAreBondsBetweenParticlesOfTheSameFrame) {
  ASSERT_EQ(run(scene()).status, 0);
  const dem::State state = dem::load_state(out_ + "/final.state");
  std::istringstream in(last(".bonds"));
  std::string line, head;
  for (int k = 0; k < 5; ++k) std::getline(in, line), head += line + "\n";
  const auto table = rows();
  EXPECT_EQ(head, "ITEM: TIMESTEP\n" + std::to_string(state.cycle) + "\nITEM: NUMBER OF BONDS\n" +
                      std::to_string(table.size()) +
                      "\nITEM: BONDS id1 id2 px py pz normal_force shear_force sliding\n");
  const std::vector<std::uint32_t> index = state.particles.index_of_id();
  const auto wrapped = [&](int id) {
    const Vec3& x = state.particles.position[index[static_cast<std::size_t>(id - 1)]];
    return Vec3(x - state.cell.translation(state.cell.image_of(x)));
  };
  for (const auto& row : table) {
    int a = 0, b = 0;
    dem::Image image{};
    double normal = 0.0, shear = 0.0;
    in >> a >> b >> image[0] >> image[1] >> image[2] >> normal >> shear >> line;
    EXPECT_EQ(a, row.at("a") + 1);
    EXPECT_EQ(b, row.at("b") + 1);
    const Vec3 branch = wrapped(b) + state.cell.translation(image) - wrapped(a);
    EXPECT_LT((branch - Vec3(row.at("bx"), row.at("by"), row.at("bz"))).norm(), 1e-11);
    EXPECT_EQ(static_cast<float>(normal), static_cast<float>(row.at("fn")));
    EXPECT_NEAR(shear, std::hypot(row.at("sx"), row.at("sy"), row.at("sz")), 1e-6 * normal);
  }
}

// Resumed from an earlier state, the same files come back; by a scene without them later ones go.
TEST_F(ContactFrames, AreCarriedOnByAResumedRunAndTakenAwayAfterItsState) {
  const auto files = [&] {
    std::map<std::string, std::string> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(out_))
      if (const std::string name = entry.path().lexically_relative(out_).string();
          entry.is_regular_file() && (name.ends_with(".pvd") || name.starts_with("frames")))
        all[name] = read_file(entry.path());
    return all;
  };
  ASSERT_EQ(run(scene()).status, 0);
  const std::string middle = folder_.path("middle.state");
  std::filesystem::copy_file(out_ + "/final.state", middle);
  const auto before = files();
  const std::string more = "[[stage]]\nkind = \"servo\"\nduration = 30\n";
  ASSERT_EQ(run(scene(more), {"--resume", middle}).status, 0);
  const auto longer = files();
  EXPECT_EQ(longer.size(), before.size() + 4);
  ASSERT_EQ(run(scene(more), {"--resume", middle}).status, 0);
  EXPECT_TRUE(files() == longer);
  ASSERT_EQ(run(scene(), {"--resume", middle}).status, 0);
  EXPECT_TRUE(files() == before);
  ASSERT_EQ(run(with(scene(), "contact_frames = true\n", ""), {"--replace"}).status, 0);
  for (const auto& [name, text] : files())
    EXPECT_TRUE(name.find("contacts") == name.npos && name.find("bonds") == name.npos) << name;
}

}  // namespace
}  // namespace tangency::testing
