// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/check_forecast.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <tangency/dem/contact/thin_cell.hpp>

namespace tangency::inline v0::dem {
namespace {

using std::numbers::pi;

/// A packing of equal spheres (disks) where it begins to bear stress, and how its contacts grow
/// with the root of its volume fraction [OHern2003]; by how much is chosen. With friction it is
/// looser and has fewer contacts, how many depends on how it was made: chosen between what small
/// and large friction give [Onoda1990].
struct Packing {
  double fraction, contacts, rise;
};
constexpr Packing jammed(int dimensions, bool has_friction) {
  if (has_friction) return dimensions == 2 ? Packing{0.80, 3.2, 3.6} : Packing{0.58, 4.6, 7.9};
  return dimensions == 2 ? Packing{0.84, 4.0, 3.6} : Packing{0.64, 6.0, 7.9};
}

/// The mean force of a contact over stress times the square of the radius (in the plane over stress
/// times radius), in a packing whose mean overlap is `overlap` radii: stress is force times branch
/// vector over volume, summed over contacts.
double force_of(double overlap, int dimensions, bool has_friction) {
  const Packing start = jammed(dimensions, has_friction);
  const double fraction = start.fraction * (1.0 + 0.5 * dimensions * overlap);
  const double contacts =
      start.contacts + start.rise * std::sqrt(std::max(0.0, fraction - start.fraction));
  return (dimensions == 2 ? 2.0 : 4.0) * pi / (fraction * contacts);
}

const ContactLaw& own_law(const Scene& scene, std::size_t type) {
  return scene.laws.law[type * scene.laws.types + type];
}

/// Of two equal spheres of that radius.
double force_of_law(const ContactLaw& law, double radius, double overlap) {
  const double depth = overlap * radius;
  if (!law.hertz) return law.normal_stiffness * depth;
  return 4.0 / 3.0 * law.hertz->contact_modulus() * std::sqrt(0.5 * radius) * std::pow(depth, 1.5);
}

double force_wanted(const Scene& scene, std::size_t type, const Pressed& pressed, double overlap) {
  const double radius = scene.particle_types[type].batch.shape.mean_radius;
  const double area = scene.dimensions == 2 ? radius : radius * radius;
  return pressed.stress * area * force_of(overlap, scene.dimensions, pressed.has_friction);
}

/// Where a type's law gives the force that the stress wants, over the mean radius; at most 1.
double overlap_under(const Scene& scene, std::size_t type, const Pressed& pressed) {
  const double radius = scene.particle_types[type].batch.shape.mean_radius;
  double low = 0.0, high = 1.0;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    const bool is_enough = force_of_law(own_law(scene, type), radius, middle) >
                           force_wanted(scene, type, pressed, middle);
    (is_enough ? high : low) = middle;
  }
  return high;
}

/// What all weight makes on the walls that bear it.
double weight_stress(const Simulation& simulation) {
  const State& state = simulation.state();
  const Scene& scene = simulation.scene();
  const Vec3 edges = state.cell.edges.diagonal();
  double mass = 0.0, most = 0.0;
  for (const double one : state.particles.mass) mass += one;
  for (int k = 0; k < scene.dimensions; ++k)
    if (scene.walled[static_cast<std::size_t>(k)])
      most = std::max(most, mass * std::abs(scene.gravity[k]) * edges[k] / edges.prod());
  return most;
}

/// Follows cell and stress from stage to stage.
class Forecaster {
 public:
  explicit Forecaster(const Simulation& simulation)
      : simulation_(simulation),
        scene_(simulation.scene()),
        edges_(simulation.state().cell.edges.diagonal()),
        stress_(weight_stress(simulation)),
        to_packing_(compression_to_packing(simulation.state().particles,
                                           simulation.state().cell.volume())) {
    const double factor = simulation.stage().drive->time_step_factor;
    characteristic_time_ = simulation.time_step() / factor;
  }

  StageForecast next(std::size_t index) {
    const Stage& stage = scene_.stages[index];
    const Drive& drive = *stage.drive;
    StageForecast seen{};
    seen.stage = index;
    seen.time_step = drive.time_step_factor * characteristic_time_;
    seen.steps_a_contact = pi / (std::numbers::sqrt2 * drive.time_step_factor);
    const bool is_current = index == simulation_.state().stage;
    seen.least = is_current ? simulation_.cycles_needed()
                            : cycles_needed(stage, seen.time_step, scene_.dimensions,
                                            {.to_packing = to_packing_});
    if (const double held = scene_.held_stress(stage); held > 0.0) stress_ = held;
    if (drive.stress_tolerance) {
      to_packing_ = 0.0;
      pack();
    }
    strain(stage, seen);
    if (stress_ > 0.0) add_stress(drive, seen);
    add_cell(index, seen);
    return seen;
  }

