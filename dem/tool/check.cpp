// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/check.hpp>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/tool/safe_text.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

/// Up to it the peak of friction does not depend on the rate, at three times it is some 2.5 degrees
/// too large; and held stresses are held: measured (docs/choosing.md, docs/simulator.md).
constexpr double kQuasiStatic = 1e-3;

/// Of the bound of a servo whose stage ends at its stress, in balance or not: at ten times what a
/// servo has by default the stress is that of impacts. Chosen.
constexpr double kFastCompression = 0.1;

/// In mean radii: what is advised in place of more than kSoundOverlap. Chosen: a little below it.
constexpr double kAdvisedOverlap = 0.09;

/// Of a stage without damping, with a restitution: at its step a head-on impact is up to 0.016 off,
/// and more beyond it; at the advised one 1e-3 (docs/derivations/restitution.md).
constexpr double kStepOfImpacts = 0.2, kAdvisedStepOfImpacts = 0.04;

/// How far a Hertz contact may go beyond `largest_overlap`: its step goes with the fourth root, and
/// is then a fifth longer than allowed. Chosen.
constexpr double kBeyondLargestOverlap = 2.0;

/// Share of the machine's memory that a run may take. Chosen: the rest is of others.
constexpr double kShareOfMemory = 0.8;

/// The largest value that the key largest_overlap takes (dem/scene/scene_keys.cpp).
constexpr double kMostLargestOverlap = 0.2;

/// In mean radii: with less than the first a stage whose cycles are too many has contacts that are
/// stiffer than its stresses can tell, and the second is advised. Measured: below 0.01 nothing but
/// the number of cycles changes (docs/choosing.md).
constexpr double kStiffOverlap = 1e-3, kSoftEnough = 5e-3;

/// What a stage needs at least is not what it needs.
constexpr double kSpareCycles = 1.2;

std::string short_text(double x) { return tables::rounded_text(x, 3); }

double memory_of_machine() {
  return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<double>(::sysconf(_SC_PAGESIZE));
}

class Checker {
 public:
  explicit Checker(const Simulation& simulation)
      : simulation_(simulation), scene_(simulation.scene()) {}

  SceneCheck check() {
    seen_.memory = memory_of(scene_.particle_count());
    seen_.stages = forecast(simulation_);
    check_memory();
    check_gravity();
    check_impacts();
    for (const StageForecast& stage : seen_.stages) {
      check_stress(stage);
      check_cell(stage);
      check_rates(stage);
      check_gain(stage);
      check_step(stage);
    }
    return std::move(seen_);
  }

 private:
  const Stage& stage_of(const StageForecast& seen) const { return scene_.stages[seen.stage]; }

  /// @param stage  null for the whole scene
  void add(const Stage* stage, const std::string& about, const std::string& reason,
           std::vector<Change> changes) {
    if (scene_.intends(stage ? *stage : scene_.stages.front(), about)) return;
    seen_.advice.push_back({stage ? stage->name : "", about, reason, std::move(changes)});
  }

  /// Of what holds for the whole scene, once.
  bool has(const std::string& about) const {
    return std::any_of(seen_.advice.begin(), seen_.advice.end(),
                       [&](const Advice& one) { return one.about == about; });
  }

  std::vector<Change> counts_times(double times, std::string (*round)(double)) const {
    std::vector<Change> changes;
    for (const auto& [name, batch] : scene_.particle_types)
      changes.push_back({"particles." + name + ".count", std::to_string(batch.count),
                         round(times * static_cast<double>(batch.count))});
    return changes;
  }

  void check_memory() {
    const double most = kShareOfMemory * memory_of_machine();
    if (seen_.memory <= most) return;
    const auto down = [](double x) {
      return tables::rounded_text(std::round(two_digits(x, std::floor)), 17);
    };
    add(nullptr, "memory",
        "some " + short_text(1e-9 * seen_.memory) + " GB, and this machine has " +
            short_text(1e-9 * memory_of_machine()),
        counts_times(most / seen_.memory, down));
  }

