// SPDX-License-Identifier: GPL-3.0-or-later
// Some cycles of an assembly that is large enough for two threads to share it.
#include <cmath>
#include <iostream>

#include <tangency/dem/parallel.hpp>
#include <tangency/dem/scene.hpp>
#include <tangency/dem/simulation.hpp>

int main() {
  namespace dem = tangency::dem;
  dem::set_threads(2);
  const dem::Scene scene = dem::parse_scene(R"(schema = 1
[cell]
[particles.grain]
count = 512
mean_radius = 10.0
elongation = 1.5
density = 1000.0
[contact]
normal_stiffness = 1e10
shear_stiffness = 1e10
friction_coefficient = 0.5
[[stage]]
kind = "place"
seed = 1
[[stage]]
kind = "compress"
mean_stress = 10e6
max_strain_rate = 0.02
)",
                                            "scene");
  dem::Simulation simulation(scene);
  while (simulation.status() == dem::StageStatus::done) simulation.next_stage();
  const double before = std::abs(simulation.state().cell.edges.determinant());
  for (int cycle = 0; cycle < 20; ++cycle) simulation.step();
  const double after = std::abs(simulation.state().cell.edges.determinant());
  std::cout << "volume " << before << ", " << after << " after " << simulation.state().cycle
            << " cycles\n";
  return simulation.state().cycle == 20 && after < before ? 0 : 1;
}
