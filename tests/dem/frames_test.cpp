// SPDX-License-Identifier: GPL-3.0-or-later
/// Frames as other programs read them, by a reader of their own: sizes and orientations are those
/// of the particles that were put down. `frames_check.py` reads them with VTK and ASE.
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <tangency/dem/parallel.hpp>
#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/scene.hpp>
#include <tangency/dem/simulation.hpp>
#include <tangency/dem/tool/vtk_file.hpp>
#include <tangency/geometry/ellipsoid.hpp>

#include "../tool/process.hpp"
#include "vtp_arrays.hpp"

namespace tangency::testing {
namespace {

constexpr double kAxes[] = {3.0, 2.0, 1.5};  // of mean radius cbrt(9), a/b 3/2, b/c 4/3

/// Two triaxial bodies at rest, far apart, in a cell that a servo stage shears a little.
std::string scene() {
  return "schema = 1\n[cell]\nsize = [40, 50, 60]\n[particles.stone]\ncount = 2\n"
         "mean_radius = 2.080083823051904\nelongation = 1.5\nflatness = 1.3333333333333333\n"
         "[contact]\nnormal_stiffness = 1e6\n[[stage]]\nkind = \"place\"\n"
         "arrangement = \"explicit\"\n[[body]]\ntype = \"stone\"\nposition = [10.0, 20.0, 30.0]\n"
         "orientation = [0.8, 0.1, -0.5, 0.3]\n[[body]]\ntype = \"stone\"\n"
         "position = [30.0, 30.0, 30.0]\norientation = [1.0, 0.0, 0.0, 1.0]\n"
         "[[stage]]\nkind = \"servo\"\nduration = 50\nshear_rate = [0.005, 0.0, 0.0]\n";
}

/// Half the extent along x, y, z of the body with that quaternion (w, x, y, z): sqrt of the
/// diagonal of R diag(a^2) R'.
Vec3 half_extent(double w, double x, double y, double z) {
  const Mat3 rotation = Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
  const Vec3 axes(kAxes[0], kAxes[1], kAxes[2]);
  return (rotation.cwiseAbs2() * axes.cwiseAbs2()).cwiseSqrt();
}
const Vec3 kExtents[] = {half_extent(0.8, 0.1, -0.5, 0.3), half_extent(1.0, 0.0, 0.0, 1.0)};

std::vector<double> numbers(const std::string& text) {
  std::istringstream in(text);
  std::vector<double> all;
  for (double x; in >> x;) all.push_back(x);
  return all;
}

struct Made {
  TemporaryFolder folder;
  Made() {
    const std::string path = folder.write("scene.toml", scene());
    const Finished run = run_tool({"run", path, "--out", folder.path("out"), "--quiet"});
    EXPECT_EQ(run.status, 0) << run.err;
  }
  std::string file(const std::string& name) const { return read_file(folder.path("out/" + name)); }
};

// A sphere of diameter 1 stretched by the tensor, as Tensor Glyph does, spans R diag(a^2) R'.
TEST(Frames, ForParaViewHaveATensorThatStretchesASphereToTheBody) {
  const Made made;
  auto arrays = arrays_of_vtp(made.file("frames/0.vtp"));
  const auto& tensors = arrays["PointData/axes"];
  ASSERT_EQ(tensors.size(), 18u);
  for (std::size_t i = 0; i < 2; ++i) {
    const Mat3 tensor = Eigen::Map<const Mat3>(tensors.data() + 9 * i);
    const Vec3 extent = (0.25 * tensor * tensor.transpose()).diagonal().cwiseSqrt();
    EXPECT_LT((extent - kExtents[i]).norm(), 1e-6) << "of 32 bits";
    EXPECT_GT(tensor.determinant(), 0.0) << "not turned inside out";
  }
  EXPECT_EQ(arrays["Points/Points"], (std::vector<double>{10, 20, 30, 30, 30, 30}));
  EXPECT_EQ(arrays["Verts/connectivity"], (std::vector<double>{0, 1}));
  EXPECT_EQ(arrays["Verts/offsets"], (std::vector<double>{1, 2}));
  EXPECT_EQ(arrays["FieldData/cell"], (std::vector<double>{40, 0, 0, 0, 50, 0, 0, 0, 60}));
  const auto& orientation = arrays["PointData/orientation"];
  ASSERT_EQ(orientation.size(), 8u);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LT((half_extent(orientation[4 * i + 3], orientation[4 * i], orientation[4 * i + 1],
                           orientation[4 * i + 2]) -
               kExtents[i])
                  .norm(),
              1e-12)
        << "x y z w";
}

// dem/tool/vtk_file.hpp (1)
TEST(Frames, ForParaViewHaveTheSameBytesAtEveryThreadCount) {
  const std::size_t points = 100'000;  // five blocks of places
  std::vector<double> places(3 * points);
  std::mt19937_64 draw(20261201);
  for (double& x : places) x = std::ldexp(static_cast<double>(draw()), -64);
  const auto text = [&](int threads) {
    dem::set_threads(threads);
    dem::VtkPolyData file(dem::VtkPolyData::Cells::points, points);
    file.places(places);
    file.add(dem::VtkPolyData::Of::points, "velocity", 3, places);
    dem::set_threads(0);
    return file.text();
  };
  const std::string alone = text(1);
  for (const int threads : {2, 3, 8}) EXPECT_TRUE(text(threads) == alone) << threads;
}

TEST(Frames, ForParaViewAreAllInTheIndexAtTheirTimes) {
  const Made made;
  const std::string pvd = made.file("frames.pvd");
  std::map<double, std::string> files;
  for (std::size_t at = pvd.find("<DataSet"); at != pvd.npos; at = pvd.find("<DataSet", at + 1)) {
    const std::string entry = pvd.substr(at, pvd.find("/>", at) - at);
    files[std::stod(text_between(entry, "timestep=\"", "\""))] =
        text_between(entry, "file=\"", "\"");
  }
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files.begin()->first, 0.0);
  for (const auto& [time, file] : files)
    EXPECT_NE(made.file(file).find("</VTKFile>"), std::string::npos);
}

TEST(Frames, ForOvitoHaveEdgesSemiAxesAndQuaternionsInItsOrder) {
  const Made made;
  std::istringstream in(made.file("frames.xyz"));
  std::string line;
  int frames = 0;
  while (std::getline(in, line)) {
    ASSERT_EQ(line, "2");
    std::getline(in, line);
    const auto edges = numbers(text_between(line, "Lattice=\"", "\""));
    ASSERT_EQ(edges.size(), 9u);
    // Edge by edge. Sheared by a shear rate that is one of compression: towards negative angles.
    EXPECT_NEAR(edges[0] * edges[4] * edges[8], 120000.0, 120.0);
    EXPECT_EQ(edges[1] < 0.0 && edges[3] < 0.0, frames == 1);
    EXPECT_NEAR(edges[1] / edges[0], edges[3] / edges[4], 1e-12);
    EXPECT_EQ(edges[8], 60.0);
    EXPECT_NE(line.find("pbc=\"T T T\""), line.npos);
    EXPECT_NE(
        line.find("Properties=species:S:1:pos:R:3:orientation:R:4:aspherical_shape:R:3:velo:R:3:"
                  "id:I:1 "),
        line.npos);
    for (const Vec3& extent : kExtents) {
      std::string species;
      std::getline(in, line);
      std::istringstream(line) >> species;
      EXPECT_EQ(species, "stone");
      const auto row = numbers(line.substr(species.size()));
      ASSERT_EQ(row.size(), 14u);
      EXPECT_EQ(row[13], &extent - kExtents + 1) << "ids from 1";
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(row[7 + k], kAxes[k], 1e-12);
      EXPECT_LT((half_extent(row[6], row[3], row[4], row[5]) - extent).norm(), 1e-12);
    }
    ++frames;
  }
  EXPECT_EQ(frames, 2);
}

std::map<std::string, std::string> files_below(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[entry.path()] = read_file(entry.path());
  return files;
}

// An earlier state of the same run, resumed in its directory by a scene that has no frames.
TEST(Frames, AfterAMiddleStateAreTakenAwayWithTheirEntries) {
  const TemporaryFolder folder;
  const std::string out = folder.path("out"), middle = folder.path("middle.state");
  const std::string more = "[[stage]]\nkind = \"servo\"\nduration = 30\n[output]\n";
  const auto run = [&](const std::string& text, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"run", folder.write("scene.toml", text), "--out", out});
    arguments.push_back("--quiet");
    return run_tool(arguments);
  };
  ASSERT_EQ(run(scene(), {}).status, 0);
  std::filesystem::copy_file(out + "/final.state", middle);
  const std::string frames = read_file(out + "/frames.xyz"), index = read_file(out + "/frames.pvd");
  const Finished longer = run(scene() + more + "frame_interval = 10\n", {"--resume", middle});
  ASSERT_EQ(longer.status, 0) << longer.err;
  ASSERT_NE(read_file(out + "/frames.pvd").find("frames/80.vtp"), std::string::npos);
  ASSERT_TRUE(std::filesystem::exists(out + "/frames/80.vtp"));

  const auto before = files_below(out);
  const std::string without = scene() + more + "frame_interval = 0\n";
  ASSERT_LT(index.size(), 512u);
  ASSERT_GT(frames.size(), 512u);
  {
    const FileSizeLimit room_for_the_index(512);
    EXPECT_EQ(run(without, {"--resume", middle}).status, 2);
  }
  EXPECT_TRUE(files_below(out) == before) << "nothing has been taken away";

  const Finished resumed = run(without, {"--resume", middle});
  ASSERT_EQ(resumed.status, 0) << resumed.err;
  EXPECT_EQ(read_file(out + "/frames.pvd"), index);
  EXPECT_EQ(read_file(out + "/frames.xyz"), frames);
  std::vector<std::string> left;
  for (const auto& entry : std::filesystem::directory_iterator(out + "/frames"))
    left.push_back(entry.path().filename());
  std::sort(left.begin(), left.end());
  EXPECT_EQ(left, (std::vector<std::string>{"0.vtp", "50.vtp"}));
}

