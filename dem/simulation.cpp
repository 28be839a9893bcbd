// SPDX-License-Identifier: MIT
#include <tangency/dem/simulation.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/spatial_order.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

/// Least skin of a particle in the neighbour list, in its mean radii. Measured against 0.1: a cycle
/// takes 2 % less at rest, 5 % less in a shear and 10 % less at elongation 10, and 9 % more while
/// an assembly settles without friction.
constexpr double kSkinRatio = 0.05;

/// Particles from which on they are sorted in space anew at the start of each stage. Chosen: fewer
/// stay near the processor in any order, at some 2 kB each.
constexpr std::size_t kSortedFrom = 2048;

/// Porosity at which a random assembly begins to bear stress, roughly: that of spheres, and of
/// disks.
constexpr double jamming_porosity(int dimensions) { return dimensions == 2 ? 0.16 : 0.36; }

/// @throws CellTooThin
void require_thickness(const Cell& cell, const LeastCell& least) {
  if (auto thin = thin_place(cell, least, kMostSqueeze)) throw CellTooThin(std::move(*thin));
}

/// Relative error that products of decimal fractions bring in, generously: a ramp over 0.01 is over
/// at a strain of 0.01.
constexpr double kRounding = 1e-12;

/// Axial strain from which a shear is held to its stress: what is before it is start. Chosen: a
/// peak of friction comes at several times that.
constexpr double kSettlingStrain = 0.01;

}  // namespace

Simulation::Simulation(const Scene& scene) : Simulation(scene, std::function<void(double)>()) {}

Simulation::Simulation(const Scene& scene, std::function<void(double)> placed)
    : scene_(scene), laws_(scene.laws) {
  Placement placement = scene_.placement();
  placement.progress = std::move(placed);
  state_.particles = place(scene_.batches(), placement, state_.cell);
  state_.cell.planes = scene_.planes;
  require_in_front();
  state_.particles.permute(spatial_order(state_.particles, state_.cell));
  state_.laws = scene_.laws;
  renew_list({}, 0.0);
  update_contacts(0.0);
  next_stage();
  require_single_contacts();
  state_.energy = {};
  state_.energy.start = kinetic_energy_now() + state_.contacts.totals().energy;
}

Simulation::Simulation(const Scene& scene, State state) : scene_(scene), state_(std::move(state)) {
  require_state_of(scene_, state_);
  changed_laws_ = difference_of_laws(state_.laws, scene_);
  state_.laws = scene_.laws;
  changed_walls_ = difference_of_walls(state_.cell, scene_);
  for (std::size_t k = 0; k < scene_.planes.size(); ++k) {
    PlaneWall& plane = state_.cell.planes[k];
    plane.held = scene_.planes[k].held;
    if (!plane.held) plane.velocity = scene_.planes[k].velocity;
  }
  const std::size_t servos = finished() ? 0 : stage().drive->loading.targets.size();
  if (state_.stage_cycle == 0) begin_servos();  // a stage added after the last
  if (!finished() && state_.servos.size() != servos)
    throw std::invalid_argument("a state of a stage that holds " +
                                std::to_string(state_.servos.size()) +
                                " stresses; the scene's stage holds " + std::to_string(servos));
  if (!finished() && state_.ramp_start.size() != (stage().drive->ramp ? servos : 0))
    throw std::invalid_argument(stage().drive->ramp
                                    ? "a state on no ramp; the scene's stage has one"
                                    : "a state on a ramp; the scene's stage has none");
  prepare_stage();
}

const Stage& Simulation::stage() const {
  return scene_.stages[std::min(state_.stage, scene_.stages.size() - 1)];
}

void Simulation::prepare_stage() {
  laws_ = scene_.laws;
  laws_.bodies_turn = scene_.rotation != Rotation::none;
  characteristic_time_ = characteristic_time(state_.particles, laws_.largest_stiffness());
  renew_friction();
  // Velocities that are turned and taken away once forces are known feed a damper, which goes by
  // them, instead of being braked by it: 1,000 needles never came to rest.
  if (!finished() && !stage().drive->damping)
    for (ContactLaw& law : laws_.law) law.damping_ratio = 0.0;
  renew_loading();
  turns_ = anything_turns();
  least_ = least_cell_of(state_.particles);
}

