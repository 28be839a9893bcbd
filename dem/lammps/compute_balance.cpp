// SPDX-License-Identifier: GPL-2.0-or-later
#include <tangency/dem/lammps/compute_balance.hpp>

#include <atom.h>
#include <atom_vec_ellipsoid.h>
#include <comm.h>
#include <error.h>
#include <force.h>
#include <update.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include <tangency/dem/lammps/atom_bodies.hpp>
#include <tangency/dem/lammps/contact_source.hpp>
#include <tangency/dem/lammps/host.hpp>
#include <tangency/dem/lammps/words.hpp>

namespace tangency::inline v0::lammps {
namespace {

constexpr int kNumbers = 7;

double length(const double* v) { return Eigen::Map<const Vec3>(v).norm(); }

}  // namespace

ComputeBalance::ComputeBalance(LAMMPS_NS::LAMMPS* lammps, int count, char** arguments)
    : Compute(lammps, count, arguments) {
  Words words(lammps, "compute tangency/balance", count, arguments, 3);
  while (words.any()) {
    const std::string key = words.next("a keyword");
    if (key != "least") words.refuse("keyword", key, "least");
    least_ = words.positive(key);
  }
  if (AtomBodies::ellipsoids(lammps) == nullptr) words.refuse("needs atom_style ellipsoid");
  vector_flag = 1;
  size_vector = kNumbers;
  extvector = 0;
  comm_reverse = 1;
  vector = new double[kNumbers];
}

ComputeBalance::~ComputeBalance() { delete[] vector; }

void ComputeBalance::init() {
  if (ContactSource::of(*force) == nullptr)
    error->all(FLERR, "compute tangency/balance: the pair style does not tell its contacts");
}

void ComputeBalance::compute_vector() {
  invoked_vector = update->ntimestep;
  contacts_.assign(static_cast<std::size_t>(atom->nlocal + atom->nghost), 0.0);
  // Contacts; sums of their forces and of resultants; particles with contacts, rattlers; contacts
  // of the others.
  std::array<double, 6> here{}, sum{};
  ContactSource::of(*force)->for_each_contact([&](const SeenContact& contact) {
    here[0] += 1.0;
    here[1] += contact.force.norm();
    contacts_[static_cast<std::size_t>(contact.a)] += 1.0;
    contacts_[static_cast<std::size_t>(contact.b)] += 1.0;
  });
  add_ghosts_to_atoms(*comm, this);
  const LAMMPS_NS::AtomVecEllipsoid& bodies = *AtomBodies::ellipsoids(lmp);
  std::array<double, 2> largest_here{}, largest{};
  for (int i = 0; i < atom->nlocal; ++i) {
    const double contacts = contacts_[static_cast<std::size_t>(i)];
    const bool rattles = contacts < least_;
    here[4] += rattles ? 1.0 : 0.0;
    here[5] += rattles ? 0.0 : contacts;
    if (contacts == 0.0 || atom->ellipsoid[i] < 0) continue;
    const double* axes = body_at(bodies, atom->ellipsoid[i]).shape;
    const double resultant = length(atom->f[i]);
    here[2] += resultant;
    here[3] += 1.0;
    largest_here[0] = std::max(largest_here[0], resultant);
    largest_here[1] =
        std::max(largest_here[1], length(atom->torque[i]) / *std::max_element(axes, axes + 3));
  }
  MPI_Allreduce(here.data(), sum.data(), static_cast<int>(sum.size()), MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(largest_here.data(), largest.data(), 2, MPI_DOUBLE, MPI_MAX, world);
  const auto particles = static_cast<double>(atom->natoms);
  const double others = particles - sum[4];
  std::fill_n(vector, kNumbers, 0.0);
  vector[0] = sum[0];
  vector[5] = sum[4];
  vector[6] = others > 0.0 ? sum[5] / others : 0.0;
  if (!(sum[1] > 0.0)) return;
  const double mean = sum[1] / sum[0];
  vector[1] = mean;
  vector[2] = sum[2] / sum[3] / mean;
  vector[3] = largest[0] / mean;
  vector[4] = largest[1] / mean;
}

int ComputeBalance::pack_reverse_comm(int count, int first, double* buffer) {
  std::copy_n(contacts_.begin() + first, count, buffer);
  return count;
}

void ComputeBalance::unpack_reverse_comm(int count, int* atoms, double* buffer) {
  for (int k = 0; k < count; ++k) contacts_[static_cast<std::size_t>(atoms[k])] += buffer[k];
}

}  // namespace tangency::inline v0::lammps
