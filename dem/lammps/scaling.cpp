// SPDX-License-Identifier: GPL-2.0-or-later
#include <tangency/dem/lammps/scaling.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace tangency::inline v0::lammps {
namespace {

/// Standard deviations by which the slowest of many ranks is slower. Chosen: of 1e4 to 1e5 ranks.
constexpr double kSlowest = 4.0;

/// Sums over all ranks in a step: is a list still valid, and the stress of a servo.
constexpr double kSums = 2.0;

struct Part {
  const char* name;
  double seconds;
};

}  // namespace

ScalingRow scaled(const ScalingModel& model, double particles, double ranks) {
  const double n = particles / ranks;
  const double ghosts = std::pow(std::cbrt(n) + model.halo, 3.0) - n;
  const double bytes = ghosts * model.ghost_bytes;
  const bool alone = ranks == 1.0;
  const double on_node = std::min(ranks, model.node_ranks);
  const bool leaves = ranks > model.node_ranks;
  const std::array parts{
      Part{"bodies of ghosts", ghosts * model.ghost},
      Part{"the slowest rank", alone ? 0.0 : kSlowest * model.variation * std::sqrt(n) * model.own},
      Part{"the wire", leaves ? bytes * model.leaving * on_node / model.node_bandwidth : 0.0},
      Part{"copies of halos", bytes * model.copies / model.copy_bandwidth},
      Part{"latency", alone ? 0.0 : (model.messages + kSums * std::log2(ranks)) * model.latency}};
  ScalingRow row;
  row.own_per_rank = n;
  row.ghosts_per_own = ghosts / n;
  row.step = n * model.own;
  for (const Part& part : parts) row.step += part.seconds;
  row.efficiency = n * model.own / row.step;
  row.bytes_per_rank = (n + ghosts) * model.bytes;
  row.bounded_by = std::max_element(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
                     return a.seconds < b.seconds;
                   })->name;
  return row;
}

}  // namespace tangency::inline v0::lammps
