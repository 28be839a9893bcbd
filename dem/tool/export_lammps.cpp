// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/export_lammps.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include <tangency/dem/motion/motion.hpp>
#include <tangency/dem/scene/scene_error.hpp>
#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {
namespace {

using tables::to_text;

/// Skin of the neighbour list in largest semi-axes. Chosen as in docs/lammps-fixes.md, whose
/// times and halos it goes with.
constexpr double kSkin = 0.2;

/// Cycles between two looks at a criterion that asks every contact. Chosen: a look costs as much as
/// a step, and relaxing takes thousands.
constexpr int kLookEvery = 10;

[[noreturn]] void refuse(const std::string& scene, const std::string& what) {
  throw SceneError(scene + ": " + what);
}

bool strains(const Loading& loading) {
  return !loading.targets.empty() || !loading.strain_rate.isZero(0.0);
}

/// @throws SceneError  naming the first thing that LAMMPS has not
void require_supported(const Scene& scene, const State& state, const std::string& name) {
  if (scene.dimensions != 3) refuse(name, "cell.dimensions = 2: 3 alone goes to LAMMPS");
  for (const PlaneWall& wall : scene.planes)
    if (wall.held) refuse(name, "wall.stress: walls that are held do not go to LAMMPS");
  if (!state.cell.edges.isUpperTriangular(0.0))
    refuse(name,
           "a cell that shear has turned: LAMMPS has cells whose first edge is along x alone");
  if (scene.branch == Branch::trace)
    refuse(name, "contact.branch = \"trace\": \"follow\" and \"global\" alone go to LAMMPS");
  for (std::size_t k = state.stage; k < scene.stages.size(); ++k) {
    const Stage& stage = scene.stages[k];
    if (scene.has_walls() && stage.drive && strains(stage.drive->loading))
      refuse(name, "cell.walls: with stages that strain the cell they do not go to LAMMPS");
    if (stage.drive && stage.drive->ramp)
      refuse(name, "stage " + stage.name +
                       ": ramps do not go to LAMMPS: run it first, and export "
                       "its end");
    if (stage.growth)
      refuse(name, "stage " + stage.name +
                       ": particles that grow do not go to LAMMPS: run it first, and export its "
                       "end");
  }
}

std::string number_of_type(std::size_t type) { return to_text(type + 1); }

std::string law_text(const ContactLaw& law) {
  std::string text;
  if (law.hertz)
    text = "hertz/material " + to_text(law.hertz->young_modulus) + " " +
           to_text(law.hertz->poisson_ratio) + " tangential mindlin " +
           to_text(law.friction_coefficient);
  else
    text = "hooke " + to_text(law.normal_stiffness) + " tangential linear " +
           to_text(law.shear_stiffness) + " " + to_text(law.friction_coefficient);
  if (law.cohesion > 0.0) text += " cohesion " + to_text(law.cohesion);
  if (law.dissipates()) text += " restitution " + to_text(law.restitution());
  return text;
}

std::string laws_text(const ContactLaws& laws, std::size_t types) {
  std::string text;
  for (std::size_t a = 0; a < types; ++a)
    for (std::size_t b = a; b < types; ++b)
      text += "pair_coeff " + number_of_type(a) + " " + number_of_type(b) + " " +
              law_text(laws.between(a, b)) + "\n";
  return text;
}

/// A wall for each face of the cell that is one, and for each of its own; a fix for each type.
std::string walls_text(const Simulation& run) {
  const Cell& cell = run.state().cell;
  std::vector<PlaneWall> walls;
  for (int axis = 0; axis < 3; ++axis) {
    if (!cell.walled[static_cast<std::size_t>(axis)]) continue;
    walls.push_back({Vec3::Unit(axis), 0.0, Vec3::Zero(), {}});
    walls.push_back({Vec3::Zero() - Vec3::Unit(axis), -cell.edges(axis, axis), Vec3::Zero(), {}});
  }
  walls.insert(walls.end(), cell.planes.begin(), cell.planes.end());
  std::string text;
  const std::size_t types = run.scene().particle_types.size();
  const auto vector_text = [](const Vec3& v) {
    return to_text(v[0]) + " " + to_text(v[1]) + " " + to_text(v[2]);
  };
  for (std::size_t type = 0; !walls.empty() && type < types; ++type) {
    const std::string number = number_of_type(type);
    text += "group of" + number + " type " + number + "\n";
    for (std::size_t k = 0; k < walls.size(); ++k) {
      const PlaneWall& wall = walls[k];
      text += "fix wall" + to_text(k) + "_" + number + " of" + number + " wall/tangency plane " +
              vector_text(wall.offset * wall.normal) + " " + vector_text(wall.normal);
      if (!wall.velocity.isZero(0.0)) text += " velocity " + vector_text(wall.velocity);
      text += " law " + law_text(run.laws().between(type, types)) + "\n";
    }
  }
  return text;
}

/// @throws SceneError  of a stage in which walls have other laws than before: their records would
/// be lost
void require_same_walls(Simulation run, const std::string& name) {
  if (run.finished() || !run.scene().has_walls()) return;
  const std::size_t types = run.scene().particle_types.size();
  const auto laws = [&] {
    std::string text;
    for (std::size_t type = 0; type < types; ++type)
      text += law_text(run.laws().between(type, types));
    return text;
  };
  for (const std::string first = laws(); !run.finished(); run.next_stage())
    if (laws() != first)
      refuse(name, "stage " + run.stage().name +
                       ": walls keep their friction and restitution in LAMMPS from stage to stage");
}

/// The keyword of fix tangency/servo that holds a target.
std::string target_text(const Target& target) {
  const Mat3& w = target.weights;
  const std::string wanted = " " + to_text(target.wanted);
  if (w == Mat3(Mat3::Identity())) return "mean" + wanted;
  if (w.isDiagonal(0.0)) {
    if (w.trace() == 0.0) return "lode " + to_text(-w(2, 2));
    if (w.trace() == 2.0) return "plane" + wanted;
    for (int axis = 0; axis < 3; ++axis)
      if (w(axis, axis) == 1.0) return std::string(1, "xyz"[axis]) + wanted;
  }
  // As Target::direction() has it from z towards x: sin(2 A) / 2 and cos(2 A) / 2.
  const double angle = 0.5 * std::atan2(w(0, 0), w(0, 2));
  return "direction " + to_text(angle * 180.0 / std::numbers::pi);
}

bool shears(const Loading& loading) {
  Mat3 sum = loading.strain_rate.cwiseAbs();
  for (const Target& target : loading.targets) sum += target.actuator.cwiseAbs();
  return !sum.isDiagonal(0.0);
}

std::string servo_text(const Loading& loading) {
  std::string text = "fix load all tangency/servo";
  constexpr const char* names[3][3] = {{"xx", "xy", "xz"}, {"", "yy", "yz"}, {"", "", "zz"}};
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      const Mat3& rate = loading.strain_rate;
      const double value = i == j ? rate(i, i) : rate(i, j) + rate(j, i);
      if (value != 0.0) text += std::string(" rate ") + names[i][j] + " " + to_text(value);
    }
  for (const Target& target : loading.targets) text += " " + target_text(target);
  if (loading.targets.empty()) return text + "\n";
  const Servo& servo = loading.servo;
  text += " max " + to_text(servo.max_strain_rate) + " gain " + to_text(servo.gain);
  if (servo.published_gain > 0.0) text += " published " + to_text(servo.published_gain);
  if (!servo.integral) text += " integral no";
  return text + "\n";
}