 private:
  /// The cell shrinks, its edges in proportion, to a packing that bears stress.
  void pack() {
    double solid = 0.0;
    for (const Vec3& axes : simulation_.state().particles.semi_axes)
      solid += volume_of(axes, scene_.dimensions);
    const double wanted = solid / jammed(scene_.dimensions, false).fraction;
    const double shrunk = std::min(1.0, wanted / edges_.prod());
    edges_.head(scene_.dimensions) *= std::pow(shrunk, 1.0 / scene_.dimensions);
  }

  /// By the rates that the stage is given, for as long as it lasts at least.
  void strain(const Stage& stage, const StageForecast& seen) {
    const Vec3 rate = stage.drive->loading.strain_rate.diagonal();
    edges_.array() *= (rate.array() * seen.least.cycles * seen.time_step).exp();
  }

  void add_stress(const Drive& drive, StageForecast& seen) {
    const auto& laws = scene_.laws.law;
    const bool slides = std::any_of(laws.begin(), laws.end(), [&](const ContactLaw& law) {
      return drive.friction_coefficient.value_or(law.friction_coefficient) > 0.0;
    });
    seen.pressed = {stress_, slides};
    const double time = scene_.inertial_time(stress_);
    const double rate = drive.loading.strain_rate.cwiseAbs().maxCoeff();
    if (rate > 0.0) seen.inertial_number = rate * time;
    if (!drive.loading.targets.empty())
      seen.servo_inertial_number = drive.loading.servo.max_strain_rate * time;
    for (std::size_t type = 0; type < scene_.particle_types.size(); ++type) {
      const double overlap = overlap_under(scene_, type, *seen.pressed);
      if (seen.overlap && *seen.overlap >= overlap) continue;
      seen.overlap = overlap;
      seen.softest = type;
    }
  }

  void add_cell(std::size_t index, StageForecast& seen) {
    const auto& growth = scene_.stages[index].growth;
    LeastCell least;
    for (std::size_t type = 0; type < scene_.particle_types.size(); ++type) {
      const Shape shape = scene_.shape_in(type, index, growth ? growth->increments : 0);
      least.add(shape.semi_axes(scene_.dimensions), scene_.particle_types[type].batch.count);
    }
    double shortest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < scene_.dimensions; ++k)
      if (!scene_.walled[static_cast<std::size_t>(k)]) shortest = std::min(shortest, edges_[k]);
    if (std::isfinite(shortest)) seen.cell_over_least = shortest / least.period();
  }

  const Simulation& simulation_;
  const Scene& scene_;
  Vec3 edges_;
  double stress_, to_packing_, characteristic_time_ = 0.0;
};

}  // namespace

std::vector<StageForecast> forecast(const Simulation& simulation) {
  std::vector<StageForecast> all;
  if (simulation.finished()) return all;
  Forecaster forecaster(simulation);
  for (std::size_t k = simulation.state().stage; k < simulation.scene().stages.size(); ++k)
    all.push_back(forecaster.next(k));
  return all;
}

double stiffer_by(const Scene& scene, std::size_t type, const Pressed& pressed, double overlap) {
  const double radius = scene.particle_types[type].batch.shape.mean_radius;
  return force_wanted(scene, type, pressed, overlap) /
         force_of_law(own_law(scene, type), radius, overlap);
}

double overlap_of_impact(const Scene& scene, std::size_t type, double speed) {
  const Batch& batch = scene.particle_types[type].batch;
  const double radius = batch.shape.mean_radius;
  const double mass =
      0.5 * batch.density * volume_of(batch.shape.semi_axes(scene.dimensions), scene.dimensions);
  const ContactLaw& law = own_law(scene, type);
  if (!law.hertz) return speed * std::sqrt(mass / law.normal_stiffness) / radius;
  // m v^2 / 2 = 2/5 k depth^(5/2)
  const double k = 4.0 / 3.0 * law.hertz->contact_modulus() * std::sqrt(0.5 * radius);
  return std::pow(1.25 * mass * speed * speed / k, 0.4) / radius;
}

double memory_of(std::size_t particles) {
  // Measured: 10 MB for a few, and a million dense spheroids with 6.3 contacts each 1.4 GB; 2 kB
  // each leave room for lists that are renewed.
  return 10e6 + 2000.0 * static_cast<double>(particles);
}

}  // namespace tangency::inline v0::dem
