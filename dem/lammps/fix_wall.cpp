// SPDX-License-Identifier: GPL-2.0-or-later
#include <tangency/dem/lammps/fix_wall.hpp>

#include <atom.h>
#include <atom_vec_ellipsoid.h>
#include <comm.h>
#include <domain.h>
#include <error.h>
#include <update.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

#include <tangency/dem/contact/contact_blocks.hpp>
#include <tangency/dem/lammps/atom_bodies.hpp>
#include <tangency/dem/lammps/host.hpp>
#include <tangency/dem/lammps/pair_coefficients.hpp>
#include <tangency/dem/lammps/words.hpp>

namespace tangency::inline v0::lammps {
namespace {

constexpr const char* kCommand = "fix wall/tangency";

Vec3 vector_of(Words& words, const std::string& key) {
  Vec3 v;
  for (int k = 0; k < 3; ++k) v[k] = words.number(key);
  return v;
}

/// The stress of a force on the wall with its branch, as LAMMPS orders it.
std::array<double, 6> virial_of(const Vec3& on_wall, const Vec3& branch) {
  const Mat3 all = branch * on_wall.transpose();
  const Mat3 s = 0.5 * (all + all.transpose());
  return {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(0, 2), s(1, 2)};
}

}  // namespace

FixWall::FixWall(LAMMPS_NS::LAMMPS* lammps, int count, char** arguments)
    : Fix(lammps, count, arguments), cell_(dem::Cell::box(Vec3::Ones())) {
  Words words(lammps, kCommand, count, arguments, 3);
  read_plane(words);
  laws_ = {1, {law_of(words)}, true};
  if (AtomBodies::ellipsoids(lammps) == nullptr || atom->rmass_flag == 0)
    words.refuse("needs atom_style ellipsoid");
  if (domain->dimension != 3) words.refuse("needs dimension 3");
  scalar_flag = vector_flag = 1;
  size_vector = static_cast<int>(kNumbers);
  global_freq = 1;
  extscalar = extvector = 1;
  energy_global_flag = 1;
  virial_global_flag = thermo_virial = 1;
  restart_global = restart_peratom = 1;
  create_attribute = 1;
  maxexchange = kRecordNumbers;
  grow_arrays(atom->nmax);
  atom->add_callback(LAMMPS_NS::Atom::GROW);
  atom->add_callback(LAMMPS_NS::Atom::RESTART);
  for (int i = 0; i < atom->nlocal; ++i) set_arrays(i);
}

FixWall::~FixWall() {
  atom->delete_callback(id, LAMMPS_NS::Atom::GROW);
  atom->delete_callback(id, LAMMPS_NS::Atom::RESTART);
}

/// All words before those of the law.
void FixWall::read_plane(Words& words) {
  dem::PlaneWall wall;
  bool has_plane = false;
  while (true) {
    const std::string key = words.next("law");
    if (key == "law") break;
    if (key == "plane") {
      const Vec3 point = vector_of(words, "point of plane"), normal = vector_of(words, "normal");
      if (!(normal.norm() > 0.0)) words.refuse("normal", "0 0 0", "a direction");
      wall.normal = normal.normalized();
      wall.offset = wall.normal.dot(point);
      has_plane = true;
    } else if (key == "velocity") {
      wall.velocity = vector_of(words, key);
    } else {
      words.refuse("keyword", key, "plane, velocity or law");
    }
  }
  if (!has_plane) words.refuse("plane: missing, a point and a normal");
  cell_.planes = {wall};
}

int FixWall::setmask() {
  return LAMMPS_NS::FixConst::INITIAL_INTEGRATE | LAMMPS_NS::FixConst::POST_FORCE;
}

void FixWall::init() {
  if (domain->box_change_size != 0 || domain->box_change_shape != 0)
    error->all(FLERR, std::string(kCommand) + ": the box strains, and such walls do not");
  for (int axis = 0; axis < 3; ++axis)
    if (domain->periodicity[axis] != 0 && cell_.planes[0].normal[axis] != 0.0)
      error->all(FLERR, std::string(kCommand) + ": the normal is not across axis " +
                            std::string(1, "xyz"[axis]) + ", along which the box is periodic");
}

void FixWall::setup(int vflag) { post_force(vflag); }

void FixWall::initial_integrate(int) {
  dem::PlaneWall& wall = cell_.planes[0];
  wall.offset += update->dt * wall.normal.dot(wall.velocity);
}

/// The particles that may touch the wall; the records of all others are empty.
void FixWall::collect() {
  atom_.clear();
  particles_ = {};
  motion_.clear();
  const LAMMPS_NS::AtomVecEllipsoid& from = *AtomBodies::ellipsoids(lmp);
  for (int i = 0; i < atom->nlocal; ++i) {
    if ((atom->mask[i] & groupbit) == 0 || atom->ellipsoid[i] < 0) continue;
    if (const char* const fault = AtomBodies::fault_of(*atom, from, i))
      error->one(FLERR, std::string(kCommand) + ": atom " + std::to_string(atom->tag[i]) + fault);
    const Body& body = body_at(from, atom->ellipsoid[i]);
    const Vec3 axes = Vec3::Map(body.shape), place = Vec3::Map(atom->x[i]);
    if (!(cell_.planes[0].height_of(place) < axes.maxCoeff())) {
      std::fill_n(record_of(i), kRecordNumbers, 0.0);
      continue;
    }
    const Quaternion turn(body.quat[0], body.quat[1], body.quat[2], body.quat[3]);
    particles_.add(place, turn, axes, 1.0, 0);
    particles_.mass.back() = atom->rmass[i];
    const Vec3 spin = AtomBodies::spin_of(Vec3::Map(atom->angmom[i]), turn, atom->rmass[i], axes);
    const double* v = atom->v[i];
    motion_.push_back({{v[0], v[1], v[2]}, 0.0, {spin[0], spin[1], spin[2]}, 0.0});
    atom_.push_back(i);
  }
  const Vec3& v = cell_.planes[0].velocity;
  motion_.resize(motion_.size() + dem::kCellFaces, {});
  motion_.push_back({{v[0], v[1], v[2]}, 0.0, {0.0, 0.0, 0.0}, 0.0});
  narrow_phase_.aim(particles_);
  narrow_phase_.refresh(particles_, 0, particles_.size());
}

void FixWall::post_force(int vflag) {
  v_init(vflag);
  energy_ = 0.0;
  std::fill_n(here_.begin(), 4, 0.0);
  collect();
  const bool moves = update->setupflag == 0 && update->whichflag == 1;
  for (std::size_t first = 0; first < atom_.size(); first += dem::kPairBlock)
    touch(first, std::min(dem::kPairBlock, atom_.size() - first), moves ? update->dt : 0.0);
}

void FixWall::touch(std::size_t first, std::size_t count, double dt) {
  const auto wall = static_cast<std::uint32_t>(particles_.size() + dem::kCellFaces);
  const Vec3& speed = cell_.planes[0].velocity;
  std::array<dem::Pair, dem::kPairBlock> pairs{};
  double before = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const auto body = static_cast<std::uint32_t>(first + k);
    const int i = atom_[first + k];
    pairs[k].a = static_cast<std::int32_t>(body);
    pairs[k].b = static_cast<std::int32_t>(wall);
    block_.add({i, i, record_of(i)}, {body, wall}, Vec3::Zero());
    before -= block_.record(k).force().dot(speed);
  }
  dem::ContactBlock block = block_.block();
  narrow_phase_.measure(std::span(pairs.data(), count), particles_, cell_,
                        std::span(block_.normals(), count), dem::Branch::follow, block_.geometry());
  step_block({particles_, narrow_phase_, laws_, motion_, dt, Mat3::Zero(), true, laws_.dissipate()},
             block_.geometry(), block);
  block_.write_back();
  double after = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    if (!block_.touches(k)) continue;
    int i = block_.atoms(k).a;
    const ContactRecord now = block_.record(k);
    const Vec3& on_wall = block_.force(k);
    Vec3::Map(atom->f[i]) -= on_wall;
    Vec3::Map(atom->torque[i]) += block_.moment_a(k);
    Vec3::Map(here_.data()) += on_wall;
    here_[3] += 1.0;
    energy_ += now.normal_energy + now.shear_energy;
    after -= on_wall.dot(speed);
    if (evflag != 0) v_tally(1, &i, 1.0, virial_of(on_wall, now.branch).data());
  }
  here_[4] += block_.sums().sliding;
  here_[5] += block_.sums().boundary + 0.5 * dt * (before + after);
  here_[6] += block_.sums().branch;
  here_[7] += block_.sums().viscous;
  block_.clear();
}