void Simulation::renew_loading() {
  if (finished()) return;
  loading_ = stage().drive->loading;
  for (std::size_t k = 0; k < state_.ramp_start.size(); ++k) {
    double& wanted = loading_.targets[k].wanted;
    loading_.least_scale =
        std::max({loading_.least_scale, std::abs(wanted), std::abs(state_.ramp_start[k])});
    wanted = std::lerp(state_.ramp_start[k], wanted, ramp_share());
  }
  const auto& growth = stage().growth;
  if (!growth || !growth->ramp) return;
  double& wanted = loading_.targets.front().wanted;
  wanted = growth->stress_after(scene_.shape_in(0, state_.stage, 0), state_.increments, wanted);
}

/// On a ramp from that of the stage before, so that no state has to keep it.
void Simulation::renew_friction() {
  if (finished() || !stage().drive->friction_coefficient) return;
  const auto& before = scene_.stages[state_.stage - 1].drive;
  const double share = ramp_share(), wanted = *stage().drive->friction_coefficient;
  for (std::size_t k = 0; k < laws_.law.size(); ++k) {
    const double own = scene_.laws.law[k].friction_coefficient;
    const double first = before ? before->friction_coefficient.value_or(own) : own;
    laws_.law[k].friction_coefficient = std::lerp(first, wanted, share);
  }
}

/// How much of the current stage's ramp is done, in [0, 1]; 1 without one.
double Simulation::ramp_share() const {
  const auto& ramp = stage().drive->ramp;
  if (!ramp) return 1.0;
  const auto cycles = static_cast<double>(state_.stage_cycle);
  const double done = ramp->over == Ramp::Over::cycles ? cycles
                      : ramp->over == Ramp::Over::time ? cycles * time_step()
                                                       : strain();
  return done < ramp->length * (1.0 - kRounding) ? std::max(0.0, done / ramp->length) : 1.0;
}

double Simulation::strain() const {
  const Drive& drive = *stage().drive;
  if (state_.stage_cycle == 0) return 0.0;
  const int axial = state_.cell.dimensions - 1;
  if (drive.axial_strain) return -state_.cell.logarithmic_strain()(axial, axial);
  return drive.loading.strain_rate.cwiseAbs().maxCoeff() *
         (static_cast<double>(state_.stage_cycle) * time_step());
}

bool Simulation::has_passed(double strain) const {
  if (state_.stage_cycle == 0) return false;
  const double rate = stage().drive->loading.strain_rate.cwiseAbs().maxCoeff();
  double before = rate * (static_cast<double>(state_.stage_cycle - 1) * time_step());
  if (stage().drive->axial_strain) {
    Cell cell = state_.cell;
    cell.edges = (Mat3::Identity() + cell.rate * time_step()).inverse() * cell.edges;
    before = -cell.logarithmic_strain()(cell.dimensions - 1, cell.dimensions - 1);
  }
  return std::floor(this->strain() / strain * (1.0 + kRounding)) >
         std::floor(std::max(before, 0.0) / strain * (1.0 + kRounding));
}

/// Smooth spheres at rest never turn. (In the plane a turn costs next to nothing.)
bool Simulation::anything_turns() const {
  if (scene_.dimensions == 2) return true;
  const auto& laws = laws_.law;
  const Particles& particles = state_.particles;
  // On a ramp also what bears shear at one of its ends alone: a resumed run turns what this one
  // does.
  return (!finished() && stage().drive->ramp) ||
         std::any_of(laws.begin(), laws.end(),
                     [](const ContactLaw& law) { return law.bears_shear(); }) ||
         !are_round(particles) ||
         std::any_of(particles.angular_velocity.begin(), particles.angular_velocity.end(),
                     [](const Vec3& spin) { return !spin.isZero(0.0); });
}

void Simulation::next_stage() {
  assert(!finished());
  ++state_.stage;
  state_.stage_cycle = 0;
  state_.ramp_start.clear();
  state_.fire = {};
  state_.increments = 0;
  prepare_stage();
  sort_in_space();
  begin_servos();  // once sorted, as a resumed run adds up its stresses
  renew_loading();
}

/// At the start of a stage: what its servos remember, and where its ramp begins.
void Simulation::begin_servos() {
  state_.servos.clear();
  state_.ramp_start.clear();
  if (finished()) return;
  const Drive& drive = *stage().drive;
  state_.servos.assign(drive.loading.targets.size(), {});
  if (!drive.ramp) return;
  const Stress now = stress_of(state_.contacts, state_.cell);
  for (const Target& target : drive.loading.targets)
    state_.ramp_start.push_back(target.measured(now));
}

