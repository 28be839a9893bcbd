// SPDX-License-Identifier: GPL-2.0-or-later
#include <tangency/dem/lammps/fix_move.hpp>

#include <atom.h>
#include <comm.h>
#include <domain.h>
#include <error.h>
#include <fix_deform.h>
#include <modify.h>
#include <update.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include <tangency/dem/lammps/atom_bodies.hpp>
#include <tangency/dem/lammps/host.hpp>
#include <tangency/dem/lammps/words.hpp>
#include <tangency/dem/particles.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::lammps {
namespace {

using dem::kChunk;

constexpr const char* kCommand = "fix tangency/move";

Eigen::Map<const Vec3> at(const double* numbers) { return Eigen::Map<const Vec3>(numbers); }

/// Of a quaternion that is a unit but for rounding, which is not left in the rotation: momenta and
/// spins go to and fro every step, and it would add up.
Mat3 rotation_of(const Quaternion& q) {
  const Mat3 rotation = q.toRotationMatrix();
  return Mat3::Identity() + (rotation - Mat3::Identity()) / q.squaredNorm();
}

/// What a restart keeps.
struct Saved {
  double lost, mixing, downhill;
  BoxMotion::Edges edges;
  std::array<double, 3> low;
};

Vec3 low_corner(const LAMMPS_NS::Domain& domain) { return Vec3::Map(domain.boxlo); }

/// Does a fix deform move particles, or their velocities, with the box?
bool moves_particles(const LAMMPS_NS::Fix& deform) {
  return static_cast<const LAMMPS_NS::FixDeform&>(deform).remapflag != LAMMPS_NS::Domain::NO_REMAP;
}

dem::Rotation rotation_named(Words& words) {
  const std::string name = words.next("rotation");
  if (name == "full") return dem::Rotation::full;
  if (name == "simplified") return dem::Rotation::simplified;
  if (name != "none") words.refuse("rotation", name, "full, simplified or none");
  return dem::Rotation::none;
}

}  // namespace

/// Some of the particles, in the columns of dem/lanes/particle_lanes.hpp.
struct FixMove::Chunk {
  std::size_t count = 0;
  std::array<int, kChunk> atom;
  std::array<double, 3 * kChunk> position, velocity, spin, semi_axes, force, moment;
  std::array<double, 4 * kChunk> orientation;
  std::array<double, kChunk> mass;

  /// @param low  where positions count from
  void add(const LAMMPS_NS::Atom& atoms, const LAMMPS_NS::AtomVecEllipsoid& bodies, int i,
           const Vec3& low) {
    const Body& body = body_at(bodies, atoms.ellipsoid[i]);
    atom[count] = i;
    mass[count] = atoms.rmass[i];
    const Quaternion turn(body.quat[0], body.quat[1], body.quat[2], body.quat[3]);
    const Vec3 axes = at(body.shape);
    const Mat3 rotation = rotation_of(turn);
    const Vec3 inertia = dem::principal_inertia(mass[count], axes);
    const Vec3 momentum = rotation.transpose() * at(atoms.angmom[i]);
    put(position, at(atoms.x[i]) - low);
    put(velocity, at(atoms.v[i]));
    put(spin, rotation * momentum.cwiseQuotient(inertia));
    put(semi_axes, axes);
    put(force, at(atoms.f[i]));
    put(moment, at(atoms.torque[i]));
    Eigen::Map<Eigen::Vector4d>(orientation.data() + 4 * count) = turn.coeffs();
    ++count;
  }

  /// Writes back what moved. @param low  where positions count from now
  void take_back(LAMMPS_NS::Atom& atoms, const LAMMPS_NS::AtomVecEllipsoid& bodies,
                 const Vec3& low) const {
    for (std::size_t k = 0; k < count; ++k) {
      const int i = atom[k];
      const double* q = orientation.data() + 4 * k;
      const double wxyz[] = {q[3], q[0], q[1], q[2]};
      std::copy_n(wxyz, 4, body_at(bodies, atoms.ellipsoid[i]).quat);
      std::copy_n(Vec3(at(position.data() + 3 * k) + low).data(), 3, atoms.x[i]);
    }
    take_back_velocities(atoms);
  }

