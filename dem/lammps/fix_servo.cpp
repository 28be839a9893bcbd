// SPDX-License-Identifier: GPL-2.0-or-later
#include <tangency/dem/lammps/fix_servo.hpp>

#include <atom.h>
#include <comm.h>
#include <domain.h>
#include <error.h>
#include <force.h>
#include <irregular.h>
#include <modify.h>
#include <pair.h>
#include <update.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numbers>
#include <utility>

#include <tangency/dem/cell.hpp>
#include <tangency/dem/lammps/words.hpp>

namespace tangency::inline v0::lammps {
namespace {

constexpr const char* kCommand = "fix tangency/servo";

/// Components in the order of LAMMPS.
constexpr std::array<std::array<int, 2>, 6> kPlaces{
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
constexpr std::array<const char*, 6> kNames{"xx", "yy", "zz", "xy", "xz", "yz"};

/// The upper triangular gradient of the same strain: a box of LAMMPS does not turn.
Mat3 without_turn(const Mat3& rate) {
  Mat3 upper = rate;
  for (int i = 0; i < 3; ++i)
    for (int j = i + 1; j < 3; ++j) {
      upper(i, j) += rate(j, i);
      upper(j, i) = 0.0;
    }
  return upper;
}

}  // namespace

FixServo::FixServo(LAMMPS_NS::LAMMPS* lammps, int count, char** arguments)
    : Fix(lammps, count, arguments), pressure_id_(std::string(id) + "_virial") {
  Words words(lammps, kCommand, count, arguments, 3);
  read(words);
  check(words);
  memory_.resize(loading_.targets.size());
  Mat3 strained = loading_.strain_rate.cwiseAbs();
  for (const dem::Target& target : loading_.targets) strained += target.actuator.cwiseAbs();
  strained = without_turn(strained);
  constexpr int flags[] = {BOX_CHANGE_X,  BOX_CHANGE_Y,  BOX_CHANGE_Z,
                           BOX_CHANGE_XY, BOX_CHANGE_XZ, BOX_CHANGE_YZ};
  for (std::size_t k = 0; k < kPlaces.size(); ++k)
    if (strained(kPlaces[k][0], kPlaces[k][1]) != 0.0) box_change |= flags[k];
  if ((box_change & BOX_CHANGE_SHAPE) != 0 && domain->triclinic == 0)
    words.refuse("shears the box: it has to be tilted, change_box all triclinic");
  no_change_box = 1;
  restart_global = 1;
  nevery = 1;
  force_reneighbor = 1;
  next_reneighbor = -1;
  vector_flag = 1;
  size_vector = static_cast<int>(kPlaces.size() + memory_.size());
  global_freq = 1;
  extvector = 0;
  modify->add_compute(pressure_id_ + " all pressure NULL virial");
}

FixServo::~FixServo() { modify->delete_compute(pressure_id_); }

void FixServo::read(Words& words) {
  std::vector<dem::Target>& targets = loading_.targets;
  const std::string axes = "xyz";
  std::array<bool, kPlaces.size()> has_rate{};
  while (words.any()) {
    const std::string key = words.next("a keyword");
    if (key == "rate") {
      const std::string name = words.next("rate");
      const auto found = std::find(kNames.begin(), kNames.end(), name);
      if (found == kNames.end()) words.refuse("rate", name, "xx, yy, zz, xy, xz or yz");
      const auto place = static_cast<std::size_t>(found - kNames.begin());
      if (std::exchange(has_rate[place], true)) words.refuse("rate", name, "each component once");
      const auto [i, j] = kPlaces[place];
      loading_.strain_rate(i, j) = words.number("rate " + name);
    } else if (key == "mean") {
      targets.push_back(dem::Target::mean_stress(words.number(key), 3));
    } else if (key == "plane") {
      targets.push_back(dem::Target::plane_mean_stress(words.number(key)));
    } else if (key.size() == 1 && axes.find(key) != std::string::npos) {
      targets.push_back(
          dem::Target::component(static_cast<int>(axes.find(key)), words.number(key)));
    } else if (key == "lode") {
      const double ratio = words.number(key);
      if (!(ratio >= 0.0 && ratio <= 1.0)) words.refuse(key, std::to_string(ratio), "0 to 1");
      targets.push_back(dem::Target::intermediate_ratio(ratio));
    } else if (key == "direction") {
      const double angle = words.number(key) * std::numbers::pi / 180.0;
      if (std::abs(angle) > 2.0 * std::numbers::pi)
        words.refuse(key, std::to_string(angle * 180.0 / std::numbers::pi), "-360 to 360 degrees");
      targets.push_back(dem::Target::direction(2, 0, angle));
    } else if (key == "max") {
      loading_.servo.max_strain_rate = words.positive(key);
    } else if (key == "gain") {
      loading_.servo.gain = words.positive(key);
      if (!(loading_.servo.gain < 1.0))
        words.refuse(key, std::to_string(loading_.servo.gain), "a number > 0 and < 1");
    } else if (key == "published") {
      loading_.servo.published_gain = words.positive(key);
    } else if (key == "integral") {
      loading_.servo.integral = words.yes(key);
    } else if (key == "modulus") {
      modulus_ = words.positive(key);
    } else {
      words.refuse("keyword", key,
                   "rate, mean, plane, x, y, z, lode, direction, max, gain, published, integral or "
                   "modulus");
    }
  }
}

void FixServo::check(Words& words) const {
  if (domain->dimension != 3) words.refuse("needs dimension 3");
  if (loading_.targets.empty() && loading_.strain_rate.isZero(0.0))
    words.refuse("nothing to do: a rate, or a stress to hold");
  if (!loading_.targets.empty() && !(loading_.servo.max_strain_rate > 0.0))
    words.refuse("max: missing, the largest rate with which a stress may be held, 1/time");
  if (!loading_.is_independent())
    words.refuse("a stress that is held is a combination of the others");
  for (int axis = 0; axis < 3; ++axis)
    if (domain->boundary[axis][0] >= 2 || domain->boundary[axis][1] >= 2)
      words.refuse("boundaries that shrink-wrap: periodic or fixed ones alone");
}

int FixServo::setmask() {
  return LAMMPS_NS::FixConst::INITIAL_INTEGRATE | LAMMPS_NS::FixConst::PRE_EXCHANGE |
         LAMMPS_NS::FixConst::END_OF_STEP;
}

void FixServo::init() {
  const int found = modify->find_compute(pressure_id_);
  if (found < 0) error->all(FLERR, "fix tangency/servo: compute " + pressure_id_ + " is gone");
  pressure_ = modify->compute[found];
  int dimension = 0;
  if (loading_.targets.empty() || modulus_) return;
  if (force->pair == nullptr || force->pair->extract("affine_stiffness", dimension) == nullptr)
    error->all(FLERR, "fix tangency/servo: the pair style tells no stiffness: give a modulus");
}

void FixServo::setup(int) {
  if (!loading_.targets.empty()) measure();
}

void FixServo::measure() {
  pressure_->compute_vector();
  for (std::size_t k = 0; k < kPlaces.size(); ++k) {
    const auto [i, j] = kPlaces[k];
    stress_.tensor(i, j) = stress_.tensor(j, i) = pressure_->vector[k];
  }
  pressure_->addstep(update->ntimestep + 1);
  if (modulus_) {
    stress_.affine_stiffness = *modulus_;
    return;
  }
  int dimension = 0;
  const double* const here =
      static_cast<double*>(force->pair->extract("affine_stiffness", dimension));
  double all = 0.0;
  MPI_Allreduce(here, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  stress_.affine_stiffness = all * force->nktv2p / (3.0 * Box::of(*domain).volume());
}

void FixServo::initial_integrate(int) {
  const double dt = update->dt;
  rate_ = without_turn(loading_.rate(stress_, dt, memory_));
  Box box = Box::of(*domain);
  dem::Cell cell = dem::Cell::box(Vec3::Ones());
  cell.edges = box.edges;
  cell.rate = rate_;
  cell.strain(dt);
  box.edges = cell.edges;
  if (!(box.edges.diagonal().minCoeff() > 0.0))
    error->all(FLERR, "fix tangency/servo: the run blew up: an edge of the box is no longer > 0");
  box.set(*domain);
  flips_ = !cell.reset().is_none();
  if (flips_) next_reneighbor = update->ntimestep;
}

/// As fix deform describes a tilted box anew.
void FixServo::pre_exchange() {
  if (!flips_) return;
  flips_ = false;
  Box box = Box::of(*domain);
  dem::Cell cell = dem::Cell::box(Vec3::Ones());
  cell.edges = box.edges;
  const dem::Reset reset = cell.reset();
  box.edges = reset.edges(box.edges);
  box.set(*domain);
  // Its edges: b + m a and c + p b + n a, of the old ones.
  domain->image_flip(-reset.xy, reset.yz * reset.xy - reset.xz, -reset.yz);
  for (int i = 0; i < atom->nlocal; ++i) domain->remap(atom->x[i], atom->image[i]);
  domain->x2lamda(atom->nlocal);
  LAMMPS_NS::Irregular irregular(lmp);
  irregular.migrate_atoms();
  domain->lamda2x(atom->nlocal);
}

void FixServo::end_of_step() {
  if (!loading_.targets.empty()) measure();
}

double FixServo::compute_vector(int entry) {
  const auto at = static_cast<std::size_t>(entry);
  if (at < kPlaces.size()) return rate_(kPlaces[at][0], kPlaces[at][1]);
  const dem::Target& target = loading_.targets[at - kPlaces.size()];
  return target.measured(stress_) - target.wanted;
}

void FixServo::write_restart(FILE* file) {
  if (comm->me != 0) return;
  std::vector<double> saved{static_cast<double>(memory_.size())};
  for (const dem::ServoMemory& servo : memory_) {
    saved.push_back(servo.integral);
    saved.push_back(servo.rate);
  }
  const int size = static_cast<int>(saved.size() * sizeof(double));
  std::fwrite(&size, sizeof size, 1, file);
  std::fwrite(saved.data(), sizeof(double), saved.size(), file);
}

void FixServo::restart(char* bytes) {
  const auto next = [&bytes] {
    double value = 0.0;
    std::memcpy(&value, bytes, sizeof value);
    bytes += sizeof value;
    return value;
  };
  const double count = next();
  if (count != static_cast<double>(memory_.size()))
    error->all(FLERR, "fix tangency/servo: the restart holds " +
                          std::to_string(std::lround(count)) + " stresses, and this command " +
                          std::to_string(memory_.size()) + ": the same, or another ID");
  for (dem::ServoMemory& servo : memory_) {
    servo.integral = next();
    servo.rate = next();
  }
}

}  // namespace tangency::inline v0::lammps