/// Puts particles that have mixed back into an order of space, contacts and all.
void Simulation::sort_in_space() {
  if (finished() || state_.particles.size() < kSortedFrom) return;
  const std::vector<std::uint32_t> order = spatial_order(state_.particles, state_.cell);
  if (std::is_sorted(order.begin(), order.end())) return;
  std::vector<std::uint32_t> place(order.size());
  for (std::uint32_t k = 0; k < order.size(); ++k) place[order[k]] = k;
  state_.particles.permute(order);
  renew_list(state_.contacts.renumber(state_.list.pairs(), place), time_step());
  state_.contacts.add_up(state_.particles, state_.list);
}

double Simulation::time_step() const {
  return stage().drive->time_step_factor * characteristic_time_;
}

double Simulation::time_step_ratio() const {
  return time_step() / critical_time_step(state_.particles, state_.contacts, state_.list);
}

Motion Simulation::motion() const {
  const Drive& drive = *stage().drive;
  Motion motion{turns_ ? scene_.rotation : Rotation::none, scene_.gravity,
                drive.damping.value_or(0.0) / characteristic_time_};
  if (drive.rotational_damping)
    motion.rotational_damping = *drive.rotational_damping / characteristic_time_;
  return motion;
}

/// At the time of the positions: what goes with the elastic energy in the account.
double Simulation::kinetic_energy_now() const {
  if (!stage().drive) return kinetic_energy(state_.particles);  // nothing moves after the placing
  return kinetic_energy_at(state_.particles, state_.contacts.resultants(), motion(), time_step());
}

void Simulation::step() {
  assert(!finished());
  if (state_.stage_cycle == 0) state_.cell.reference_edges = state_.cell.edges;
  describe_cell_anew();
  if (grows_now()) grow();
  const double dt = time_step();
  state_.cell.rate = next_rate(dt);

  move_particles(dt);
  keep_list_current(dt);
  ++state_.cycle;
  ++state_.stage_cycle;
  state_.time += dt;
  if (stage().drive->ramp) {
    renew_loading();
    renew_friction();
  }
  update_contacts(dt);
  if (profile_ == nullptr) return;
  ++profile_->cycles;
  profile_->listed_pairs += static_cast<std::int64_t>(state_.list.pairs().size());
}

/// A cell in simple shear is described by its least skewed edges: thin ones would need more images.
void Simulation::describe_cell_anew() {
  const Reset reset = state_.cell.reset();
  if (reset.is_none()) return;
  state_.description = state_.description.then(reset);
  Cell& cell = state_.cell;
  for (Mat3* edges : {&cell.edges, &cell.reference_edges}) *edges = reset.edges(*edges);
  NeighbourList::Reference reference = state_.list.reference();
  reference.edges = reset.edges(reference.edges);
  for (Vec3& at : reference.reduced_position) at = reset.reduced(at);
  std::vector<Pair> pairs = state_.contacts.follow(state_.list.pairs(), reset);
  state_.list.restore(std::move(reference), std::move(pairs));
  state_.contacts.add_up(state_.particles, state_.list);
}

/// @throws DoesNotFit  where a body's centre is behind a wall
void Simulation::require_in_front() const {
  const auto& position = state_.particles.position;
  for (std::size_t k = 0; k < scene_.planes.size(); ++k)
    for (std::size_t i = 0; i < position.size(); ++i)
      if (!(scene_.planes[k].height_of(position[i]) > 0.0))
        throw DoesNotFit("particle " + std::to_string(i) + " is placed behind wall[" +
                         std::to_string(k) + "]: bodies are on the side that its normal points to");
}

Contacts::Borne Simulation::force_on_plane(std::size_t plane) const {
  const std::size_t index = state_.particles.size() + kCellFaces + plane;
  return state_.contacts.borne_by(static_cast<std::int32_t>(index), state_.list);
}

/// Moves the walls that move a step on.
void Simulation::set_planes_going(double dt) {
  Cell& cell = state_.cell;
  for (std::size_t k = 0; k < cell.planes.size(); ++k) {
    PlaneWall& plane = cell.planes[k];
    if (plane.held) {
      const auto [force, stiffness] = force_on_plane(k);
      plane.follow(force, stiffness, section_area(plane, cell.edges.diagonal()), dt);
    }
    plane.offset += dt * plane.normal.dot(plane.velocity);
  }
}

void Simulation::move_particles(double dt) {
  const PhaseTimer timer(profile_, Phase::motion);
  if (!stage().drive->damping)
    state_.energy.damping +=
        state_.fire.steer(state_.particles, state_.contacts.resultants(), motion(), dt);
  set_planes_going(dt);
  const MotionWork work =
      move(state_.particles, state_.cell, state_.contacts.resultants(), motion(), dt);
  state_.energy.damping += work.damping;
  state_.energy.gravity += work.gravity;
}