double FixWall::compute_scalar() {
  double all = 0.0;
  MPI_Allreduce(&energy_, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

double FixWall::compute_vector(int entry) {
  double all = 0.0;
  MPI_Allreduce(&here_[static_cast<std::size_t>(entry)], &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

double FixWall::memory_usage() { return static_cast<double>(records_.capacity() * sizeof(double)); }

void FixWall::grow_arrays(int atoms) {
  records_.resize(static_cast<std::size_t>(atoms) * kRecordNumbers, 0.0);
}

void FixWall::copy_arrays(int from, int to, int) {
  std::copy_n(record_of(from), kRecordNumbers, record_of(to));
}

void FixWall::set_arrays(int i) { std::fill_n(record_of(i), kRecordNumbers, 0.0); }

int FixWall::pack_exchange(int i, double* buffer) {
  std::copy_n(record_of(i), kRecordNumbers, buffer);
  return kRecordNumbers;
}

int FixWall::unpack_exchange(int i, double* buffer) {
  std::copy_n(buffer, kRecordNumbers, record_of(i));
  return kRecordNumbers;
}

/// First comes the number of values, its own included.
int FixWall::pack_restart(int i, double* buffer) {
  buffer[0] = size_restart(i);
  std::copy_n(record_of(i), kRecordNumbers, buffer + 1);
  return size_restart(i);
}

void FixWall::unpack_restart(int i, int nth) {
  const double* values = atom->extra[i];
  for (int k = 0; k < nth; ++k) values += static_cast<int>(*values);
  std::copy_n(values + 1, kRecordNumbers, record_of(i));
}

int FixWall::size_restart(int) { return kRecordNumbers + 1; }

int FixWall::maxsize_restart() { return kRecordNumbers + 1; }

void FixWall::write_restart(FILE* file) {
  std::array<double, kNumbers + 1> saved{};
  MPI_Allreduce(here_.data(), saved.data(), static_cast<int>(kNumbers), MPI_DOUBLE, MPI_SUM, world);
  saved.back() = cell_.planes[0].offset;
  if (comm->me != 0) return;
  const int size = sizeof saved;
  std::fwrite(&size, sizeof size, 1, file);
  std::fwrite(saved.data(), sizeof saved, 1, file);
}

void FixWall::restart(char* bytes) {
  std::array<double, kNumbers + 1> saved;
  std::memcpy(saved.data(), bytes, sizeof saved);
  cell_.planes[0].offset = saved.back();
  if (comm->me == 0) std::copy_n(saved.begin(), kNumbers, here_.begin());
}

}  // namespace tangency::inline v0::lammps
