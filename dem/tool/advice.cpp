// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/advice.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <tangency/dem/tool/safe_text.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

/// Inertial number from which a simple shear is a flow: its stress swings, and a servo that removes
/// half of its error in a cycle throws it about. Measured on plane-shear at 0.1: held at 100 the
/// mean was 455 at a gain of 0.5, 99 at 0.05 and 34 at 0.005, and it swung by 224, 27 and 19.
constexpr double kFlow = 0.005, kGainOfFlow = 0.05;

/// Of the gain times what springs and dampers answer to a strain, over what springs do: above the
/// first the servo rings, the second is advised. Measured on a sheared sample of a sieve curve from
/// D to 2.5 D (docs/choosing.md): it holds at 1.15 and less, and rings at 1.4 and more.
constexpr double kRings = 1.25, kQuiet = 0.5;

std::string joined(const std::vector<std::string>& parts, const std::string& between) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : between) + part;
  return text;
}

std::vector<std::string> texts_of(const std::vector<Change>& changes) {
  std::vector<std::string> texts;
  for (const Change& one : changes) texts.push_back(one.key + " to " + one.to);
  return texts;
}

/// The same, and the bound of its servo.
std::vector<std::string> slower_rates(const Drive& stage, double share, int dimensions) {
  std::vector<std::string> keys = texts_of(slower_strains(stage, share, dimensions));
  if (!stage.loading.targets.empty())
    keys.push_back("max_strain_rate to " +
                   rounded_down(share * stage.loading.servo.max_strain_rate));
  return keys;
}

/// So many times the particles.
std::string advice_on_count(const Scene& scene, double times) {
  if (scene.particle_types.size() > 1)
    return "take " + rounded_up(times) + " times as many particles of each type";
  const ParticleType& type = scene.particle_types.front();
  return "raise particles." + type.name + ".count to " +
         whole_up(times * static_cast<double>(type.batch.count));
}

/// How many times the particles would fill a cube, or a square, of that edge without a pore.
double times_to_fill(const Simulation& simulation, double edge) {
  const Particles& particles = simulation.state().particles;
  double volume = 0.0;
  for (const Vec3& axes : particles.semi_axes) volume += volume_of(axes, particles.dimensions);
  return std::pow(edge, particles.dimensions) / volume;
}

double largest_target(const Drive& stage) {
  double largest = 0.0;
  for (const Target& target : stage.loading.targets) largest = std::max(largest, target.wanted);
  return largest;
}

/// Where the stage would have ended before: "" where nothing of it can.
std::string earlier_end(const Simulation& simulation) {
  const Stage& stage = simulation.stage();
  const State& state = simulation.state();
  if (stage.drive->axial_strain) {
    const double strain = simulation.observe().axial_strain;
    return strain > 0.0 ? "lower axial_strain to " + rounded_down(strain) : "";
  }
  if (stage.drive->duration)
    return state.stage_cycle > 1 ? "lower duration to " + std::to_string(state.stage_cycle - 1)
                                 : "";
  if (!stage.growth || state.increments == 0) return "";
  const Scene& scene = simulation.scene();
  const Shape start = scene.shape_in(0, state.stage, 0);
  const Shape now = scene.shape_in(0, state.stage, state.increments);
  std::vector<std::string> keys;
  const auto end_at = [&](const char* key, double least, double first, double reached,
                          double last) {
    const std::string name = std::string(key) + " to ";
    if (last > first) keys.push_back("lower " + name + rounded_down_from(least, reached));
    if (last < first) keys.push_back("raise " + name + rounded_up(reached));
  };
  if (const Growth& growth = *stage.growth; growth.by_eccentricity)
    end_at("eccentricity", 0.0, eccentricity_of(start.elongation), eccentricity_of(now.elongation),
           eccentricity_of(growth.elongation));
  else
    end_at("elongation", 1.0, start.elongation, now.elongation, growth.elongation);
  end_at("flatness", 1.0, start.flatness, now.flatness,
         stage.growth->flatness.value_or(start.flatness));
  return joined(keys, " and ");
}

}  // namespace

