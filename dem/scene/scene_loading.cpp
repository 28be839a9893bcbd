// SPDX-License-Identifier: MIT
#include <tangency/dem/scene/scene_loading.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

/// Chosen: a cell that shrinks by more in a step has left every contact of the step before.
constexpr double kMostStrainOfAStep = 0.1;

/// Relative error that products of decimal fractions bring in, generously.
constexpr double kRounding = 1e-9;

constexpr const char* kStressKeys[] = {"stress_xx", "stress_yy", "stress_zz"};

/// b of s_yy - s_xx = b (s_zz - s_xx), where it is to be held.
std::optional<double> read_intermediate_ratio(const Section& section, const Scene& scene) {
  const auto ratio = section.optional_real("intermediate_ratio");
  if (ratio && scene.dimensions == 2)
    section.fail("intermediate_ratio", "with dimensions = 3 alone");
  return ratio;
}

/// Axial compression, sideways as much extension as keeps the volume, and what is held.
void read_shear(const Section& section, const Scene& scene, Drive& drive) {
  const int lateral = scene.dimensions - 1;  // axes before the axial one
  if (section.has("inertial_number"))
    section.forbid("axial_strain_rate", "not together with inertial_number");
  else if (!section.has("axial_strain_rate"))
    section.fail_missing("axial_strain_rate");
  const double rate = section.optional_real("axial_strain_rate").value_or(1.0);
  const auto ratio = read_intermediate_ratio(section, scene);
  if (ratio && !section.has("mean_stress"))
    section.fail("intermediate_ratio", "with mean_stress alone");
  for (int axis = 0; axis < lateral; ++axis) drive.loading.strain_rate(axis, axis) = rate / lateral;
  drive.loading.strain_rate(lateral, lateral) = -rate;
  if (ratio) {
    // In proportion to the deviator of the stress, so that the servo has little left to do.
    drive.loading.strain_rate(0, 0) = rate * (1.0 + *ratio) / (2.0 - *ratio);
    drive.loading.strain_rate(1, 1) = rate * (1.0 - 2.0 * *ratio) / (2.0 - *ratio);
  }
  drive.axial_strain = section.real("axial_strain");
  if (const auto mean = section.optional_real("mean_stress")) {
    section.forbid("lateral_stress", "not together with mean_stress");
    drive.loading.targets = {Target::mean_stress(*mean, scene.dimensions)};
    if (ratio) drive.loading.targets.push_back(Target::intermediate_ratio(*ratio));
  } else if (const auto stress = section.optional_real("lateral_stress")) {
    for (int axis = 0; axis < lateral; ++axis)
      drive.loading.targets.push_back(Target::component(axis, *stress));
  }
}

void read_servo(const Section& section, const Scene& scene, Drive& drive) {
  Loading& loading = drive.loading;
  const bool plane = scene.dimensions == 2;
  drive.duration = section.integer("duration");
  const Vec3 strain = section.optional_real3("strain_rate").value_or(Vec3::Zero());
  const Vec3 shear = section.optional_real3("shear_rate").value_or(Vec3::Zero());
  if (plane && strain[2] != 0.0) section.fail("strain_rate", "with dimensions = 2 none along z");
  if (plane && (shear[1] != 0.0 || shear[2] != 0.0))
    section.fail("shear_rate", "with dimensions = 2 of xy alone");
  Mat3 rate = strain.asDiagonal();
  for (int k = 0; k < 3; ++k) rate(k, (k + 1) % 3) = rate((k + 1) % 3, k) = shear[k];
  if (const auto simple = section.optional_real3("simple_shear_rate")) {
    if (plane && simple->tail<2>() != Vec2::Zero())
      section.fail("simple_shear_rate", "with dimensions = 2 of xy alone");
    for (const char* key : {"shear_rate", "major_direction"})
      section.forbid(key, "not together with simple_shear_rate");
    rate(0, 1) = (*simple)[0];
    rate(1, 2) = (*simple)[1];
    rate(0, 2) = (*simple)[2];
  }
  loading.strain_rate = -rate;
  if (scene.has_walls())
    for (const char* key : {"shear_rate", "simple_shear_rate", "major_direction"})
      section.forbid(key, "not in a cell with walls");
  if (plane)
    for (const char* key : {"stress_zz", "plane_mean_stress"})
      section.forbid(key, "with dimensions = 3 alone");
  for (int axis = 0; axis < 3; ++axis)
    if (const auto stress = section.optional_real(kStressKeys[axis]))
      loading.targets.push_back(Target::component(axis, *stress));
  if (const auto mean = section.optional_real("mean_stress"))
    loading.targets.push_back(Target::mean_stress(*mean, scene.dimensions));
  if (const auto mean = section.optional_real("plane_mean_stress"))
    loading.targets.push_back(Target::plane_mean_stress(*mean));
  if (const auto angle = section.optional_real("major_direction"))
    loading.targets.push_back(
        Target::direction(plane ? 1 : 2, 0, *angle * std::numbers::pi / 180.0));
  if (!loading.is_independent())
    for (const char* key : {"plane_mean_stress", "mean_stress"})
      section.forbid(key, "not together with stresses that it is the mean of");
  const auto ratio = read_intermediate_ratio(section, scene);
  if (!ratio) return;
  section.forbid("major_direction", "not together with intermediate_ratio");
  loading.targets.push_back(Target::intermediate_ratio(*ratio));
  if (!loading.is_independent())
    section.fail("intermediate_ratio", "not together with stresses that it follows from");
}

