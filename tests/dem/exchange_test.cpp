// SPDX-License-Identifier: GPL-3.0-or-later
/// `tangency-dem export` and `import`: what goes out comes back, to the bit where the format can,
/// and what is no such file is refused in one line. `exchange_check.py` has other programs read
/// them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
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

/// Triaxial bodies of two types that turn, in a cell that a strain along the edges has changed.
std::string scene() {
  return "schema = 1\n[particles.grain]\ncount = 20\nmean_radius = 10.0\nelongation = 1.4\n"
         "flatness = 1.2\n[particles.stone]\ncount = 7\nmean_radius = 13.0\ndensity = 2650.0\n"
         "elongation = 1.1\n[contact]\nnormal_stiffness = 1.5e10\nfriction_coefficient = 0.5\n"
         "[[stage]]\nkind = \"place\"\n[[stage]]\nkind = \"compress\"\nmean_stress = 10e6\n"
         "max_strain_rate = 0.05\n";
}

class Exchange : public ::testing::Test {
 protected:
  void run(const std::string& text) {
    const Finished ended = run_tool({"run", folder_.write("scene.toml", text), "--out",
                                     folder_.path("out"), "--quiet", "--replace"});
    ASSERT_EQ(ended.status, 0) << ended.err;
  }
  std::string exported(const std::string& format) const {
    const std::string file = folder_.path("sample." + format);
    const Finished ended = run_tool({"export", state_, "--format", format, "--out", file});
    EXPECT_EQ(ended.status, 0) << ended.err;
    return file;
  }
  static Rows imported(const std::string& file) {
    const Finished ended = run_tool({"import", file});
    EXPECT_EQ(ended.status, 0) << ended.err;
    return rows_of(ended.out);
  }
  Rows particles() const { return rows_of(run_tool({"particles", state_}).out); }

  TemporaryFolder folder_;
  std::string state_ = folder_.path("out/final.state");
};

constexpr const char* kPlaces[] = {"x", "y", "z", "r1", "r2", "r3", "qw", "qx", "qy", "qz"};
constexpr const char* kSpeeds[] = {"vx", "vy", "vz", "wx", "wy", "wz"};

TEST_F(Exchange, BringsBackTheSameDoublesThroughTextOfLammpsAndXyz) {
  run(scene());
  const Rows before = particles();
  double largest = 0.0;  // angular velocity
  for (const auto& row : before) largest = std::max(largest, std::abs(std::stod(row.at("wx"))));
  for (const std::string format : {"lammps-data", "lammps-dump", "xyz"}) {
    const Rows after = imported(exported(format));
    ASSERT_EQ(after.size(), before.size()) << format;
    for (std::size_t k = 0; k < before.size(); ++k) {
      for (const char* name : kPlaces) EXPECT_EQ(after[k].at(name), before[k].at(name)) << format;
      const bool by_momentum = format == "lammps-data";
      for (const char* name : kSpeeds) {
        const std::string &is = after[k].at(name), &was = before[k].at(name);
        if (by_momentum && name[0] == 'w') {
          EXPECT_NEAR(std::stod(is), std::stod(was), 1e-14 * largest) << name;
        } else {
          EXPECT_EQ(is, was) << format;
        }
      }
      EXPECT_NEAR(std::stod(after[k].at("density")), before[k].at("type") == "0" ? 1000 : 2650,
                  1e-11);
    }
  }
}