/// Is it time for the next increment? @throws CellTooThin
bool Simulation::grows_now() const {
  const PhaseTimer timer(profile_, Phase::control);
  require_single_contacts();
  if (is_grown()) return false;
  return !stage().growth->waits_after(state_.increments) || is_relaxed();
}

void Simulation::require_single_contacts() const {
  if (auto doubled =
          doubled_contact(state_.particles, state_.contacts, state_.list, state_.cell, least_))
    throw CellTooThin(std::move(*doubled));
}

/// The cell's rate for the coming step. @throws CellTooThin
Mat3 Simulation::next_rate(double dt) {
  const PhaseTimer timer(profile_, Phase::control);
  std::vector<ServoMemory> servos = state_.servos;
  const Stress stress = stress_of(state_.contacts, state_.cell);
  Cell next = state_.cell;
  next.rate = loading_.rate(stress, dt, servos);
  next.strain(dt);
  require_thickness(next, least_);
  state_.servos = std::move(servos);
  watch(stress);
  return next.rate;
}

void Simulation::update_contacts(double dt) {
  const ContactWork work = state_.contacts.update(state_.particles, state_.cell, state_.list, laws_,
                                                  dt, scene_.branch, dt > 0.0 ? profile_ : nullptr);
  state_.energy.sliding += work.sliding;
  state_.energy.boundary += work.boundary;
  state_.energy.branch += work.branch;
  state_.energy.viscous += work.viscous;
}

void Simulation::keep_list_current(double dt) {
  const PhaseTimer timer(profile_, Phase::list);
  if (state_.list.is_current(state_.particles, state_.cell)) return;
  renew_list(state_.list.pairs(), dt);
  if (profile_ != nullptr) ++profile_->list_builds;
}

/// @param before  the pairs that the contacts are of
void Simulation::renew_list(std::vector<Pair> before, double dt) {
  try {
    state_.list.build(state_.particles, state_.cell, kSkinRatio, dt);
  } catch (const std::invalid_argument& error) {
    throw Diverged(std::string("the run blew up: ") + error.what());
  }
  state_.contacts.carry_over(before, state_.list.pairs());
}

/// Keeps account of how stresses are held that the stage holds until its end: in a shear from where
/// friction has been mobilised, else from when they are first met.
void Simulation::watch(const Stress& stress) {
  const Drive& stage = *this->stage().drive;
  const int axial = state_.cell.dimensions - 1;
  if (stage.stress_tolerance) return;  // the stage ends when they are met
  if (stage.axial_strain && -state_.cell.logarithmic_strain()(axial, axial) < kSettlingStrain)
    return;
  loading_.watch(stress, !stage.axial_strain, state_.servos);
}

/// Are the stresses the wanted ones and, where the stage asks for it, the assembly in balance?
bool Simulation::is_relaxed() const {
  const Drive& stage = *this->stage().drive;
  if (ramp_share() < 1.0) return false;
  if (stage.stress_tolerance &&
      !loading_.is_met(stress_of(state_.contacts, state_.cell), *stage.stress_tolerance))
    return false;
  const auto& growth = this->stage().growth;
  if (!stage.max_unbalanced_ratio && !growth) return true;
  const Balance balance = balance_of(state_.particles, state_.contacts, scene_.gravity);
  // Where nothing presses, a body that touches nothing has not come down yet; nor have those whose
  // contacts bear nothing.
  if (stage.loading.targets.empty() && !scene_.gravity.isZero(0.0) &&
      (balance.rattlers > 0 || balance.mean_contact_force == 0.0))
    return false;
  if (growth) return balance.inertial_fraction <= growth->max_inertial_fraction;
  return walls_bear_their_stress(*stage.max_unbalanced_ratio) &&
         std::max(balance.largest_unbalanced_ratio, balance.largest_unbalanced_moment_ratio) <=
             *stage.max_unbalanced_ratio;
}

/// A wall that is on its way presses nothing, and what lies below it may be at rest meanwhile.
bool Simulation::walls_bear_their_stress(double tolerance) const {
  const Cell& cell = state_.cell;
  for (std::size_t k = 0; k < cell.planes.size(); ++k) {
    if (!cell.planes[k].held) continue;
    const double wanted =
        cell.planes[k].held->stress * section_area(cell.planes[k], cell.edges.diagonal());
    if (!(std::abs(force_on_plane(k).force - wanted) <= tolerance * wanted)) return false;
  }
  return true;
}

