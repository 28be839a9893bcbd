// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A small scene as text, and ways to change one line of it.
#pragma once

#include <string>

namespace tangency::test {

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
         "frame_interval = 0\n";
}

/// `text` with the first `before` replaced.
inline std::string with(std::string text, const std::string& before, const std::string& after) {
  return text.replace(text.find(before), before.size(), after);
}

}  // namespace tangency::test