TEST_F(Exchange, BringsBackNumbersOf32BitsThroughGsd) {
  run(scene());
  const Rows before = particles(), after = imported(exported("gsd"));
  const Mat3 edges = dem::load_state(state_).cell.edges;
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t k = 0; k < before.size(); ++k) {
    const auto both = [&](const char* name) {
      return std::pair(std::stod(after[k].at(name)), std::stod(before[k].at(name)));
    };
    for (const char* name : {"vx", "vy", "vz", "qw", "qx", "qy", "qz"}) {
      const auto [is, was] = both(name);
      EXPECT_EQ(is, static_cast<double>(static_cast<float>(was))) << name;
    }
    for (const char* name : {"r1", "r2", "r3"}) EXPECT_EQ(both(name).first, both(name).second);
    for (const char* name : {"wx", "wy", "wz"})
      EXPECT_NEAR(both(name).first, both(name).second, 1e-6);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto [is, was] = both(kPlaces[axis]);
      const double edge = edges(axis, axis);
      EXPECT_NEAR(is, was, 1e-6 * edge) << "in the same image";
    }
  }
}

/// Chunks of a type in a file of GSD: their names and where their numbers begin.
std::vector<std::pair<std::string, std::size_t>> chunks_of_gsd(const std::string& bytes,
                                                               std::uint8_t type) {
  const auto at = [&](std::size_t place, auto number) {
    std::memcpy(&number, bytes.data() + place, sizeof number);
    return number;
  };
  // Of the header: places of the index and of the names; of an entry: place, name and type.
  const std::size_t index = at(8, std::uint64_t{}), names = at(24, std::uint64_t{});
  std::vector<std::string> list;
  for (std::size_t k = names; bytes[k] != '\0'; k += list.back().size() + 1)
    list.emplace_back(bytes.c_str() + k);
  std::vector<std::pair<std::string, std::size_t>> places;
  for (std::size_t k = index; at(k + 16, std::uint64_t{}) != 0; k += 32)
    if (at(k + 30, std::uint8_t{}) == type)
      places.emplace_back(list[at(k + 28, std::uint16_t{})], at(k + 16, std::uint64_t{}));
  return places;
}

TEST_F(Exchange, TakesPlacesOfGsdInTheImageThatItSays) {
  run(scene());
  std::string bytes = read_file(exported("gsd"));
  const double x = std::stod(imported(folder_.write("moved.gsd", bytes))[0].at("x"));
  const auto images = chunks_of_gsd(bytes, 7);  // integers of 32 bits
  ASSERT_EQ(images.size(), 1u);
  ASSERT_EQ(images[0].first, "particles/image");
  const std::int32_t image = 3;
  std::memcpy(bytes.data() + images[0].second, &image, sizeof image);
  const double moved = std::stod(imported(folder_.write("moved.gsd", bytes))[0].at("x"));
  const double edge = dem::load_state(state_).cell.edges(0, 0);
  EXPECT_NEAR(moved - x, image * edge, 1e-6 * edge);
}

TEST_F(Exchange, RefusesNumbersOfGsdThatAreNotFinite) {
  run(scene());
  const std::string whole = read_file(exported("gsd"));
  const auto places = chunks_of_gsd(whole, 9);  // floats
  ASSERT_EQ(places.size(), 7u) << "box, mass, moments, places, orientations, both velocities";
  for (const auto& [name, place] : places)
    for (const auto& [value, word] : {std::pair(std::numeric_limits<float>::quiet_NaN(), "nan"),
                                      std::pair(std::numeric_limits<float>::infinity(), "inf")}) {
      std::string damaged = whole;
      std::memcpy(damaged.data() + place + sizeof value, &value, sizeof value);
      const std::string file = folder_.write("damaged.gsd", damaged);
      const Finished ended = run_tool({"import", file});
      EXPECT_EQ(ended.status, 2) << name;
      EXPECT_EQ(ended.out, "");
      EXPECT_EQ(ended.err.find(file + ": " + name + "["), 0u) << ended.err;
      EXPECT_NE(ended.err.find(std::string("] = ") + word + ": finite numbers\n"), ended.err.npos)
          << ended.err;
    }
}

