// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Simulations that have come to a stage.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include <tangency/dem/simulation.hpp>

namespace tangency::testing {

/// At the start of a stage, counted from 0; of as many as there are, at the end of the run.
/// @throws std::runtime_error  where a stage before it runs out of cycles
inline dem::Simulation at_stage(const std::string& scene, std::size_t stage) {
  dem::Simulation simulation(dem::parse_scene(scene, "scene.toml"));
  while (simulation.state().stage < stage && !simulation.finished()) {
    const dem::StageStatus status = simulation.status();
    if (status == dem::StageStatus::out_of_cycles)
      throw std::runtime_error("stage " + std::to_string(simulation.state().stage) +
                               " runs out of cycles");
    if (status == dem::StageStatus::done)
      simulation.next_stage();
    else
      simulation.step();
  }
  return simulation;
}

/// At the end of the run.
inline dem::Simulation at_end(const std::string& scene) {
  return at_stage(scene, static_cast<std::size_t>(-1));
}

}  // namespace tangency::testing