bool Simulation::is_at_its_end() const {
  const Drive& stage = *this->stage().drive;
  const int axial = state_.cell.dimensions - 1;
  if (stage.duration && state_.stage_cycle < *stage.duration) return false;
  return !stage.axial_strain ||
         (state_.stage_cycle > 0 &&
          -state_.cell.logarithmic_strain()(axial, axial) >= *stage.axial_strain);
}

bool Simulation::is_grown() const {
  const auto& growth = stage().growth;
  return !growth || state_.increments == growth->increments;
}

void Simulation::grow() {
  std::vector<Vec3> axes;
  LeastCell least;
  for (std::size_t type = 0; type < scene_.particle_types.size(); ++type) {
    const Shape shape = scene_.shape_in(type, state_.stage, state_.increments + 1);
    axes.push_back(shape.semi_axes(state_.cell.dimensions));
    least.add(axes.back(), scene_.particle_types[type].batch.count);
  }
  require_thickness(state_.cell, least);
  least_ = least;
  ++state_.increments;
  if (stage().growth->ramp) renew_loading();
  Particles& particles = state_.particles;
  const auto energy = [&] { return state_.contacts.totals().energy + kinetic_energy_now(); };
  const double before = energy();
  for (std::size_t i = 0; i < particles.size(); ++i)
    particles.semi_axes[i] = axes[static_cast<std::size_t>(particles.type[i])];
  turns_ = anything_turns();
  keep_list_current(time_step());
  const EnergyAccount account = state_.energy;
  update_contacts(0.0);
  state_.energy = account;  // nothing moved: what changed is the growth's
  state_.energy.growth += energy() - before;
}

StageStatus Simulation::status() const {
  if (is_grown() && is_at_its_end() && is_relaxed()) return StageStatus::done;
  return state_.stage_cycle < stage().drive->max_cycles ? StageStatus::running
                                                        : StageStatus::out_of_cycles;
}

CyclesNeeded Simulation::cycles_needed() const {
  const int axial = state_.cell.dimensions - 1;
  const double strain =
      state_.stage_cycle > 0 ? -state_.cell.logarithmic_strain()(axial, axial) : 0.0;
  const StageProgress done{state_.stage_cycle, state_.increments, strain,
                           compression_to_packing(state_.particles, state_.cell.volume())};
  return dem::cycles_needed(stage(), time_step(), scene_.dimensions, done);
}

double Simulation::stage_fraction() const {
  if (finished()) return 1.0;
  const Drive& stage = *this->stage().drive;
  if (const auto& growth = this->stage().growth)
    return static_cast<double>(state_.increments) / static_cast<double>(growth->increments);
  if (stage.duration)
    return static_cast<double>(state_.stage_cycle) / static_cast<double>(*stage.duration);
  const Observation seen = observe();
  if (stage.axial_strain) return std::clamp(seen.axial_strain / *stage.axial_strain, 0.0, 1.0);
  if (stage.max_unbalanced_ratio) {
    const double worst = std::max(seen.balance.largest_unbalanced_ratio,
                                  seen.balance.largest_unbalanced_moment_ratio);
    if (!(worst > 0.0)) return 0.0;
    return std::clamp(std::log(worst) / std::log(*stage.max_unbalanced_ratio), 0.0, 1.0);
  }
  const double to_jamming =
      std::log((1.0 - jamming_porosity(scene_.dimensions)) / (1.0 - seen.porosity)) -
      seen.volumetric_strain;
  const double volume_part =
      to_jamming > 0.0 ? std::clamp(-seen.volumetric_strain / to_jamming, 0.0, 1.0) : 1.0;
  const double stress_part =
      std::clamp(seen.stress.mean() / stage.loading.targets.front().wanted, 0.0, 1.0);
  return 0.8 * volume_part + 0.2 * stress_part;
}

Observation Simulation::observe() const {
  Observation seen = dem::observe(state_.particles, state_.cell, state_.contacts, scene_.gravity);
  seen.account = state_.energy;
  seen.boundary_stress =
      boundary_stress_of(state_.particles, state_.cell, state_.contacts, state_.list);
  seen.energy_error = energy_error();
  return seen;
}

double Simulation::energy_error() const {
  return kinetic_energy_now() + state_.contacts.totals().energy - state_.energy.sum();
}

}  // namespace tangency::inline v0::dem