std::vector<Change> slower_strains(const Drive& stage, double share, int dimensions) {
  if (const auto& number = stage.inertial_number)
    return {{"inertial_number", tables::to_text(*number), rounded_down(share * *number)}};
  std::vector<Change> changes;
  const Mat3 rate = -stage.loading.strain_rate;
  const int axial = dimensions - 1;
  const auto add = [&](const char* key, const Vec3& v) {
    const auto text = [](double x) { return tables::rounded_text(x, 3); };
    if (!v.isZero(0.0))
      changes.push_back({key, "[ " + text(v[0]) + ", " + text(v[1]) + ", " + text(v[2]) + " ]",
                         rounded_down(Vec3(share * v))});
  };
  if (stage.axial_strain)
    return {{"axial_strain_rate", tables::rounded_text(rate(axial, axial), 3),
             rounded_down(share * rate(axial, axial))}};
  const bool turns = rate != rate.transpose();  // as a simple shear alone does
  add("strain_rate", rate.diagonal());
  add(turns ? "simple_shear_rate" : "shear_rate", {rate(0, 1), rate(1, 2), rate(0, 2)});
  return changes;
}

std::string advice_on_gravity(const Simulation& simulation, const Observation& seen, double share) {
  const Scene& scene = simulation.scene();
  const Particles& particles = simulation.state().particles;
  std::string unborne, walls;
  Vec3 along = scene.gravity;
  for (std::size_t k = 0; k < 3; ++k) {
    if (scene.walled[k]) along[static_cast<int>(k)] = 0.0;
    const bool pulls = along[static_cast<int>(k)] != 0.0;
    if (pulls) unborne += "xyz"[k];
    if (pulls || scene.walled[k]) walls += "xyz"[k];
  }
  double mass = 0.0;
  for (const double one : particles.mass) mass += one;
  const double weight = mass / static_cast<double>(particles.size()) * along.norm();
  if (unborne.empty() || weight < share * seen.balance.mean_contact_force) return "";
  return "gravity along " + unborne + " acts where no wall bears it; set cell.walls to \"" + walls +
         "\", or motion.gravity to 0 along " + unborne;
}

std::string advice_on_motion(const Simulation& simulation, const Observation& seen, double sound) {
  const Drive& stage = *simulation.stage().drive;
  const double fraction = seen.balance.inertial_fraction;
  const std::string gravity = advice_on_gravity(simulation, seen, 0.5 * fraction);
  if (!gravity.empty()) return gravity;
  // What ends in balance was asked for no more of it: the mean is at most the largest.
  const std::string loose = "it is not in balance yet; lower ";
  if (simulation.stage().growth) return loose + "max_inertial_fraction to " + rounded_down(sound);
  if (stage.max_unbalanced_ratio) return loose + "max_unbalanced_ratio to " + rounded_down(sound);
  const auto keys = slower_rates(stage, sound / fraction, simulation.scene().dimensions);
  if (!keys.empty())
    return "the motion is too fast for its stresses to be static ones; lower " +
           joined(keys, " and ");
  // Velocities decay by damping times the step a cycle, contacts that swing at half that rate.
  // Stages without a rate of damping await balance, and have been spoken of.
  const double a_cycle = 0.5 * stage.damping.value_or(0.0) * stage.time_step_factor;
  if (!(a_cycle > 0.0)) return "";
  const double more = std::log(fraction / sound) / a_cycle;
  return "particles still move though nothing strains them; raise duration to " +
         whole_up(static_cast<double>(stage.duration.value_or(0)) + std::max(more, 1.0));
}

std::optional<double> gain_of_flow(const Scene& scene, const Drive& stage) {
  const double stress = largest_target(stage);
  if (stress == 0.0) return std::nullopt;
  const Mat3& given = stage.loading.strain_rate;
  const Mat3 across = given - Mat3(given.diagonal().asDiagonal());
  const bool flows = across.cwiseAbs().maxCoeff() * scene.inertial_time(stress) > kFlow;
  return flows ? std::optional(kGainOfFlow) : std::nullopt;
}

std::optional<double> gain_of_dampers(const Simulation& simulation, const Drive& stage) {
  // Without a rate of damping contacts have no dampers meanwhile.
  const Servo& servo = stage.loading.servo;
  if (stage.loading.targets.empty() || !stage.damping || servo.published_gain > 0.0)
    return std::nullopt;
  double ratio = 0.0;
  for (const ContactLaw& law : simulation.scene().laws.law)
    ratio = std::max(ratio, law.damping_ratio);
  const std::vector<double>& mass = simulation.state().particles.mass;
  const auto [least, most] = std::minmax_element(mass.begin(), mass.end());
  const double answer = 1.0 + 2.0 * ratio * std::sqrt(*most / *least) / stage.time_step_factor;
  if (ratio == 0.0 || servo.gain * answer <= kRings) return std::nullopt;
  return std::stod(tables::rounded_text(kQuiet / answer, 1));
}

