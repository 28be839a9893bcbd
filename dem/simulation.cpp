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

/// The share of a cell that bounding spheres (circles) fill where an assembly begins to bear
/// stress, at the loosest, so that compaction takes at least as long as to there. Chosen: below
/// 0.55 and 0.77, the loosest packings of spheres and of disks that stand [Onoda1990].
constexpr double loosest_packing(int dimensions) { return dimensions == 2 ? 0.7 : 0.5; }

/// Relative difference of two descriptions of one particle: the semi-axes of another machine's
/// libm are a few roundings off. Chosen: far below any change that someone makes.
constexpr double kSameRelatively = 1e-9;

/// @throws CellTooThin
void require_thickness(const Cell& cell, const LeastCell& least) {
  if (auto thin = thin_place(cell, least, kMostSqueeze)) throw CellTooThin(std::move(*thin));
}

/// Axial strain from which a shear is held to its stress: what is before it is start. Chosen: a
/// peak of friction comes at several times that.
constexpr double kSettlingStrain = 0.01;

void require_equal(const std::string& key, double in_state, double in_scene) {
  if (std::abs(in_state - in_scene) <= kSameRelatively * in_scene) return;
  throw std::invalid_argument("a state with " + key + " = " + tables::rounded_text(in_state, 10) +
                              "; the scene has " + tables::rounded_text(in_scene, 10));
}

/// Of a type whose bodies are not alike.
/// @throws std::invalid_argument  where those of the state are others
void require_same_shapes(const Particles& particles, std::size_t type, const ParticleType& wanted) {
  std::vector<std::array<double, 3>> is, was;
  const auto add = [](auto& all, const Vec3& axes) { all.push_back({axes[0], axes[1], axes[2]}); };
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (static_cast<std::size_t>(particles.type[i]) == type) add(was, particles.semi_axes[i]);
  for (const Shape& shape : wanted.batch.shapes) add(is, shape.semi_axes(particles.dimensions));
  std::sort(is.begin(), is.end());
  std::sort(was.begin(), was.end());
  for (std::size_t i = 0; i < is.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      require_equal("a semi-axis of particles." + wanted.name, was[i][k], is[i][k]);
}

/// @throws std::invalid_argument  naming the first key of the scene that the particles are not of
void require_same_particles(const State& state, const Scene& scene) {
  const Particles& particles = state.particles;
  const std::vector<ParticleType>& types = scene.particle_types;
  require_equal("cell.dimensions", state.cell.dimensions, scene.dimensions);
  if (state.cell.walled != scene.walled)
    throw std::invalid_argument("a state with other cell.walls than the scene");
  require_equal("wall tables", static_cast<double>(state.cell.planes.size()),
                static_cast<double>(scene.planes.size()));
  const auto count = static_cast<std::int32_t>(types.size());
  std::vector<std::size_t> counts(types.size(), 0);
  for (const std::int32_t type : particles.type) {
    if (type < 0 || type >= count)
      throw std::invalid_argument("a state with more particle types than the scene's " +
                                  std::to_string(count));
    ++counts[static_cast<std::size_t>(type)];
  }
  for (std::size_t k = 0; k < types.size(); ++k)
    require_equal("particles." + types[k].name + ".count", static_cast<double>(counts[k]),
                  static_cast<double>(types[k].batch.count));
  for (const std::uint32_t i : particles.index_of_id()) {
    const auto type = static_cast<std::size_t>(particles.type[i]);
    const auto& [name, batch] = types[type];
    const Shape shape = scene.shape_in(type, state.stage, state.increments);
    const Vec3& axes = particles.semi_axes[i];
    const std::string path = "particles." + name;
    const int dimensions = scene.dimensions;
    require_equal(path + ".density", particles.mass[i] / volume_of(axes, dimensions),
                  batch.density);
    if (!batch.shapes.empty()) continue;
    require_equal(path + ".mean_radius", mean_radius_of(axes, dimensions), shape.mean_radius);
    require_equal(path + ".elongation", axes[0] / axes[1], shape.elongation);
    require_equal(path + ".flatness", axes[1] / axes[2], shape.flatness);
  }
  for (std::size_t k = 0; k < types.size(); ++k)
    if (!types[k].batch.shapes.empty()) require_same_shapes(particles, k, types[k]);
}

std::string short_text(double x) { return tables::rounded_text(x, 6); }

/// "contact.a-b.normal_stiffness = 2, and here 3" of each key that differs, of the first pair that
/// it does for. Of one pair of types where there is but one law.
std::string difference_of_laws(const ContactLaws& made, const Scene& scene) {
  std::vector<std::string> keys;
  std::string text;
  const auto compare = [&](std::size_t pair, const std::string& key, double was, double is) {
    if (std::abs(was - is) <= kSameRelatively * std::abs(is)) return;
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) return;
    keys.push_back(key);
    const auto name = [&](std::size_t type) {
      return type < scene.particle_types.size() ? scene.particle_types[type].name : "wall";
    };
    const std::size_t types = made.types;
    text += (text.empty() ? "" : "; ") + std::string("contact.") + name(pair / types) + "-" +
            name(pair % types) + "." + key + " = " + short_text(was) + ", and here " +
            short_text(is);
  };
  if (made.law.size() != scene.laws.law.size()) return "other particle types";
  for (std::size_t pair = 0; pair < made.law.size(); ++pair) {
    const ContactLaw &was = made.law[pair], &is = scene.laws.law[pair];
    if (was.hertz.has_value() != is.hertz.has_value()) return "another contact.law";
    if (was.hertz) {
      compare(pair, "young_modulus", was.hertz->young_modulus, is.hertz->young_modulus);
      compare(pair, "poisson_ratio", was.hertz->poisson_ratio, is.hertz->poisson_ratio);
    } else {
      compare(pair, "normal_stiffness", was.normal_stiffness, is.normal_stiffness);
      compare(pair, "shear_stiffness", was.shear_stiffness, is.shear_stiffness);
    }
    compare(pair, "friction_coefficient", was.friction_coefficient, is.friction_coefficient);
    compare(pair, "cohesion", was.cohesion, is.cohesion);
    compare(pair, "restitution", was.restitution(), is.restitution());
  }
  return text;
}