/// Scales the given rates to an inertial number, where the scene gives one.
void read_inertial_number(const Section& section, const Scene& scene, Drive& drive) {
  drive.inertial_number = section.optional_real("inertial_number");
  if (!drive.inertial_number) return;
  const double most = drive.loading.strain_rate.cwiseAbs().maxCoeff();
  if (most == 0.0) section.fail("inertial_number", "with a rate that is not 0");
  double stress = scene.held_stress(Stage{"", {}, drive, {}});
  for (auto before = scene.stages.rbegin(); before != scene.stages.rend() && stress == 0.0;
       ++before)
    if (before->drive) stress = scene.held_stress(*before);
  if (stress == 0.0)
    section.fail("inertial_number", "with a stress that this stage or one before it holds");
  drive.loading.strain_rate /= most;  // first: a product may have no place
  drive.loading.strain_rate *= *drive.inertial_number / scene.inertial_time(stress);
}

/// One stress to come to: its mean, or each normal component. Of a relax without it: none.
void read_pressed(const Section& section, const std::string& kind, const Scene& scene,
                  Drive& drive) {
  if (kind == "relax" && !section.has("mean_stress")) {
    for (const char* key :
         {"hold", "stress_tolerance", "max_strain_rate", "servo_gain", "published_gain"})
      section.forbid(key, "with mean_stress alone");
    return;
  }
  const double stress = section.real("mean_stress");
  drive.stress_tolerance = section.real("stress_tolerance");
  const bool may_choose = kind == "compress" || kind == "relax";
  if (!may_choose || section.text("hold") == "mean") {
    drive.loading.targets = {Target::mean_stress(stress, scene.dimensions)};
    return;
  }
  for (int axis = 0; axis < scene.dimensions; ++axis)
    drive.loading.targets.push_back(Target::component(axis, stress));
}

/// A bound within which a shear's servo holds its stress: that of the stress, and at least the rate
/// of the shear itself. Without a stress to hold it does not matter.
double shear_servo_rate(const Scene& scene, const Loading& loading) {
  const double shear = loading.strain_rate.cwiseAbs().maxCoeff();
  if (loading.targets.empty()) return shear;
  return std::max(shear, scene.servo_strain_rate(loading.targets.front().wanted));
}

/// The ramp of one of three keys, where there is something to change on it. With a duration, or an
/// axial strain that it goes by, the ramp ends within.
void read_ramp(const Section& section, const Scene& scene, Drive& drive) {
  const double dt = drive.time_step_factor * scene.characteristic_time();
  const double rate = drive.loading.strain_rate.cwiseAbs().maxCoeff();
  constexpr double kNoEnd = std::numeric_limits<double>::infinity();
  const double cycles = drive.duration ? static_cast<double>(*drive.duration) : kNoEnd;
  const struct {
    const char* key;
    Ramp::Over over;
    double most;
  } ways[] = {{"ramp_cycles", Ramp::Over::cycles, cycles},
              {"ramp_time", Ramp::Over::time, cycles * dt},
              {"ramp_strain", Ramp::Over::strain, drive.axial_strain.value_or(cycles * dt * rate)}};
  for (const auto& [key, over, most] : ways) {
    if (!section.has(key)) continue;
    if (drive.ramp) section.fail(key, "one of ramp_cycles, ramp_time and ramp_strain");
    if (drive.loading.targets.empty() && !section.has("friction_coefficient"))
      section.fail(key, "with a stress to hold or a friction_coefficient alone");
    if (over == Ramp::Over::strain && rate == 0.0) section.fail(key, "with a rate of strain alone");
    const double length =
        over == Ramp::Over::cycles ? static_cast<double>(section.integer(key)) : section.real(key);
    if (length > most * (1.0 + kRounding))
      section.fail(key, "at most " + tables::to_text(most) + ", where the stage ends");
    drive.ramp = {over, length};
  }
}