  /// Of these the velocities alone, where nothing else moved.
  void take_back_velocities(LAMMPS_NS::Atom& atoms) const {
    for (std::size_t k = 0; k < count; ++k) {
      const double* q = orientation.data() + 4 * k;
      const Mat3 rotation = rotation_of(Quaternion(q[3], q[0], q[1], q[2]));
      const Vec3 inertia = dem::principal_inertia(mass[k], at(semi_axes.data() + 3 * k));
      const Vec3 momentum =
          rotation * inertia.cwiseProduct(rotation.transpose() * at(spin.data() + 3 * k));
      std::copy_n(velocity.data() + 3 * k, 3, atoms.v[atom[k]]);
      std::copy_n(momentum.data(), 3, atoms.angmom[atom[k]]);
    }
  }

  detail::ParticleColumns columns() const {
    return {velocity.data(), spin.data(),  orientation.data(), semi_axes.data(),
            mass.data(),     force.data(), moment.data(),      false};
  }
  detail::MovedColumns moved() {
    return {position.data(), velocity.data(), spin.data(), orientation.data()};
  }

 private:
  void put(std::array<double, 3 * kChunk>& column, const Vec3& value) {
    std::copy_n(value.data(), 3, column.data() + 3 * count);
  }
};

FixMove::FixMove(LAMMPS_NS::LAMMPS* lammps, int count, char** arguments)
    : Fix(lammps, count, arguments) {
  Words words(lammps, kCommand, count, arguments, 3);
  while (words.any()) {
    const std::string key = words.next("a keyword");
    if (key == "damping") {
      if (words.skip("fire"))
        fire_.emplace();
      else
        motion_.damping = words.not_negative(key);
    } else if (key == "rotational") {
      motion_.rotational_damping = words.not_negative(key);
    } else if (key == "rotation") {
      motion_.rotation = rotation_named(words);
    } else if (key == "affine") {
      is_affine_ = words.yes(key);
    } else {
      words.refuse("keyword", key, "damping, rotational, rotation or affine");
    }
  }
  if (fire_ && (motion_.damping > 0.0 || motion_.rotational_damping))
    words.refuse("damping fire: not together with a rate of damping");
  bodies_ = AtomBodies::ellipsoids(lammps);
  if (bodies_ == nullptr || atom->rmass_flag == 0) words.refuse("needs atom_style ellipsoid");
  if (domain->dimension != 3) words.refuse("needs dimension 3");
  time_integrate = 1;
  restart_global = 1;
  vector_flag = 1;
  size_vector = 3;
  global_freq = 1;
  extvector = 1;
}

int FixMove::setmask() {
  return LAMMPS_NS::FixConst::INITIAL_INTEGRATE | LAMMPS_NS::FixConst::POST_RUN;
}

void FixMove::init() {
  int bare = 0;
  for (int i = 0; i < atom->nlocal; ++i) {
    if ((atom->mask[i] & groupbit) == 0) continue;
    if (atom->ellipsoid[i] < 0)
      bare = 1;
    else if (!is_ellipsoid(*bodies_, atom->ellipsoid[i]))
      error->one(FLERR, "fix tangency/move: atom " + std::to_string(atom->tag[i]) + kNoEllipsoid);
  }
  int any = 0;
  MPI_Allreduce(&bare, &any, 1, MPI_INT, MPI_MAX, world);
  if (any != 0)
    error->all(FLERR, "fix tangency/move: atoms of the group are points: ellipsoids alone");
  const double fastest =
      std::max(motion_.damping, motion_.rotational_damping.value_or(motion_.damping));
  if (fastest * update->dt > 2.0)
    error->all(FLERR, "fix tangency/move: damping times timestep = " +
                          std::to_string(fastest * update->dt) +
                          ": at most 2, a step that damps more would turn velocities round");
  if (is_affine_) require_nobody_else_follows_the_box();
}

void FixMove::require_nobody_else_follows_the_box() {
  bool is_behind = false;
  for (int k = 0; k < modify->nfix; ++k) {
    const Fix* const other = modify->fix[k];
    const std::string name = other->style;
    if (other == this) is_behind = true;
    if (name == "tangency/servo" && is_behind)
      error->all(FLERR, "fix tangency/move: stands before fix tangency/servo: define it after it");
    if (name == "tangency/move" || name == "tangency/servo") continue;
    if ((other->box_change & (BOX_CHANGE_SIZE | BOX_CHANGE_SHAPE)) == 0) continue;
    if (name == "deform" && !moves_particles(*other)) continue;
    error->all(FLERR, "fix tangency/move: fix " + name +
                          " moves particles with the box: `affine no`, or fix deform with "
                          "`remap none`");
  }
}

void FixMove::setup(int) {
  if (is_restarted_) {
    is_restarted_ = false;
    return;
  }
  box_.start(*domain);
  low_ = low_corner(*domain);
}