  void check_gravity() {
    if (advice_on_gravity(simulation_, simulation_.observe(), 0.0).empty()) return;
    Vec3 borne = scene_.gravity;
    std::string axes;
    for (int k = 0; k < 3; ++k)
      if (borne[k] != 0.0 && !scene_.walled[static_cast<std::size_t>(k)]) {
        borne[k] = 0.0;
        axes += "xyz"[k];
      }
    const auto text = [](const Vec3& v) {
      return "[ " + short_text(v[0]) + ", " + short_text(v[1]) + ", " + short_text(v[2]) + " ]";
    };
    add(nullptr, "gravity",
        "gravity along " + axes + " acts where cell.walls has no wall to bear it",
        {{"motion.gravity", text(scene_.gravity), text(borne)}});
  }

  /// Of bodies that have a velocity at the start.
  void check_impacts() {
    double fastest = 0.0;
    for (const Vec3& velocity : simulation_.state().particles.velocity)
      fastest = std::max(fastest, velocity.norm());
    if (fastest == 0.0 || simulation_.state().cycle > 0) return;
    for (std::size_t type = 0; type < scene_.particle_types.size(); ++type) {
      const double overlap = overlap_of_impact(scene_, type, 2.0 * fastest);
      const std::string reason = "bodies that meet at twice the largest speed, " +
                                 short_text(fastest) + ", overlap by " + short_text(overlap) +
                                 " of their mean radius";
      if (overlap > kSoundOverlap && !scene_.intends(scene_.stages.front(), "impact")) {
        const bool hertz = law_of(type).hertz.has_value();
        const double power = hertz ? 2.5 : 2.0;
        add(nullptr, "impact", reason + ", more than " + short_text(kSoundOverlap),
            {stiffer(type, std::pow(overlap / kAdvisedOverlap, power))});
      } else {
        check_largest_overlap(nullptr, type, overlap, reason);
      }
    }
  }

  const ContactLaw& law_of(std::size_t type) const {
    return scene_.laws.law[type * scene_.laws.types + type];
  }

  /// The table that a type's own law stands in: [contact] where all types have one law.
  std::string table_of_law(std::size_t type) const {
    const std::string& name = scene_.particle_types[type].name;
    return scene_.particle_types.size() == 1 ? "contact" : "contact." + name + "-" + name;
  }

  Change stiffer(std::size_t type, double times) const {
    const ContactLaw& law = law_of(type);
    const double now = law.hertz ? law.hertz->young_modulus : law.normal_stiffness;
    return {table_of_law(type) + (law.hertz ? ".young_modulus" : ".normal_stiffness"),
            tables::to_text(now), rounded_up(times * now)};
  }

  /// The key's value, of which the law has the stiffness where two of the type are flattest: it
  /// grows with the root of the overlap.
  double largest_overlap_of(std::size_t type) const {
    const ContactLaw& law = law_of(type);
    const Shape& shape = scene_.particle_types[type].batch.shape;
    const Vec3 axes = shape.semi_axes(scene_.dimensions);
    const double curvature[2] = {2.0 * axes[2] / (axes[1] * axes[1]),
                                 2.0 * axes[2] / (axes[0] * axes[0])};
    const double one = 0.01;
    const HertzContact at_one = hertz_contact(curvature, one * shape.mean_radius, *law.hertz);
    return one * std::pow(law.normal_stiffness / at_one.stiffness, 2.0);
  }

  void check_largest_overlap(const Stage* stage, std::size_t type, double overlap,
                             const std::string& reason) {
    const ContactLaw& law = law_of(type);
    if (!law.hertz || has("largest_overlap")) return;
    const double least = largest_overlap_of(type);
    const double advised = std::min(kMostLargestOverlap, overlap);
    if (overlap <= kBeyondLargestOverlap * least || advised <= 1.01 * least) return;
    add(stage, "largest_overlap", reason + ", and time steps are right up to " + short_text(least),
        {{table_of_law(type) + ".largest_overlap", short_text(least), rounded_up(advised)}});
  }