/// @throws SceneError  where a step damps so much that it turns velocities round
void check_damping(const Section& section, const Drive& stage) {
  const auto check = [&](const char* key, const std::optional<double>& damping) {
    if (damping && *damping * stage.time_step_factor > 2.0)
      section.fail(key, "with time_step_factor = " + short_text(stage.time_step_factor) +
                            " a finite number <= " + short_text(2.0 / stage.time_step_factor) +
                            ": a step that damps more would turn velocities round");
  };
  check("damping", stage.damping);
  check("rotational_damping", stage.rotational_damping);
}

void check_step(const Section& section, const Drive& stage, const Scene& scene) {
  const double largest =
      kMostStrainOfAStep / (stage.time_step_factor * scene.characteristic_time());
  const double fastest = stage.loading.strain_rate.cwiseAbs().maxCoeff();
  const auto refuse = [&](const char* key) {
    // With an intermediate_ratio a lateral axis may strain faster than the axial one.
    const bool axial = std::string_view(key) == "axial_strain_rate";
    const bool scaled = std::string_view(key) == "inertial_number";
    const double most = axial || scaled ? largest * section.real(key) / fastest : largest;
    section.fail(key, "a finite number < " + short_text(most) +
                          (scaled ? ", a strain of " : " (1/s), a strain of ") +
                          short_text(kMostStrainOfAStep) + " a time step");
  };
  const Servo& servo = stage.loading.servo;
  if (!(servo.max_strain_rate < largest))
    refuse(section.has("max_strain_rate")   ? "max_strain_rate"
           : section.has("inertial_number") ? "inertial_number"
                                            : "axial_strain_rate");
  if (!(fastest < largest))
    for (const char* key :
         {"inertial_number", "axial_strain_rate", "strain_rate", "shear_rate", "simple_shear_rate"})
      if (section.has(key)) refuse(key);
}

}  // namespace

Drive read_drive(const Section& section, const std::string& kind, const Scene& scene) {
  Drive drive{};
  Loading& loading = drive.loading;
  if (kind == "servo")
    read_servo(section, scene, drive);
  else if (kind == "shear")
    read_shear(section, scene, drive);
  else
    read_pressed(section, kind, scene, drive);
  if (kind == "servo" || kind == "shear") read_inertial_number(section, scene, drive);
  if (section.has("max_strain_rate"))
    loading.servo.max_strain_rate = section.real("max_strain_rate");
  else if (kind == "shear")
    loading.servo.max_strain_rate = shear_servo_rate(scene, loading);
  else if (!loading.targets.empty())
    section.fail_missing("max_strain_rate");
  loading.servo.gain = section.real("servo_gain");
  loading.servo.published_gain = section.optional_real("published_gain").value_or(0.0);
  if (!scene.planes.empty() && (!loading.targets.empty() || !loading.strain_rate.isZero(0.0)))
    section.fail("kind",
                 "with [[wall]] a servo without rates and stresses, or a relax without "
                 "mean_stress: these walls do not strain with the cell");
  const bool comes_to_rest = kind == "relax" || kind == "unload";
  loading.servo.integral = !comes_to_rest;
  if (!comes_to_rest || section.has("damping")) drive.damping = section.real("damping");
  drive.rotational_damping = section.optional_real("rotational_damping");
  if (!drive.damping) section.forbid("rotational_damping", "where damping is a number alone");
  drive.time_step_factor = section.real("time_step_factor");
  drive.friction_coefficient = kind == "grow" || kind == "unload"
                                   ? std::optional(section.real("friction_coefficient"))
                                   : section.optional_real("friction_coefficient");
  if (kind != "grow") read_ramp(section, scene, drive);
  if (comes_to_rest) drive.max_unbalanced_ratio = section.real("max_unbalanced_ratio");
  drive.max_cycles = section.integer("max_cycles");
  check_damping(section, drive);
  check_step(section, drive, scene);
  return drive;
}

}  // namespace tangency::inline v0::dem