std::string move_text(const Scene& scene, const Drive& drive, double characteristic_time) {
  std::string text = "fix motion all tangency/move damping ";
  text += drive.damping ? to_text(*drive.damping / characteristic_time) : "fire";
  if (drive.rotational_damping)
    text += " rotational " + to_text(*drive.rotational_damping / characteristic_time);
  if (scene.rotation == Rotation::simplified) text += " rotation simplified";
  if (scene.rotation == Rotation::none) text += " rotation none";
  return text + "\n";
}

/// How a stage ends: after so many cycles, and once a formula of LAMMPS is not 0.
struct End {
  std::string formula;
  std::int64_t cycles = 0;
  bool asks_contacts = false;

  void add(const std::string& term) { formula += (formula.empty() ? "(" : " && (") + term + ")"; }
};

End end_of(const Simulation& run) {
  const Drive& drive = *run.stage().drive;
  const State& state = run.state();
  End end;
  end.cycles = drive.max_cycles - state.stage_cycle;
  const bool asks = drive.axial_strain || drive.stress_tolerance || drive.max_unbalanced_ratio;
  if (drive.duration) {
    const std::int64_t left = *drive.duration - state.stage_cycle;
    if (!asks) return {"", left, false};
    end.add("step - v_first >= " + to_text(left));
  }
  if (drive.axial_strain) {
    const double height =
        state.stage_cycle > 0 ? state.cell.reference_edges(2, 2) : 0.0;  // 0: as it is then
    end.add("-ln(lz/" + (height > 0.0 ? to_text(height) : std::string("v_height")) +
            ") >= " + to_text(*drive.axial_strain));
  }
  if (drive.stress_tolerance) {
    double largest = 0.0;
    const auto& targets = run.loading().targets;
    for (const Target& target : targets) largest = std::max(largest, std::abs(target.wanted));
    for (std::size_t k = 0; k < targets.size(); ++k)
      end.add("abs(f_load[" + to_text(7 + k) +
              "]) <= " + to_text(*drive.stress_tolerance * largest));
  }
  if (drive.max_unbalanced_ratio) {
    const std::string most = to_text(*drive.max_unbalanced_ratio);
    end.add("c_balance[4] <= " + most);
    end.add("c_balance[5] <= " + most);
    end.asks_contacts = true;
  }
  return end;
}