std::string advice_on_servo(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  const Drive& stage = *simulation.stage().drive;
  const Servo& servo = stage.loading.servo;
  const double fast = scene.servo_strain_rate(largest_target(stage));
  const auto changed = [](const char* key, double from, double to) {
    return std::string(to > from ? "raise " : "lower ") + key + " from " +
           tables::rounded_text(from, 3) + " to " + tables::rounded_text(to, 3);
  };
  if (servo.max_strain_rate < 0.5 * fast)
    return changed("max_strain_rate", servo.max_strain_rate, fast);
  if (servo.published_gain > 0.0) return "leave published_gain out, whose servo rings";
  if (const auto quiet = gain_of_dampers(simulation, stage))
    return changed("servo_gain", servo.gain, *quiet);
  const std::optional<double> of_flow = gain_of_flow(scene, stage);
  const double gain = of_flow.value_or(Servo().gain);
  if (servo.gain < 0.5 * gain || (of_flow && servo.gain > 2.0 * gain))
    return changed("servo_gain", servo.gain, gain);
  const auto keys = texts_of(slower_strains(stage, 0.5, scene.dimensions));
  if (!keys.empty()) return "lower " + joined(keys, " and ");
  return "raise duration to " + whole_up(2.0 * static_cast<double>(stage.duration.value_or(0)));
}

std::string advice_on_step(const Simulation& simulation, double share) {
  return "lower time_step_factor to " +
         rounded_down(share * simulation.stage().drive->time_step_factor);
}

std::string advice_on_stiffness(const Simulation& simulation, double times) {
  const std::vector<ContactLaw>& laws = simulation.scene().laws.law;
  const ContactLaw& first = laws.front();
  const bool hertz = first.hertz.has_value();
  const auto value = [](const ContactLaw& law) {
    return law.hertz ? law.hertz->young_modulus : law.normal_stiffness;
  };
  const auto like_first = [&](const ContactLaw& law) {
    return law.hertz.has_value() == hertz && value(law) == value(first);
  };
  // Measured: overlaps fall with the power 0.5 to 0.6 of the stiffness, linear or Hertz, since a
  // packing that overlaps less has fewer contacts.
  const double factor = times * times;
  const std::string key = hertz ? "young_modulus" : "normal_stiffness";
  if (std::all_of(laws.begin(), laws.end(), like_first))
    return "raise " + key + " to " + rounded_up(factor * value(first));
  std::vector<std::string> keys;
  for (const bool of_hertz : {false, true})
    if (std::any_of(laws.begin(), laws.end(),
                    [&](const ContactLaw& law) { return law.hertz.has_value() == of_hertz; }))
      keys.push_back(of_hertz ? "young_modulus" : "normal_stiffness");
  return "raise every " + joined(keys, " and every ") + " " + rounded_up(factor) + "-fold";
}

std::string advice_on_thickness(const Simulation& simulation, const ThinPlace& place) {
  const Scene& scene = simulation.scene();
  const Drive& stage = *simulation.stage().drive;
  std::vector<std::string> ways;
  if (const std::string end = earlier_end(simulation); !end.empty()) ways.push_back(end);
  const int dimensions = scene.dimensions;
  const double filled = times_to_fill(simulation, place.least);
  if (stage.axial_strain) {
    const double left = *stage.axial_strain - simulation.observe().axial_strain;
    ways.push_back(
        advice_on_count(scene, std::pow(place.least / place.length * std::exp(left), dimensions)));
  } else if (!stage.duration && filled > 1.0) {
    ways.push_back(advice_on_count(scene, filled));
  } else if (!stage.duration && scene.cell_size) {
    const double edge = std::pow(scene.cell_size->head(dimensions).prod(), 1.0 / dimensions);
    ways.push_back("set cell.size to " + rounded_down({edge, edge, dimensions == 3 ? edge : 1.0}));
  }
  if (ways.empty()) ways.push_back(advice_on_count(scene, 2.0));
  return joined(ways, ", or ");
}

std::string advice_on_cycles(const Simulation& simulation, double more) {
  return "raise max_cycles to " +
         whole_up(static_cast<double>(simulation.state().stage_cycle) + more);
}

}  // namespace tangency::inline v0::dem