template <class F>
void FixMove::for_each_chunk(const F& f) {
  Chunk chunk;
  for (int i = 0; i < atom->nlocal; ++i) {
    if ((atom->mask[i] & groupbit) == 0) continue;
    chunk.add(*atom, *bodies_, i, low_);
    if (chunk.count < kChunk) continue;
    f(chunk);
    chunk.count = 0;
  }
  if (chunk.count > 0) f(chunk);
}

detail::InertiaProducts FixMove::products() {
  const Vec3 weightless = Vec3::Zero();
  detail::InertiaProducts here;
  for_each_chunk([&](Chunk& chunk) {
    here += detail::inertia_products_lanes(chunk.columns(), weightless.data(),
                                           motion_.rotation != dem::Rotation::none, 0, chunk.count);
  });
  const double of_rank[] = {here.vv, here.va, here.aa};
  double of_all[3];
  MPI_Allreduce(of_rank, of_all, 3, MPI_DOUBLE, MPI_SUM, world);
  return {of_all[0], of_all[1], of_all[2]};
}

void FixMove::steer() {
  const detail::InertiaProducts sum = products();
  const dem::Fire::Turn turn = fire_->turn_by(sum);
  const Vec3 weightless = Vec3::Zero();
  for_each_chunk([&](Chunk& chunk) {
    detail::steer_lanes(chunk.columns(), chunk.moved(), turn.keep, turn.push, weightless.data(),
                        motion_.rotation != dem::Rotation::none, 0, chunk.count);
    chunk.take_back_velocities(*atom);
  });
  if (comm->me == 0) lost_ += turn.taken(sum, update->dt);
}

void FixMove::initial_integrate(int) {
  const double dt = update->dt;
  if (fire_) steer();
  const Mat3 rate = is_affine_ ? box_.advance(*domain, dt) : Mat3(Mat3::Zero());
  const detail::MotionStep step = dem::step_of(motion_, rate, dt);
  const Vec3 low = is_affine_ ? low_corner(*domain) : low_;
  for_each_chunk([&](Chunk& chunk) {
    const detail::MovedSum sum =
        detail::move_lanes(chunk.columns(), chunk.moved(), step, 0, chunk.count);
    if (sum.blown_up)
      error->one(FLERR,
                 "fix tangency/move: the run blew up: a particle's velocity is no longer finite");
    lost_ += sum.damping;
    chunk.take_back(*atom, *bodies_, low);
  });
  low_ = low;
}

void FixMove::post_run() {
  if (!is_affine_) return;
  const Mat3 strain = box_.advance(*domain, 1.0);
  const Vec3 low = low_corner(*domain);
  if (strain.isZero(0.0) && low == low_) return;
  for (int i = 0; i < atom->nlocal; ++i) {
    if ((atom->mask[i] & groupbit) == 0) continue;
    const Vec3 place = at(atom->x[i]) - low_;
    Vec3::Map(atom->x[i]) = place + strain * place + low;
  }
  low_ = low;
}

double FixMove::compute_vector(int entry) {
  if (summed_at_ != update->ntimestep) {
    summed_at_ = update->ntimestep;
    const detail::InertiaProducts sum = products();
    double lost = 0.0;
    MPI_Allreduce(&lost_, &lost, 1, MPI_DOUBLE, MPI_SUM, world);
    sums_ = {lost, 0.5 * sum.vv + 0.5 * update->dt * sum.va, 0.5 * sum.vv};
  }
  return sums_[static_cast<std::size_t>(entry)];
}

void FixMove::write_restart(FILE* file) {
  Saved saved{};
  MPI_Allreduce(&lost_, &saved.lost, 1, MPI_DOUBLE, MPI_SUM, world);
  const dem::Fire fire = fire_.value_or(dem::Fire{});
  saved.mixing = fire.mixing;
  saved.downhill = static_cast<double>(fire.downhill);
  saved.edges = box_.edges();
  std::copy_n(low_.data(), 3, saved.low.data());
  if (comm->me != 0) return;
  const int size = sizeof saved;
  std::fwrite(&size, sizeof size, 1, file);
  std::fwrite(&saved, sizeof saved, 1, file);
}

void FixMove::restart(char* bytes) {
  Saved saved{};
  std::memcpy(&saved, bytes, sizeof saved);
  lost_ = comm->me == 0 ? saved.lost : 0.0;
  box_.start(saved.edges);
  low_ = Vec3::Map(saved.low.data());
  is_restarted_ = true;
  if (fire_) *fire_ = {saved.mixing, static_cast<std::int64_t>(saved.downhill)};
}

}  // namespace tangency::inline v0::lammps