  void check_stress(const StageForecast& seen) {
    const Stage& stage = stage_of(seen);
    if (!seen.overlap) return;
    const std::string reason = "under a stress of " + short_text(seen.pressed->stress) +
                               " the mean overlap will be some " + short_text(*seen.overlap) +
                               " of the mean radius";
    if (*seen.overlap <= kSoundOverlap || scene_.intends(stage, "overlap"))
      return check_largest_overlap(&stage, seen.softest, *seen.overlap, reason);
    const Change change =
        stiffer(seen.softest, stiffer_by(scene_, seen.softest, *seen.pressed, kAdvisedOverlap));
    const auto is_it = [&](const Advice& one) {
      return one.about == "overlap" && one.changes.front().key == change.key;
    };
    const auto earlier = std::find_if(seen_.advice.begin(), seen_.advice.end(), is_it);
    if (earlier == seen_.advice.end())
      return add(&stage, "overlap", reason + ", more than " + short_text(kSoundOverlap), {change});
    if (std::stod(change.to) > std::stod(earlier->changes.front().to))
      *earlier = {
          stage.name, "overlap", reason + ", more than " + short_text(kSoundOverlap), {change}};
  }

  void check_cell(const StageForecast& seen) {
    if (!seen.cell_over_least || *seen.cell_over_least >= 1.0 || has("cell")) return;
    const double times = std::pow(1.1 / *seen.cell_over_least, scene_.dimensions);
    add(&stage_of(seen), "cell",
        "at its end the cell will have some " + short_text(*seen.cell_over_least) +
            " of the period that its particles need, and the run will end",
        counts_times(times, whole_up));
  }

  /// Rates, and the cycles that they leave.
  void check_rates(const StageForecast& seen) {
    const Stage& stage = stage_of(seen);
    const Drive& drive = *stage.drive;
    double longer = 1.0;
    const auto above = [&](const std::optional<double>& number, double sound, const char* about) {
      return number && *number > sound && !scene_.intends(stage, about);
    };
    if (above(seen.inertial_number, kQuasiStatic, "inertial_number")) {
      const double share = kQuasiStatic / *seen.inertial_number;
      std::vector<Change> changes = at(seen, slower_strains(drive, share, scene_.dimensions));
      longer = 1.1 / share;
      if (drive.duration)
        changes.push_back({path_of(scene_, seen.stage, "duration"), std::to_string(*drive.duration),
                           whole_up(static_cast<double>(*drive.duration) / share)});
      add(&stage, "inertial_number",
          "an inertial number of " + short_text(*seen.inertial_number) + " is above " +
              short_text(kQuasiStatic) + ": stresses depend on the rate",
          std::move(changes));
    } else if (drive.stress_tolerance && !drive.max_unbalanced_ratio && !stage.growth &&
               above(seen.servo_inertial_number, kFastCompression, "servo_inertial_number")) {
      const double share = kFastCompression / *seen.servo_inertial_number;
      const double rate = drive.loading.servo.max_strain_rate;
      longer = 1.1 / share;
      add(&stage, "servo_inertial_number",
          "its servo may strain at an inertial number of " +
              short_text(*seen.servo_inertial_number) + ", above " + short_text(kFastCompression) +
              ": the stress at its end is that of impacts",
          {{path_of(scene_, seen.stage, "max_strain_rate"), tables::to_text(rate),
            rounded_down(share * rate)}});
    }
    check_cycles(seen, longer);
  }

