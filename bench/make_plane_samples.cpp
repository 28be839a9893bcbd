// SPDX-License-Identifier: GPL-3.0-or-later
// Makes samples such as those in tests/data/plane_samples, which the simulator of state version 2
// made:
//     make_plane_samples dem/scenes/plane-1000.toml DIR
// Runs the scene, and where a stage ends whose name starts with "depth" writes DIR/STAGE.csv, a row
// an ellipse: centre x, y wrapped into the cell, semi-axes a >= b, direction ux, uy of the first.
// DIR/samples.csv has a row a sample: the periodic cell's edges, and what to expect of it.
#include <array>
#include <charconv>
#include <cstddef>
#include <iostream>
#include <string>

#include <tangency/dem/simulation.hpp>
#include <tangency/dem/whole_file.hpp>
#include <tangency/geometry/tables/command_line.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace {

using namespace tangency;

const std::string head =
    "# SPDX-License-Identifier: GPL-3.0-or-later\n"
    "# Made by: make_plane_samples dem/scenes/plane-1000.toml tests/data/plane_samples\n";

std::string bodies(const dem::State& state) {
  std::string text = head + "x,y,a,b,ux,uy\n";
  const dem::Particles& p = state.particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec3 x = p.position[i] - state.cell.translation(state.cell.image_of(p.position[i]));
    const Eigen::Quaterniond& q = p.orientation[i];
    text += tables::to_text(x[0]) + "," + tables::to_text(x[1]) + "," +
            tables::to_text(p.semi_axes[i][0]) + "," + tables::to_text(p.semi_axes[i][1]) + "," +
            tables::to_text(q.w() * q.w() - q.z() * q.z()) + "," +
            tables::to_text(2.0 * q.w() * q.z()) + "\n";
  }
  return text;
}

/// Depth over the mean radius.
std::string index_row(const dem::Simulation& simulation) {
  const dem::State& state = simulation.state();
  const dem::Observation seen = simulation.observe();
  const double radius = simulation.scene().smallest_mean_radius();
  return simulation.stage().name + "," + tables::to_text(state.cell.edges(0, 0)) + "," +
         tables::to_text(state.cell.edges(1, 1)) + "," + std::to_string(seen.contacts) + "," +
         tables::to_text(seen.mean_overlap / radius) + "\n";
}

int make(const std::string& scene, const std::string& directory) {
  dem::Simulation simulation(dem::load_scene(scene));
  std::string index = head + "sample,cell_x,cell_y,contacts,mean_depth\n";
  while (!simulation.finished()) {
    const dem::StageStatus status = simulation.status();
    const std::string& name = simulation.stage().name;
    if (status == dem::StageStatus::out_of_cycles) {
      std::cerr << "make_plane_samples: stage " << name << " did not end\n";
      return 1;
    }
    if (status == dem::StageStatus::running) {
      simulation.step();
      continue;
    }
    if (name.starts_with("depth")) {
      dem::write_whole(directory + "/" + name + ".csv", bodies(simulation.state()));
      index += index_row(simulation);
    }
    simulation.next_stage();
  }
  dem::write_whole(directory + "/samples.csv", index);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  tangency::tables::Program program("make_plane_samples",
                                    "Makes tests/data/plane_samples again, from a scene of disks");
  std::string scene, directory;
  program.option("SCENE", scene, "Scene in TOML").required();
  program.option("DIR", directory, "Directory to write to").required();
  program.runs([&] { return make(scene, directory); });
  return program.run(argc, argv);
}