// A scene and its table are two files, of which both appear or none.
TEST_F(Exchange, WritesASceneBesideItsTableOrNeither) {
  run(scene());
  const std::string xyz = exported("xyz"), table = folder_.write("table.csv", "earlier");
  const std::vector<std::pair<std::string, std::string>> cases{
      {table, table},
      {table, folder_.path("out/../table.csv")},
      {"-", folder_.path("scene2.toml")},
      {table, "-"},
      {table, folder_.path("nowhere/scene.toml")}};
  for (const auto& [out, begun] : cases) {
    const Finished ended = run_tool({"import", xyz, "--out", out, "--scene", begun});
    EXPECT_EQ(ended.status, 2) << out << " " << begun;
    EXPECT_EQ(ended.out, "");
    EXPECT_EQ(read_file(table), "earlier");
    EXPECT_FALSE(std::filesystem::exists(folder_.path("scene2.toml")));
  }
}

TEST_F(Exchange, BeginsASceneThatNamesAnyFile) {
  run(scene());
  const std::string odd = "a\"b\\c\nd.csv", begun = folder_.path("begun.toml");
  const std::string source = folder_.write("s\n\"t.xyz", read_file(exported("xyz")));
  ASSERT_EQ(run_tool({"import", source, "--out", folder_.path(odd), "--scene", begun}).status, 0);
  folder_.write("begun.toml", read_file(begun) +
                                  "[[stage]]\nkind = \"servo\"\nduration = 1\n[contact]\n"
                                  "normal_stiffness = 1.5e10\n[output]\n");
  const Finished ended = run_tool({"run", begun, "--out", folder_.path("again"), "--quiet"});
  EXPECT_EQ(ended.status, 0) << ended.err;
}

// A cell that shear has tilted is turned: distances, and axes seen from branch vectors, stay.
TEST_F(Exchange, OfATiltedCellTurnsEverythingAlike) {
  run(scene() + "[[stage]]\nkind = \"servo\"\nduration = 60\nshear_rate = [0.1, 0.05, 0.02]\n");
  ASSERT_FALSE(dem::load_state(state_).cell.is_box());
  const Rows before = particles(), after = imported(exported("lammps-dump"));
  const auto seen = [](const Rows& table, std::size_t a, std::size_t b) {
    const auto number = [&](std::size_t k, const char* name) {
      return std::stod(table[k].at(name));
    };
    const Vec3 branch(number(b, "x") - number(a, "x"), number(b, "y") - number(a, "y"),
                      number(b, "z") - number(a, "z"));
    const Quaternion q(number(a, "qw"), number(a, "qx"), number(a, "qy"), number(a, "qz"));
    const Vec3 spin(number(a, "wx"), number(a, "wy"), number(a, "wz"));
    return std::pair(Vec3(q.conjugate() * branch), Vec3(q.conjugate() * spin));
  };
  for (std::size_t k = 1; k < before.size(); ++k) {
    const auto was = seen(before, k - 1, k), is = seen(after, k - 1, k);
    EXPECT_LT((was.first - is.first).norm(), 1e-11);
    EXPECT_LT((was.second - is.second).norm(), 1e-11);
    EXPECT_NE(before[k].at("y"), after[k].at("y"));
  }
}