std::string short_text(const Vec3& v) {
  return "[ " + short_text(v[0]) + ", " + short_text(v[1]) + ", " + short_text(v[2]) + " ]";
}

std::string wall_key(std::size_t k, const std::string& key) {
  return "wall[" + std::to_string(k) + "]." + key;
}

/// @throws std::invalid_argument  naming the first wall that has another normal
void require_same_normals(const std::vector<PlaneWall>& made, const Scene& scene) {
  for (std::size_t k = 0; k < scene.planes.size(); ++k) {
    const Vec3 &was = made[k].normal, &is = scene.planes[k].normal;
    if ((was - is).norm() > kSameRelatively)
      throw std::invalid_argument("a state with " + wall_key(k, "normal") + " = " +
                                  short_text(was) + "; the scene has " + short_text(is));
  }
}

/// "wall[0].velocity = [ 0, 0, 1 ], and here [ 0, 0, 2 ]" of each wall that differs. A state has no
/// velocity of a wall that the scene holds at a stress, and a wall that moves is elsewhere by
/// right.
std::string difference_of_walls(const Cell& made, const Scene& scene) {
  std::string text;
  const auto add = [&](const std::string& difference) {
    text += (text.empty() ? "" : "; ") + difference;
  };
  const double same = kSameRelatively * made.edges.diagonal().norm();
  for (std::size_t k = 0; k < scene.planes.size(); ++k) {
    const PlaneWall &was = made.planes[k], &is = scene.planes[k];
    if (is.held) continue;
    if ((was.velocity - is.velocity).norm() > kSameRelatively * is.velocity.norm())
      add(wall_key(k, "velocity") + " = " + short_text(was.velocity) + ", and here " +
          short_text(is.velocity));
    const bool moves = was.normal.dot(was.velocity) != 0.0 || is.normal.dot(is.velocity) != 0.0;
    if (!moves && std::abs(was.offset - is.offset) > same)
      add(wall_key(k, "point") + " at " + short_text(was.offset) + " along its normal, and here " +
          short_text(is.offset) + ": it stays where it is");
  }
  return text;
}

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
  if (state_.stage > scene_.stages.size())
    throw std::invalid_argument("a state after " + std::to_string(state_.stage) +
                                " stages; the scene has " + std::to_string(scene_.stages.size()));
  const auto& growth = stage().growth;
  const std::int64_t most = growth && !finished() ? growth->increments : 0;
  if (state_.increments < 0 || state_.increments > most)
    throw std::invalid_argument("a state after " + std::to_string(state_.increments) +
                                " increments of growth; the scene's stage has " +
                                std::to_string(most));
  require_same_particles(state_, scene_);
  changed_laws_ = difference_of_laws(state_.laws, scene_);
  state_.laws = scene_.laws;
  require_same_normals(state_.cell.planes, scene_);
  changed_walls_ = difference_of_walls(state_.cell, scene_);
  for (std::size_t k = 0; k < scene_.planes.size(); ++k) {
    PlaneWall& plane = state_.cell.planes[k];
    plane.held = scene_.planes[k].held;
    if (!plane.held) plane.velocity = scene_.planes[k].velocity;
  }
  prepare_stage();
  const std::size_t servos = finished() ? 0 : stage().drive->loading.targets.size();
  if (state_.stage_cycle == 0) state_.servos.assign(servos, {});  // a stage added after the last
  if (!finished() && state_.servos.size() != servos)
    throw std::invalid_argument("a state of a stage that holds " +
                                std::to_string(state_.servos.size()) +
                                " stresses; the scene's stage holds " + std::to_string(servos));
}

const Stage& Simulation::stage() const {
  return scene_.stages[std::min(state_.stage, scene_.stages.size() - 1)];
}