  /// @param longer  so many times as long as it is, by advice on its rate
  void check_cycles(const StageForecast& seen, double longer) {
    const Stage& stage = stage_of(seen);
    const std::int64_t most = stage.drive->max_cycles;
    double needed = seen.least.cycles * longer;
    if (needed <= static_cast<double>(most)) return;
    std::string reason = "it needs at least " + tables::formatted("%.0f", needed) +
                         " cycles for its " + seen.least.key +
                         (longer > 1.0 ? " at the slower rate" : "") + ", more than max_cycles";
    std::vector<Change> changes;
    if (seen.overlap && *seen.overlap < kStiffOverlap && scene_.particle_types.size() == 1) {
      const double softer = stiffer_by(scene_, 0, *seen.pressed, kSoftEnough);
      reason +=
          "; its contacts are stiffer than they have to be, which takes most of them: a mean "
          "overlap of " +
          short_text(*seen.overlap) + " of the mean radius";
      changes.push_back(stiffer(0, softer));
      needed *= std::sqrt(softer);  // as the inverse of the step
    }
    if (kSpareCycles * needed > static_cast<double>(most))
      changes.push_back({path_of(scene_, seen.stage, "max_cycles"), std::to_string(most),
                         whole_up(kSpareCycles * needed)});
    add(&stage, "cycles", reason, std::move(changes));
  }

  std::vector<Change> at(const StageForecast& seen, std::vector<Change> changes) const {
    for (Change& one : changes) one.key = path_of(scene_, seen.stage, one.key);
    return changes;
  }

  /// Of dampers, and of a flow that is meant: of one that is not a slower rate is advised.
  void check_gain(const StageForecast& seen) {
    const Stage& stage = stage_of(seen);
    const Servo& servo = stage.drive->loading.servo;
    const auto advise = [&](double gain, const std::string& reason) {
      add(&stage, "servo_gain", reason,
          {{path_of(scene_, seen.stage, "servo_gain"), tables::to_text(servo.gain),
            tables::to_text(gain)}});
    };
    if (const auto quiet = gain_of_dampers(simulation_, *stage.drive))
      return advise(*quiet,
                    "its servo would ring against the dampers of its contacts "
                    "(restitution), and not hold its stress");
    const auto gain = gain_of_flow(scene_, *stage.drive);
    if (!gain || servo.gain <= 2.0 * *gain || !scene_.intends(stage, "inertial_number")) return;
    advise(*gain, "its servo would throw a flow about, and hold no stress");
  }

  void check_step(const StageForecast& seen) {
    const Drive& drive = *stage_of(seen).drive;
    const auto& laws = scene_.laws.law;
    const bool dissipates = std::any_of(laws.begin(), laws.end(),
                                        [](const ContactLaw& law) { return law.dissipates(); });
    if (!dissipates || drive.damping != 0.0 || drive.time_step_factor <= kStepOfImpacts) return;
    add(&stage_of(seen), "time_step",
        "an impact lasts " + short_text(seen.steps_a_contact) +
            " time steps, too few for its restitution",
        {{path_of(scene_, seen.stage, "time_step_factor"), short_text(drive.time_step_factor),
          short_text(kAdvisedStepOfImpacts)}});
  }

  const Simulation& simulation_;
  const Scene& scene_;
  SceneCheck seen_;
};

}  // namespace

std::string Advice::text() const {
  std::string line = (stage.empty() ? "" : "stage " + stage + ": ") + reason;
  for (const Change& one : changes)
    line += (&one == &changes.front() ? "; set " : " and ") + one.key + " from " + one.from +
            " to " + one.to;
  return line;
}

SceneCheck check_of(const Simulation& simulation) { return Checker(simulation).check(); }

std::string path_of(const Scene& scene, std::size_t stage, const std::string& key) {
  const std::string& name = scene.stages[stage].name;
  const auto namesakes = std::count_if(scene.stages.begin(), scene.stages.end(),
                                       [&](const Stage& one) { return one.name == name; });
  return (namesakes == 1 ? "stage." + name : "stage[" + std::to_string(stage) + "]") + "." + key;
}

}  // namespace tangency::inline v0::dem
