// SPDX-License-Identifier: GPL-3.0-or-later
/// Tables of bodies that have shapes of their own, in the forms that their owners have them, and
/// types of particles that are not all alike, by `tangency-dem run`.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "../tool/process.hpp"
#include "csv_columns.hpp"
#include "scenes.hpp"

namespace tangency::testing {
namespace {

Finished run_quietly(const std::string& scene, const std::string& out,
                     const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"run", scene, "--out", out, "--quiet", "--threads", "1"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_tool(arguments);
}

std::string scene_of(const std::string& law) {
  return "schema = 1\n[cell]\nsize = [40, 40, 40]\n[particles.a]\ncount = 2\nmean_radius = 2.0\n"
         "elongation = 1.5\n[particles.b]\ncount = 1\nmean_radius = 3.0\n[contact]\n" +
         law +
         "[[stage]]\nkind = \"place\"\narrangement = \"explicit\"\nfile = \"bodies.csv\"\n"
         "[[stage]]\nkind = \"servo\"\nduration = 20\n";
}
const char* const kLinear = "normal_stiffness = 1e6\n";

/// Semi-axes and quaternions at the end, a row a body.
std::vector<std::vector<double>> bodies_of(const std::string& out, const TemporaryFolder& folder) {
  const std::string file = folder.path("particles.csv");
  EXPECT_EQ(run_tool({"particles", out + "/final.state", "--out", file}).status, 0);
  const auto columns = columns_of(read_file(file));
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < columns.at("r1").size(); ++i) {
    rows.emplace_back();
    for (const char* name : {"r1", "r2", "r3", "qw", "qx", "qy", "qz"})
      rows.back().push_back(std::stod(columns.at(name)[i]));
  }
  return rows;
}

// The first body of type a is 3 by 2 by 1 along y, z and x of space; the second is so along x, y
// and z.
TEST(BodyForms, OfATableMakeTheSameBodies) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.toml", scene_of(kLinear));
  const std::vector<std::string> tables{
      "type,x,y,z,r1,r2,r3\na,5,5,5,1,3,2\na,20,20,20,3,2,1\nb,30,30,30,3,3,3\n",
      "type,x,y,z,m.xx,m.yy,m.zz,m.xy,m.yz,m.zx\n"
      "a,5,5,5,1,9,4,0,0,0\na,20,20,20,9,4,1,0,0,0\nb,30,30,30,9,9,9,0,0,0\n",
      "type,x,y,z,u1.x,u1.y,u1.z,u2.x,u2.y,u2.z,u3.x,u3.y,u3.z\n"
      "a,5,5,5,0,3,0,0,0,2,1,0,0\na,20,20,20,3,0,0,0,2,0,0,0,1\nb,30,30,30,3,0,0,0,3,0,0,0,3\n"};
  for (const std::string& table : tables) {
    folder.write("bodies.csv", table);
    const std::string out = folder.path("out");
    const Finished run = run_quietly(scene, out, {"--replace"});
    ASSERT_EQ(run.status, 0) << run.err;
    const auto rows = bodies_of(out, folder);
    ASSERT_EQ(rows.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(rows[0][k], 3.0 - static_cast<double>(k), 1e-12) << table;
      EXPECT_NEAR(rows[1][k], 3.0 - static_cast<double>(k), 1e-12) << table;
      EXPECT_NEAR(rows[2][k], 3.0, 1e-12) << table;
    }
    // The longest axis of the first along y, the middle one along z: columns of R(q).
    const auto& q = rows[0];
    const double w = q[3], x = q[4], y = q[5], z = q[6];
    EXPECT_NEAR(std::abs(2.0 * (x * y + w * z)), 1.0, 1e-9) << table;
    EXPECT_NEAR(std::abs(2.0 * (y * z + w * x)), 1.0, 1e-9) << table;
    // It goes on from its state under the same table.
    EXPECT_EQ(run_quietly(scene, out, {"--resume", out + "/final.state"}).status, 0);
  }
}

TEST(BodyForms, ThatAreNoBodiesAreRefusedWithTheirLine) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.toml", scene_of(kLinear));
  const std::string file = folder.path("bodies.csv");
  const auto message = [&](const std::string& table) {
    folder.write("bodies.csv", table);
    const Finished run = run_quietly(scene, folder.path("out"));
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    return run.err;
  };
  EXPECT_EQ(message("type,x,y,z,r1,r2,r3\na,5,5,5,1,-3,2\n").find(file + ":2: r2 = -3: "), 0u);
  EXPECT_EQ(message("type,x,y,z,r1,r2\na,5,5,5,1,3\n").find(file + ":1: "), 0u);
  EXPECT_EQ(message("type,x,y,z,r1,r2,r3,m.xx\na,5,5,5,1,3,2,1\n").find(file + ":1: "), 0u);
  EXPECT_EQ(message("type,x,y,z,r1,r2,r3\na,5,5,5,1,3,2\n"),
            file + ": 1 bodies of type a: as many as particles.a.count, 2\n");
}

// The step of Hertz contacts goes by the bodies of the table, not by those of the scene.
TEST(BodyForms, OfATableMakeTheTimeStep) {
  const TemporaryFolder folder;
  const std::string hertz = "law = \"hertz\"\nyoung_modulus = 1e9\n";
  const auto time_of = [&](const std::string& name, const std::string& scene,
                           const std::string& table) {
    folder.write("bodies.csv", table);
    const Finished run = run_quietly(folder.write("s.toml", scene), folder.path(name));
    EXPECT_EQ(run.status, 0) << run.err;
    return std::stod(columns_of(read_file(folder.path(name + "/history.csv"))).at("time").back());
  };
  const std::string places = "type,x,y,z\na,5,5,5\na,20,20,20\nb,30,30,30\n";
  const std::string half =
      "type,x,y,z,r1,r2,r3\na,5,5,5,1,1,1\na,20,20,20,1,1,1\nb,30,30,30,3,3,3\n";
  const std::string spheres = with(scene_of(hertz), "2.0\nelongation = 1.5\n", "1.0\n");
  EXPECT_NEAR(time_of("own", scene_of(hertz), half) / time_of("types", spheres, places), 1.0, 1e-9);
  EXPECT_GT(time_of("as", scene_of(hertz), places), 1.2 * time_of("again", spheres, places));
}

}  // namespace
}  // namespace tangency::testing