// Whatever order a run keeps its particles in. The two never meet, so that it changes no bit.
TEST(Frames, ListParticlesInTheOrderOfTheScene) {
  const Made made;
  const TemporaryFolder folder;
  dem::State state = dem::Simulation(dem::parse_scene(scene(), "scene.toml")).state();
  const std::vector<std::uint32_t> reverse{state.particles.id[0] == 0 ? 1u : 0u,
                                           state.particles.id[0] == 0 ? 0u : 1u};
  state.particles.permute(reverse);
  ASSERT_EQ(state.particles.id, (std::vector<std::int32_t>{1, 0}));
  state.list.build(state.particles, state.cell, 0.05);
  ASSERT_TRUE(state.list.pairs().empty());
  dem::save_state(state, folder.path("reversed.state"));
  const Finished run =
      run_tool({"run", folder.write("scene.toml", scene()), "--out", folder.path("out"), "--quiet",
                "--resume", folder.path("reversed.state")});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string frames = made.file("frames.xyz"), last = made.file("frames/50.vtp");
  EXPECT_NE(frames.find("cycle=50 "), frames.npos);
  EXPECT_EQ(read_file(folder.path("out/frames.xyz")), frames);
  EXPECT_EQ(read_file(folder.path("out/frames/50.vtp")), last);
}

}  // namespace
}  // namespace tangency::testing
