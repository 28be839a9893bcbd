// SPDX-License-Identifier: MIT
#include <tangency/dem/scene/cycles_needed.hpp>

#include <algorithm>
#include <cmath>

namespace tangency::inline v0::dem {
namespace {

/// The share of a cell that bounding spheres (circles) fill where an assembly begins to bear
/// stress, at the loosest, so that compaction takes at least as long as to there. Chosen: below
/// 0.55 and 0.77, the loosest packings of spheres and of disks that stand [Onoda1990].
constexpr double loosest_packing(int dimensions) { return dimensions == 2 ? 0.7 : 0.5; }

}  // namespace

double compression_to_packing(const Particles& particles, double cell_volume) {
  double bounding = 0.0;
  for (const Vec3& axes : particles.semi_axes)
    bounding += volume_of(Vec3::Constant(axes.maxCoeff()), particles.dimensions);
  return std::max(0.0, std::log(cell_volume * loosest_packing(particles.dimensions) / bounding));
}

CyclesNeeded cycles_needed(const Stage& stage, double time_step, int dimensions,
                           const StageProgress& done) {
  const Drive& drive = *stage.drive;
  CyclesNeeded most;
  const auto needs = [&](double cycles, const char* key) {
    if (cycles > most.cycles) most = {std::ceil(cycles), key};
  };
  if (drive.duration) needs(static_cast<double>(*drive.duration - done.cycles), "duration");
  if (drive.axial_strain) {
    const int axial = dimensions - 1;
    const double a_cycle = -std::log1p(drive.loading.strain_rate(axial, axial) * time_step);
    needs((*drive.axial_strain - done.axial_strain) / a_cycle, "axial_strain");
  }
  if (drive.ramp && drive.ramp->over != Ramp::Over::strain) {
    const bool is_time = drive.ramp->over == Ramp::Over::time;
    needs(drive.ramp->length / (is_time ? time_step : 1.0) - static_cast<double>(done.cycles),
          is_time ? "ramp_time" : "ramp_cycles");
  }
  if (drive.stress_tolerance) {  // straining as fast as allowed
    const double a_cycle =
        -std::log1p(-drive.loading.servo.max_strain_rate * time_step) * dimensions;
    needs(done.to_packing / a_cycle, "mean_stress");
  }
  if (stage.growth)
    needs(static_cast<double>(stage.growth->increments - done.increments),
          stage.growth->cycles_per_percent ? "cycles_per_percent" : "increments");
  return most;
}

}  // namespace tangency::inline v0::dem