void Simulation::prepare_stage() {
  laws_ = scene_.laws;
  laws_.bodies_turn = scene_.rotation != Rotation::none;
  if (!finished() && stage().drive->friction_coefficient)
    for (ContactLaw& law : laws_.law)
      law.friction_coefficient = *stage().drive->friction_coefficient;
  // Velocities that are turned and taken away once forces are known feed a damper, which goes by
  // them, instead of being braked by it: 1,000 needles never came to rest.
  if (!finished() && !stage().drive->damping)
    for (ContactLaw& law : laws_.law) law.damping_ratio = 0.0;
  renew_loading();
  turns_ = anything_turns();
  least_ = least_cell_of(state_.particles);
  characteristic_time_ = characteristic_time(state_.particles, laws_.largest_stiffness());
}

void Simulation::renew_loading() {
  if (finished()) return;
  loading_ = stage().drive->loading;
  const auto& growth = stage().growth;
  if (!growth || !growth->ramp) return;
  double& wanted = loading_.targets.front().wanted;
  wanted = growth->stress_after(scene_.shape_in(0, state_.stage, 0), state_.increments, wanted);
}

/// Smooth spheres at rest never turn. (In the plane a turn costs next to nothing.)
bool Simulation::anything_turns() const {
  if (scene_.dimensions == 2) return true;
  const auto& laws = laws_.law;
  const Particles& particles = state_.particles;
  return std::any_of(laws.begin(), laws.end(),
                     [](const ContactLaw& law) { return law.bears_shear(); }) ||
         !are_round(particles) ||
         std::any_of(particles.angular_velocity.begin(), particles.angular_velocity.end(),
                     [](const Vec3& spin) { return !spin.isZero(0.0); });
}

void Simulation::next_stage() {
  assert(!finished());
  ++state_.stage;
  state_.stage_cycle = 0;
  state_.servos.assign(finished() ? 0 : stage().drive->loading.targets.size(), {});
  state_.fire = {};
  state_.increments = 0;
  prepare_stage();
  sort_in_space();
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
  update_contacts(dt);

  ++state_.cycle;
  ++state_.stage_cycle;
  state_.time += dt;
  if (profile_ == nullptr) return;
  ++profile_->cycles;
  profile_->listed_pairs += static_cast<std::int64_t>(state_.list.pairs().size());
}

/// A cell in simple shear is described by its least skewed edges: thin ones would need more images.
void Simulation::describe_cell_anew() {
  const Reset reset = state_.cell.reset();
  if (reset.is_none()) return;
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

/// Moves the walls that move a step on.
void Simulation::set_planes_going(double dt) {
  Cell& cell = state_.cell;
  const auto first = static_cast<std::int32_t>(state_.particles.size() + kCellFaces);
  for (std::size_t k = 0; k < cell.planes.size(); ++k) {
    PlaneWall& plane = cell.planes[k];
    if (plane.held) {
      const auto [force, stiffness] =
          state_.contacts.borne_by(first + static_cast<std::int32_t>(k), state_.list);
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
  return std::max(balance.largest_unbalanced_ratio, balance.largest_unbalanced_moment_ratio) <=
         *stage.max_unbalanced_ratio;
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

/// Cycles of straining as fast as allowed to where bounding spheres could bear stress.
double Simulation::cycles_to_a_packing() const {
  const Drive& stage = *this->stage().drive;
  double bounding = 0.0;
  for (const Vec3& axes : state_.particles.semi_axes)
    bounding += volume_of(Vec3::Constant(axes.maxCoeff()), state_.cell.dimensions);
  const double to_strain =
      std::log(state_.cell.volume() * loosest_packing(scene_.dimensions) / bounding);
  const double a_cycle =
      -std::log1p(-stage.loading.servo.max_strain_rate * time_step()) * scene_.dimensions;
  return std::max(0.0, to_strain / a_cycle);
}

CyclesNeeded Simulation::cycles_needed() const {
  const Drive& stage = *this->stage().drive;
  CyclesNeeded most;
  const auto needs = [&](double cycles, const char* key) {
    if (cycles > most.cycles) most = {std::ceil(cycles), key};
  };
  if (stage.duration) needs(static_cast<double>(*stage.duration - state_.stage_cycle), "duration");
  if (stage.axial_strain) {
    const int axial = state_.cell.dimensions - 1;
    const double done =
        state_.stage_cycle > 0 ? -state_.cell.logarithmic_strain()(axial, axial) : 0.0;
    const double a_cycle = -std::log1p(stage.loading.strain_rate(axial, axial) * time_step());
    needs((*stage.axial_strain - done) / a_cycle, "axial_strain");
  }
  if (stage.stress_tolerance) needs(cycles_to_a_packing(), "mean_stress");
  if (const auto& growth = this->stage().growth)
    needs(static_cast<double>(growth->increments - state_.increments),
          growth->cycles_per_percent ? "cycles_per_percent" : "increments");
  return most;
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
