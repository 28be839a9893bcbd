// SPDX-License-Identifier: GPL-2.0-or-later
#include <tangency/dem/lammps/contact_record.hpp>

#include <cstddef>
#include <cstring>

namespace tangency::inline v0::lammps {
namespace {

/// Not known.
const ContactRecord kNoRecord{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), 0.0,
                              0.0,          0.0,          0.0,          0.0,          0.0};

}  // namespace
ContactRecord record_at(const double* history) {
  ContactRecord record;
  std::memcpy(static_cast<void*>(&record), history, sizeof record);
  return record;
}

void PairBlock::add(const Atoms& atoms, const IndexedPair& bodies, const Vec3& branch) {
  atoms_[count_] = atoms;
  geometry_.pairs[count_] = bodies;
  geometry_.branch[count_] = branch;
  put(count_, record_at(atoms.history));
  ++count_;
}

void PairBlock::put(std::size_t k, const ContactRecord& record) {
  normal_[k] = record.normal;
  branch_[k] = record.branch;
  arm_[k] = record.arm;
  shear_force_[k] = record.shear_force;
  overlap_[k] = record.overlap;
  normal_force_[k] = record.normal_force;
  normal_stiffness_[k] = record.normal_stiffness;
  normal_energy_[k] = record.normal_energy;
  shear_stiffness_[k] = record.shear_stiffness;
  shear_energy_[k] = record.shear_energy;
}

ContactRecord PairBlock::record(std::size_t k) const {
  return {normal_[k],           branch_[k],        arm_[k],
          shear_force_[k],      overlap_[k],       normal_force_[k],
          normal_stiffness_[k], normal_energy_[k], shear_stiffness_[k],
          shear_energy_[k]};
}

dem::ContactBlock PairBlock::block() {
  for (std::size_t k = count_; k < dem::kPairBlock; ++k) put(k, kNoRecord);
  dem::ContactBlock block{};
  block.count = count_;
  block.state = {normal_[0].data(),        branch_[0].data(),     arm_[0].data(),
                 shear_force_[0].data(),   overlap_.data(),       normal_force_.data(),
                 normal_stiffness_.data(), normal_energy_.data(), shear_stiffness_.data(),
                 shear_energy_.data()};
  block.force = force_[0].data();
  block.moment_a = moment_a_[0].data();
  block.moment_b = moment_b_[0].data();
  block.sums = &sums_;
  return block;
}

void PairBlock::write_back() const {
  for (std::size_t k = 0; k < count_; ++k) {
    const ContactRecord now = record(k);
    std::memcpy(atoms_[k].history, static_cast<const void*>(&now), sizeof now);
  }
}

}  // namespace tangency::inline v0::lammps