std::string stage_text(const Simulation& run) {
  const Drive& drive = *run.stage().drive;
  const std::size_t types = run.scene().particle_types.size();
  const double characteristic =
      characteristic_time(run.state().particles, run.laws().largest_stiffness());
  const End end = end_of(run);
  std::string text = "\n# Stage " + run.stage().name + "\n" + laws_text(run.laws(), types);
  text += "timestep " + to_text(run.time_step()) + "\n";
  if (strains(run.loading())) text += servo_text(run.loading());
  text += move_text(run.scene(), drive, characteristic);
  if (!end.formula.empty()) {
    text += "variable height equal $(lz:%.17g)\nvariable first equal $(step)\n";
    text += "variable ended equal \"" + end.formula + "\"\n";
    text += "fix end all halt " + to_text(end.asks_contacts ? kLookEvery : 1) +
            " v_ended != 0 error continue message no\n";
  }
  text += "run " + to_text(end.cycles) + "\n";
  if (!end.formula.empty())
    text += "if \"$(v_ended) == 0\" then \"print 'Stage " + run.stage().name +
            ": not at its end after max_cycles'\" \"quit 1\"\nunfix end\n";
  text += "unfix motion\n";
  if (strains(run.loading())) text += "unfix load\n";
  return text;
}

std::string output_text(const OutputIntervals& output, const std::string& name) {
  std::string text =
      "\ncompute push all pressure NULL virial\ncompute balance all tangency/balance\n"
      "thermo_style custom step time pe c_push[1] c_push[2] c_push[3] c_push[4] c_push[5] "
      "c_push[6] lx ly lz c_balance[4] c_balance[5]\nthermo_modify format float %.15g\n";
  if (output.history > 0) text += "thermo " + to_text(output.history) + "\n";
  if (output.frame > 0)
    text +=
        "compute shape all property/atom shapex shapey shapez\n"
        "compute turn all property/atom quatw quati quatj quatk\n"
        "dump bodies all custom " +
        to_text(output.frame) + " " + name +
        ".*.dump id type xu yu zu vx vy vz c_shape[1] c_shape[2] c_shape[3] c_turn[1] c_turn[2] "
        "c_turn[3] c_turn[4] mass\ndump_modify bodies format float %.17g\n";
  if (output.checkpoint > 0)
    text += "restart " + to_text(output.checkpoint) + " " + name + ".a.restart " + name +
            ".b.restart\n";
  return text;
}

std::string head_text(const Simulation& run, const std::string& name) {
  const Scene& of = run.scene();
  const State& state = run.state();
  double largest = 0.0;
  for (const Vec3& axes : state.particles.semi_axes) largest = std::max(largest, axes.maxCoeff());
  const bool shear =
      std::any_of(of.stages.begin() + static_cast<std::ptrdiff_t>(state.stage), of.stages.end(),
                  [](const Stage& stage) { return stage.drive && shears(stage.drive->loading); });
  std::string text = "# " + name + " from cycle " + to_text(state.cycle) +
                     " on, by tangency-dem export --lammps\n"
                     "#   mpirun -np 2 tangency-lammps -in in." +
                     name +
                     "\n"
                     "units si\natom_style ellipsoid\natom_modify map array\nboundary";
  for (const bool walled : state.cell.walled) text += walled ? " f" : " p";
  text += "\nnewton on\ncomm_modify vel yes\nbox tilt large\n";
  text += "read_data " + name + ".data\n";
  if (shear && state.cell.is_box()) text += "change_box all triclinic\n";
  text += "reset_timestep " + to_text(state.cycle) + "\n";
  text += "\npair_style tangency branch " +
          std::string(of.branch == Branch::global ? "global" : "follow") + "\n";
  text += laws_text(run.laws(), of.particle_types.size());
  text += "neighbor " + to_text(kSkin * largest) +
          (of.particle_types.size() > 1 ? " multi\n" : " bin\n");
  text += "neigh_modify delay 0 every 1 check yes\n";
  text += walls_text(run);
  if (!of.gravity.isZero(0.0))
    text += "fix weight all gravity " + to_text(of.gravity.norm()) + " vector " +
            to_text(of.gravity[0]) + " " + to_text(of.gravity[1]) + " " + to_text(of.gravity[2]) +
            "\n";
  return text;
}

}  // namespace

std::string lammps_script(Simulation run, const std::string& name, const std::string& scene) {
  require_supported(run.scene(), run.state(), scene);
  require_same_walls(run, scene);
  std::string text = head_text(run, name) + output_text(run.scene().output, name);
  for (; !run.finished(); run.next_stage()) text += stage_text(run);
  return text + "\nwrite_data " + name + ".end.data\n";
}

std::vector<std::string> lost_in_lammps(const State& state) {
  std::vector<std::string> lost;
  const auto& shear = state.contacts.columns().shear_force;
  std::int64_t count = 0;
  for (std::size_t k = 0; k < state.contacts.size(); ++k)
    if (state.contacts.touches(k) && !shear[k].isZero(0.0)) ++count;
  if (count > 0)
    lost.push_back(to_text(count) +
                   " contacts bear shear forces, which the data file does not "
                   "hold: in LAMMPS they begin at 0");
  if (state.stage_cycle > 0 && !state.servos.empty())
    lost.emplace_back("the stage's servos begin anew");
  return lost;
}

}  // namespace tangency::inline v0::dem