// A foreign sample, with a scene that places it; one more stage makes it a run.
TEST_F(Exchange, BeginsASceneWhoseRunHasTheSameBodies) {
  run(scene());
  const Rows before = particles();
  const std::string grains = folder_.path("grains.csv"), begun = folder_.path("grains.toml");
  for (const std::string format : {"lammps-data", "gsd"}) {
    const Finished made = run_tool({"import", exported(format), "--out", grains, "--scene", begun});
    ASSERT_EQ(made.status, 0) << made.err;
    folder_.write("grains.toml", read_file(begun) +
                                     "[[stage]]\nkind = \"servo\"\nduration = 1\n[contact]\n"
                                     "normal_stiffness = 1.5e10\n[output]\n");
    const Finished ended =
        run_tool({"run", begun, "--out", folder_.path("again"), "--quiet", "--replace"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const dem::State state = dem::load_state(folder_.path("again/final.state"));
    const dem::State first = dem::load_state(state_);
    ASSERT_EQ(state.particles.size(), before.size());
    EXPECT_LT((state.cell.edges - first.cell.edges).norm(), 1e-6 * first.cell.edges.norm());
    // One cycle moves them by no more than this.
    const auto placed = state.particles.index_of_id(), was = first.particles.index_of_id();
    for (std::size_t id = 0; id < before.size(); ++id) {
      const dem::Particles &is = state.particles, &of = first.particles;
      EXPECT_LT((is.semi_axes[placed[id]] - of.semi_axes[was[id]]).norm(), 1e-12);
      EXPECT_NEAR(is.mass[placed[id]], of.mass[was[id]], 1e-6 * of.mass[was[id]]);
      EXPECT_NEAR(std::abs(is.orientation[placed[id]].dot(of.orientation[was[id]])), 1.0, 1e-3);
    }
  }
}

TEST_F(Exchange, TurnsBodyAxesSoThatSemiAxesDescend) {
  const Rows bodies = imported(folder_.write(
      "one.dump",
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp ff\n-5 5\n0 10\n0 10\n"
      "ITEM: ATOMS id x y z shapex shapey shapez\n1 1 2 3 2 6 4\n"));
  ASSERT_EQ(bodies.size(), 1u);
  const auto number = [&](const char* name) { return std::stod(bodies[0].at(name)); };
  EXPECT_EQ(Vec3(number("x"), number("y"), number("z")), Vec3(6, 2, 3)) << "from the corner";
  EXPECT_EQ(Vec3(number("r1"), number("r2"), number("r3")), Vec3(3, 2, 1)) << "radii";
  const Mat3 turn = Quaternion(number("qw"), number("qx"), number("qy"), number("qz"))
                        .normalized()
                        .toRotationMatrix();
  const Mat3 shape = turn * Vec3(3, 2, 1).asDiagonal() * turn.transpose();
  EXPECT_LT((shape - Mat3(Vec3(1, 3, 2).asDiagonal())).norm(), 1e-14);
}

// The last frame, or the one that is asked for; spheres; walls where the boundary is not periodic.
TEST_F(Exchange, TakesFramesSpheresAndWallsOfForeignDumps) {
  const auto frame = [](int step, double x) {
    return "ITEM: TIMESTEP\n" + std::to_string(step) +
           "\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp ff pp\n0 10\n0 20\n0 30\n"
           "ITEM: ATOMS id type xs ys zs radius mass\n2 2 .5 .5 .5 1 1\n1 1 " +
           std::to_string(x) + " 0 0 2 1\n";
  };
  const std::string file = folder_.write("two.dump", frame(0, 0.25) + frame(10, 0.75));
  EXPECT_EQ(imported(file)[0].at("x"), "7.5");
  EXPECT_EQ(imported(file)[1].at("z"), "15");
  EXPECT_EQ(imported(file)[0].at("r3"), "2");
  EXPECT_EQ(rows_of(run_tool({"import", file, "--frame", "0"}).out)[0].at("x"), "2.5");
  const std::string begun = folder_.path("two.toml");
  ASSERT_EQ(run_tool({"import", file, "--out", folder_.path("two.csv"), "--scene", begun}).status,
            0);
  EXPECT_NE(read_file(begun).find("size = [10, 20, 30]\nwalls = \"y\"\n"), std::string::npos);
  EXPECT_NE(read_file(begun).find("file = \"two.csv\""), std::string::npos);
}

TEST_F(Exchange, RefusesWhatIsNoSuchFileInOneLine) {
  run(scene());
  std::string data = read_file(exported("lammps-data")), dump = read_file(exported("lammps-dump"));
  const std::string xyz = read_file(exported("xyz")), gsd = read_file(exported("gsd"));
  const std::vector<std::pair<std::string, std::string>> cases{
      {with(data, "27 atoms", "28 atoms"), "atoms = 28: as many as in the section Atoms, 27"},
      {with(data, "# ellipsoid", "# charge"), "Atoms # = charge: atom_style ellipsoid or sphere"},
      {with(data, "\n1 1 1 ", "\n1 1 0 "), "ellipsoidflag = 0: 1: every atom is an ellipsoid"},
      {with(data, "\n1 1 1 ", "\n1 0 1 "), "type = 0: an integer from 1 to 1000000"},
      {with(dump, "shapex", "length"), "with columns shapex shapey shapez (diameters)"},
      {with(dump, "NUMBER OF ATOMS\n27", "NUMBER OF ATOMS\n28"), "28 rows"},
      {with(xyz, "aspherical_shape:R:3", "aspherical_shape:R:1"), "aspherical_shape of 3 numbers"},
      {with(xyz, "Lattice=\"", "Lattice=\"nan "), "Lattice = "},
      {gsd.substr(0, gsd.size() / 2), "a whole GSD file: this one is cut off"},
      {with(gsd, "\"Ellipsoid\"", "\"Sandwich?\""), "shapes of type Ellipsoid or Sphere"},
      {with(gsd, "\"Ellipsoid\"", "5          "), "shapes of type Ellipsoid or Sphere"},
      {with(gsd, "\"a\": ", "\"a\":-"), "from 1e-30 to 1e+30"},
      {with(xyz, "\n1 ", "\n1 1 "), "27 rows of"},
      {"", "empty"}};
  const std::string out = folder_.write("table.csv", "earlier");
  for (const auto& [text, message] : cases) {
    const std::string file = folder_.write("bad", text);
    const Finished ended = run_tool({"import", file, "--out", out});
    EXPECT_EQ(ended.status, 2) << message;
    EXPECT_EQ(ended.err.find(file + ":"), 0u) << ended.err;
    EXPECT_NE(ended.err.find(message), ended.err.npos) << ended.err;
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
    EXPECT_EQ(read_file(out), "earlier");
  }
  const std::string whole = exported("xyz");
  EXPECT_EQ(run_tool({"import", whole, "--frame", "1"}).status, 2);
  EXPECT_EQ(run_tool({"import", whole, "--scene", folder_.path("s.toml")}).status, 2);
  EXPECT_EQ(run_tool({"export", whole, "--format", "xyz"}).status, 2);
  EXPECT_EQ(run_tool({"export", state_}).status, 2);
}

// Every text of a damaged file ends in a refusal or a table, and never in a signal.
TEST_F(Exchange, SurvivesDamagedFiles) {
  run(scene());
  for (const std::string format : {"lammps-data", "lammps-dump", "xyz", "gsd"}) {
    const std::string whole = read_file(exported(format));
    for (std::size_t cut = 0; cut < 12; ++cut) {
      std::string damaged = whole.substr(0, whole.size() * cut / 12);
      const Finished ended = run_tool({"import", folder_.write("cut", damaged)});
      EXPECT_EQ(ended.signal, 0);
      damaged = whole;
      damaged[whole.size() * cut / 12] ^= 0x15;
      const Finished changed = run_tool({"import", folder_.write("changed", damaged)});
      EXPECT_EQ(changed.signal, 0) << format << " " << cut;
      EXPECT_EQ(changed.out.find("inf"), changed.out.npos) << cut;
      EXPECT_EQ(changed.out.find(",,"), changed.out.npos) << cut;
    }
  }
}

TEST_F(Exchange, RefusesAPlaneState) {
  run(with(with(scene(), "[particles.grain]", "[cell]\ndimensions = 2\n[particles.grain]"),
           "flatness = 1.2\n", ""));
  const Finished ended = run_tool({"export", state_, "--format", "xyz"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("plane"), ended.err.npos) << ended.err;
}

}  // namespace
}  // namespace tangency::testing
