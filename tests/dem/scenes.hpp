// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A small scene as text, and ways to change one line of it.
#pragma once

#include <exception>
#include <string>

#include <tangency/dem/scene.hpp>

namespace tangency::testing {

/// Lines are counted from 1; `count` is in line 4.
inline std::string small_scene() {
  return "schema = 1\n"
         "[cell]\n"
         "[particles.grain]\n"
         "count = 27\n"
         "mean_radius = 10.0\n"
         "elongation = 1.4\n"
         "[contact]\n"
         "normal_stiffness = 1.5e10\n"
         "friction_coefficient = 0.5\n"
         "[[stage]]\n"
         "kind = \"place\"\n"
         "[[stage]]\n"
         "kind = \"compress\"\n"
         "mean_stress = 10e6\n"
         "max_strain_rate = 0.05\n"
         "[[stage]]\n"
         "kind = \"relax\"\n"
         "mean_stress = 10e6\n"
         "max_strain_rate = 0.05\n"
         "[output]\n"
         "frame_interval = 1000000\n";
}

/// Disks or spheres of two sizes, put down at random, compacted, grown to an elongation of 1.2 and
/// relaxed. Of one size they would be a crystal at first, which breaks up slowly.
inline std::string growing_scene(int dimensions) {
  const std::string motion =
      "mean_stress = 50e6\nmax_strain_rate = 0.1\ntime_step_factor = 0.3\ndamping = 0.1\n"
      "stress_tolerance = 0.02\n";
  return "schema = 1\n"
         "[cell]\n"
         "dimensions = " +
         std::to_string(dimensions) +
         "\n"
         "[particles.grain]\n"
         "count = 15\n"
         "mean_radius = 10.0\n"
         "[particles.stone]\n"
         "count = 25\n"
         "mean_radius = 7.0\n"
         "[contact]\n"
         "normal_stiffness = 1.5e10\n"
         "friction_coefficient = 0.5\n"
         "[[stage]]\n"
         "kind = \"place\"\n"
         "arrangement = \"random\"\n"
         "bounding_fraction = " +
         std::to_string(dimensions == 2 ? 0.45 : 0.3) +
         "\n"
         "[[stage]]\n"
         "kind = \"compress\"\n"
         "friction_coefficient = 0.0\n" +
         motion +
         "[[stage]]\n"
         "kind = \"grow\"\n"
         "elongation = 1.2\n"
         "increments = 20\n" +
         motion +
         "[[stage]]\n"
         "kind = \"relax\"\n"
         "friction_coefficient = 0.0\n" +
         motion +
         "[output]\n"
         "frame_interval = 1000000\n";
}

/// `text` with the first `before` replaced.
inline std::string with(std::string text, const std::string& before, const std::string& after) {
  return text.replace(text.find(before), before.size(), after);
}

/// The message for a scene, or "" where it is accepted.
inline std::string refusal(const std::string& text) {
  try {
    dem::parse_scene(text, "scene.toml");
  } catch (const dem::SceneError& error) {
    return error.what();
  } catch (const std::exception& error) {
    return std::string("not refused but failed: ") + error.what();
  }
  return "";
}

}  // namespace tangency::testing
