// SPDX-License-Identifier: GPL-2.0-or-later
#include <tangency/dem/lammps/atom_bodies.hpp>

#include <atom.h>
#include <atom_vec_ellipsoid.h>
#include <domain.h>
#include <error.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <tangency/dem/lammps/host.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::lammps {
namespace {

bool are_finite(const double* numbers, int count) {
  return std::all_of(numbers, numbers + count, [](double x) { return std::isfinite(x); });
}

double largest_of(const double* shape) { return std::max({shape[0], shape[1], shape[2]}); }

}  // namespace

LAMMPS_NS::AtomVecEllipsoid* AtomBodies::ellipsoids(LAMMPS_NS::LAMMPS* lammps) {
  return dynamic_cast<LAMMPS_NS::AtomVecEllipsoid*>(lammps->atom->style_match("ellipsoid"));
}

Vec3 AtomBodies::spin_of(const Vec3& momentum, const Quaternion& turn, double mass,
                         const Vec3& axes) {
  const Vec3 along = turn.conjugate() * momentum;
  return turn * Vec3(along.cwiseQuotient(dem::principal_inertia(mass, axes)));
}

std::vector<double> AtomBodies::reach_by_type(LAMMPS_NS::LAMMPS* lammps) {
  const LAMMPS_NS::Atom& atoms = *lammps->atom;
  const LAMMPS_NS::AtomVecEllipsoid& from = *ellipsoids(lammps);
  std::vector<double> here(static_cast<std::size_t>(atoms.ntypes) + 1, 0.0), all(here);
  for (int i = 0; i < atoms.nlocal; ++i) {
    if (atoms.ellipsoid[i] < 0) continue;
    double& largest = here[static_cast<std::size_t>(atoms.type[i])];
    largest = std::max(largest, largest_of(body_at(from, atoms.ellipsoid[i]).shape));
  }
  MPI_Allreduce(here.data(), all.data(), static_cast<int>(here.size()), MPI_DOUBLE, MPI_MAX,
                lammps->world);
  return all;
}

void AtomBodies::refresh(bool listed_anew) {
  const auto atoms = static_cast<std::size_t>(atom->nlocal + atom->nghost);
  if (listed_anew || body_.size() != atoms) place();
  const LAMMPS_NS::AtomVecEllipsoid& from = *ellipsoids(lmp);
  for (std::size_t k = 0; k < atom_.size(); ++k) take(k, from);
  narrow_phase_.aim(particles_);
  narrow_phase_.refresh(particles_, 0, particles_.size());
}

/// Which atoms share a body.
void AtomBodies::place() {
  const int owned = atom->nlocal, all = owned + atom->nghost;
  const bool shared = atom->map_style != LAMMPS_NS::Atom::MAP_NONE && domain->deform_vremap == 0;
  body_.clear();
  atom_.clear();
  for (int i = 0; i < all; ++i) {
    const int owner = i >= owned && shared ? atom->map(atom->tag[i]) : i;
    if (owner >= 0 && owner < owned && owner != i) {
      body_.push_back(static_cast<std::uint32_t>(owner));
      continue;
    }
    body_.push_back(static_cast<std::uint32_t>(atom_.size()));
    atom_.push_back(i);
  }
  const std::size_t count = atom_.size();
  reach_.resize(count);
  motion_.resize(count);
  particles_.position.resize(count, Vec3::Zero());
  particles_.orientation.resize(count);
  particles_.semi_axes.resize(count);
  particles_.mass.resize(count);
  particles_.type.resize(count);
}

const char* AtomBodies::fault_of(const LAMMPS_NS::Atom& atoms,
                                 const LAMMPS_NS::AtomVecEllipsoid& from, int i) {
  if (atoms.ellipsoid[i] < 0) return " is no ellipsoid: give it three diameters, all > 0";
  if (!is_ellipsoid(from, atoms.ellipsoid[i])) return kNoEllipsoid;
  const Body& bonus = body_at(from, atoms.ellipsoid[i]);
  const double* const q = bonus.quat;
  if (!are_finite(atoms.x[i], 3) || !are_finite(atoms.v[i], 3) || !are_finite(atoms.angmom[i], 3) ||
      !are_finite(q, 4))
    return " has a place, a turn or a motion that is no finite number: is the time step too long?";
  if (!(atoms.rmass[i] > 0.0) || !std::isfinite(atoms.rmass[i]))
    return " has a mass that is not > 0 and finite";
  // LAMMPS keeps it at length 1, to rounding: one that is much shorter was never set. Chosen.
  if (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] < 0x1p-40)
    return " has the quaternion 0, which is no orientation";
  for (const double axis : bonus.shape)
    if (!(axis > 0.0) || !std::isfinite(axis)) return " has a diameter that is not > 0 and finite";
  return nullptr;
}

void AtomBodies::take(std::size_t body, const LAMMPS_NS::AtomVecEllipsoid& from) {
  const int i = atom_[body];
  if (const char* const fault = fault_of(*atom, from, i))
    error->one(FLERR, "Pair style tangency: atom " + std::to_string(atom->tag[i]) + fault);
  const Body& bonus = body_at(from, atom->ellipsoid[i]);
  const double* const q = bonus.quat;
  const double *const v = atom->v[i], *const l = atom->angmom[i];
  const Vec3 axes(bonus.shape[0], bonus.shape[1], bonus.shape[2]);
  const Quaternion turn(q[0], q[1], q[2], q[3]);
  reach_[body] = largest_of(bonus.shape);
  particles_.semi_axes[body] = axes;
  particles_.orientation[body] = turn;
  particles_.mass[body] = atom->rmass[i];
  particles_.type[body] = atom->type[i] - 1;
  const Vec3 spin = spin_of(Vec3(l[0], l[1], l[2]), turn, atom->rmass[i], axes);
  motion_[body] = {{v[0], v[1], v[2]}, 0.0, {spin[0], spin[1], spin[2]}, 0.0};
}

double AtomBodies::memory_usage() const {
  // The rows that geometry keeps of a body that is asked about in double alone: moving_bodies.hpp.
  constexpr double kRows = 224.0;
  const double columns = sizeof(dem::MotionRow) + 2.0 * sizeof(Vec3) + sizeof(Quaternion) +
                         2.0 * sizeof(double) + 2.0 * sizeof(std::int32_t);
  return static_cast<double>(atom_.size()) * (columns + kRows) +
         static_cast<double>(body_.size() * sizeof(std::uint32_t));
}

}  // namespace tangency::inline v0::lammps
