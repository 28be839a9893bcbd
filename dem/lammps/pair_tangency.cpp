// SPDX-License-Identifier: GPL-2.0-or-later
#include <tangency/dem/lammps/pair_tangency.hpp>

#include <atom.h>
#include <domain.h>
#include <error.h>
#include <force.h>
#include <memory.h>
#include <modify.h>
#include <mpi.h>
#include <neigh_list.h>
#include <neighbor.h>
#include <update.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <tangency/dem/contact/contact_blocks.hpp>
#include <tangency/dem/contact/coulomb_limit.hpp>
#include <tangency/dem/lanes/contact_lanes.hpp>
#include <tangency/geometry/curvature.hpp>
#include <tangency/geometry/ellipsoid.hpp>

namespace tangency::inline v0::lammps {
namespace {

/// How near a contact that is asked about again without a step has to be to what its record says,
/// in parts of its branch, to be the one of the record. Chosen: between rounding, of which a
/// restart moves places and turns, and what anybody would move by a command.
constexpr double kSameContact = 1e-9;

/// Parts of the work that are timed.
constexpr std::size_t kBodies = 0, kGather = 1, kKernel = 2, kLaw = 3;

bool is_same(const ContactRecord& before, const ContactRecord& now) {
  const double near = kSameContact * now.branch.norm();
  return before.touches() && now.touches() && (before.branch - now.branch).norm() <= near &&
         (before.arm - now.arm).norm() <= near && std::abs(before.overlap - now.overlap) <= near;
}

}  // namespace

/// What is the same for all pairs of a call.
struct PairTangency::Step {
  dem::BlockStep blocks;
  /// Contacts that nothing has moved keep their records: what a damper had pushed is not known
  /// without a step.
  bool keeps;
};

PairTangency::PairTangency(LAMMPS_NS::LAMMPS* lammps)
    : Pair(lammps),
      bodies_(lammps),
      history_id_("NEIGH_HISTORY_TANGENCY" + std::to_string(instance_me)) {
  single_enable = 1;
  single_extra = kPairColumns;
  svector = new double[kPairColumns]();
  restartinfo = 1;
  no_virial_fdotr_compute = 1;
  centroidstressflag = LAMMPS_NS::CENTROID_NOTAVAIL;
  finitecutflag = 1;
  nondefault_history_transfer = 1;
  nextra = static_cast<int>(work_.size() + seconds_.size());
  pvector = new double[work_.size() + seconds_.size()]();
  // Holds the history's place in the order of fixes until it is made.
  modify->add_fix(history_id_ + "_DUMMY all DUMMY");
}

PairTangency::~PairTangency() {
  delete[] svector;
  delete[] pvector;
  modify->delete_fix(history_ == nullptr ? history_id_ + "_DUMMY" : history_id_);
  if (!allocated) return;
  memory->destroy(setflag);
  memory->destroy(cutsq);
}

void PairTangency::allocate() {
  allocated = 1;
  const int types = atom->ntypes;
  memory->create(setflag, types + 1, types + 1, "pair:setflag");
  memory->create(cutsq, types + 1, types + 1, "pair:cutsq");
  for (int i = 0; i <= types; ++i) std::fill_n(setflag[i], types + 1, 0);
  laws_.types = static_cast<std::size_t>(types);
  laws_.law.resize(laws_.types * laws_.types);
}

PairTangency::Step PairTangency::step() {
  // Without a step before, as in setup() and in a minimisation, no time has passed.
  const bool moves = update->setupflag == 0 && update->whichflag == 1;
  const double dt = moves ? update->dt : 0.0;
  Mat3 rate = Mat3::Zero();
  if (!moves)
    box_.start(*domain);
  else
    rate = box_.advance(*domain, dt);
  if (domain->deform_vremap != 0) rate.setZero();
  rate_ = rate;
  const bool damped = laws_.dissipate();
  // A record may have a shear force of a law before.
  return {{bodies_.particles(), bodies_.narrow_phase(), laws_, bodies_.motion(), dt, rate, true,
           damped},
          damped && !moves && !laws_are_new_};
}

void PairTangency::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  const bool listed_anew = neighbor->ago == 0;
  if (listed_anew) require_room(neighbor->cutneighmax - neighbor->skin);
  if (is_timed_) lap_began_ = MPI_Wtime();
  bodies_.refresh(listed_anew);
  lap(kBodies);
  history_->change();
  const Step now = step();
  affine_stiffness_ = 0.0;
  collect(now);
  finish(within_, now, 1.0);
  // The rank of the other atom has the pair too.
  finish(across_, now, 0.5);
  laws_are_new_ = false;
  std::copy(seconds_.begin(), seconds_.end(), std::copy(work_.begin(), work_.end(), pvector));
}

/// A part of the work ends here.
void PairTangency::lap(std::size_t part) {
  if (!is_timed_) return;
  const double now = MPI_Wtime();
  seconds_[part] += now - lap_began_;
  lap_began_ = now;
}

void PairTangency::collect(const Step& step) {
  const bool newton = force->newton_pair != 0;
  for (int ii = 0; ii < list->inum; ++ii) {
    const int i = list->ilist[ii];
    const Vec3 at = Vec3::Map(atom->x[i]);
    const double reach = bodies_.reach_of(i);
    int* const flags = history_->firstflag[i];
    double* const records = history_->firstvalue[i];
    for (int jj = 0; jj < list->numneigh[i]; ++jj) {
      const int j = list->firstneigh[i][jj] & NEIGHMASK;
      const Vec3 branch = Vec3::Map(atom->x[j]) - at;
      const double both = reach + bodies_.reach_of(j);
      double* const record = records + kRecordNumbers * jj;
      if (!(branch.squaredNorm() < both * both)) {
        if (flags[jj] != 0) std::fill_n(record, kRecordNumbers, 0.0);
        flags[jj] = 0;
        continue;
      }
      flags[jj] = 1;
      PairBlock& block = newton || j < atom->nlocal ? within_ : across_;
      if (atom->tag[i] < atom->tag[j])
        block.add({i, j, record}, {bodies_.body_of(i), bodies_.body_of(j)}, branch);
      else
        block.add({j, i, record}, {bodies_.body_of(j), bodies_.body_of(i)}, -branch);
      if (block.is_full()) finish(block, step, &block == &within_ ? 1.0 : 0.5);
    }
  }
}

/// Asks about the pairs of a block and empties it.
/// @param weight  of its works
void PairTangency::finish(PairBlock& pairs, const Step& step, double weight) {
  const std::size_t count = pairs.size();
  if (count == 0) return;
  lap(kGather);
  dem::ContactBlock block = pairs.block();
  bodies_.narrow_phase().measure(count, std::span(pairs.normals(), count), branch_, accuracy_,
                                 pairs.geometry());
  lap(kKernel);
  step_block(step.blocks, pairs.geometry(), block);
  const dem::BlockSums& sums = pairs.sums();
  work_[0] += weight * sums.sliding;
  work_[1] += weight * sums.boundary;
  work_[2] += weight * sums.branch;
  work_[3] += weight * sums.viscous;
  affine_stiffness_ += weight * sums.affine_stiffness;
  if (step.keeps) {
    for (std::size_t k = 0; k < count; ++k)
      if (const ContactRecord before = record_at(pairs.atoms(k).history);
          is_same(before, pairs.record(k)))
        pairs.put(k, before);
    restored_lanes(block);
  }
  pairs.write_back();
  for (std::size_t k = 0; k < count; ++k)
    if (pairs.touches(k)) apply(pairs, k);
  pairs.clear();
  lap(kLaw);
}

/// Gives the force of a pair to its atoms and to what is tallied.
void PairTangency::apply(const PairBlock& pairs, std::size_t k) {
  const auto [a, b, history] = pairs.atoms(k);
  const bool newton = force->newton_pair != 0;
  const Vec3& on_b = pairs.force(k);
  if (newton || a < atom->nlocal) {
    Vec3::Map(atom->f[a]) -= on_b;
    Vec3::Map(atom->torque[a]) += pairs.moment_a(k);
  }
  if (newton || b < atom->nlocal) {
    Vec3::Map(atom->f[b]) += on_b;
    Vec3::Map(atom->torque[b]) += pairs.moment_b(k);
  }
  if (evflag == 0) return;
  const ContactRecord now = pairs.record(k);
  ev_tally(a, b, atom->nlocal, force->newton_pair, now.normal_energy + now.shear_energy, 0.0, 0.0,
           0.0, 0.0, 0.0);
  if (vflag_either == 0) return;
  const Vec3& d = now.branch;
  v_tally_tensor(a, b, atom->nlocal, force->newton_pair, d[0] * on_b[0], d[1] * on_b[1],
                 d[2] * on_b[2], 0.5 * (d[0] * on_b[1] + d[1] * on_b[0]),
                 0.5 * (d[0] * on_b[2] + d[2] * on_b[0]), 0.5 * (d[1] * on_b[2] + d[2] * on_b[1]));
}

/// The record of a listed pair, in any order; null where it is not listed.
const double* PairTangency::history_of(int i, int j) const {
  if (i >= atom->nlocal) return nullptr;
  for (int jj = 0; jj < list->numneigh[i]; ++jj)
    if ((list->firstneigh[i][jj] & NEIGHMASK) == j)
      return history_->firstvalue[i] + kRecordNumbers * jj;
  return nullptr;
}

/// Of j's body relative to i's at their contact, spins and the strain of the box in it, when forces
/// were last computed.
/// @param side  1 where the record's a is i, else -1
Vec3 PairTangency::velocity_at(int i, int j, const ContactRecord& record, double side) const {
  const auto at = [this](int k, const Vec3& arm) -> Vec3 {
    const dem::MotionRow& row = bodies_.motion()[bodies_.body_of(k)];
    return Vec3::Map(row.velocity) + Vec3::Map(row.spin).cross(arm);
  };
  const Vec3 from_a = record.arm, from_b = record.arm - record.branch;
  const bool in_order = side > 0.0;
  return at(j, in_order ? from_b : from_a) - at(i, in_order ? from_a : from_b) +
         side * (rate_ * record.branch);
}

/// Of the distance of the two surfaces at the contact, the smaller one first, 1/length.
std::array<double, 2> PairTangency::curvatures(int i, int j, const ContactRecord& record) const {
  const auto body = [this](int of) {
    const std::size_t k = bodies_.body_of(of);
    return Ellipsoid(Vec3::Zero(), bodies_.particles().semi_axes[k],
                     bodies_.particles().orientation[k]);
  };
  // Ellipsoids look the same from both ends: the normal's sign does not matter.
  const PrincipalCurvatures relative = contact_curvature(body(i), body(j), record.normal).relative;
  return {relative.curvature[1], relative.curvature[0]};
}

double PairTangency::single(int i, int j, int itype, int jtype, double rsq, double, double,
                            double& fforce) {
  std::fill_n(svector, kPairColumns, 0.0);
  fforce = 0.0;
  const double* history = history_of(i, j);
  if (history == nullptr) history = history_of(j, i);
  if (history == nullptr) return 0.0;
  const ContactRecord record = record_at(history);
  if (!record.touches()) return 0.0;
  // As seen from i: a's side, or that of b.
  const double side = atom->tag[i] < atom->tag[j] ? 1.0 : -1.0;
  const Vec3 arm = side > 0.0 ? record.arm : Vec3(record.arm - record.branch);
  const Vec3 shear = -side * record.shear_force, all = -side * record.force();
  const Vec3 branch = side * record.branch, normal = side * record.normal;
  const Vec3 velocity = velocity_at(i, j, record, side);
  const std::array<double, 2> curvature = curvatures(i, j, record);
  const bool at_limit = slides(law_between(itype, jtype), record.normal_force, shear.norm());
  const double columns[] = {shear[0],
                            shear[1],
                            shear[2],
                            shear.norm(),
                            record.normal_force,
                            normal[0],
                            normal[1],
                            normal[2],
                            arm[0],
                            arm[1],
                            arm[2],
                            branch[0],
                            branch[1],
                            branch[2],
                            record.overlap,
                            record.normal_stiffness,
                            record.normal_energy,
                            record.shear_energy,
                            all[0],
                            all[1],
                            all[2],
                            at_limit ? 1.0 : 0.0,
                            velocity[0],
                            velocity[1],
                            velocity[2],
                            curvature[0],
                            curvature[1]};
  static_assert(std::size(columns) == kPairColumns);
  std::copy(std::begin(columns), std::end(columns), svector);
  fforce = -all.dot(branch) / rsq;
  return record.normal_energy + record.shear_energy;
}

void* PairTangency::extract(const char* name, int& dimension) {
  dimension = 0;
  return std::string_view(name) == "affine_stiffness" ? &affine_stiffness_ : nullptr;
}

void PairTangency::for_each_contact(const std::function<void(const SeenContact&)>& look) const {
  const bool newton = force->newton_pair != 0;
  for (int ii = 0; ii < list->inum; ++ii) {
    const int i = list->ilist[ii];
    for (int jj = 0; jj < list->numneigh[i]; ++jj) {
      const int j = list->firstneigh[i][jj] & NEIGHMASK;
      const bool in_order = atom->tag[i] < atom->tag[j];
      // Without newton's third law two ranks have it.
      if (!newton && j >= atom->nlocal && !in_order) continue;
      const ContactRecord record = record_at(history_->firstvalue[i] + kRecordNumbers * jj);
      if (!record.touches()) continue;
      look({in_order ? i : j, in_order ? j : i, record.normal, record.branch, record.force()});
    }
  }
}

void PairTangency::transfer_history(double* source, double* target) {
  std::copy_n(source, kRecordNumbers, target);
}

void PairTangency::transfer_history(double* source, double* target, int, int) {
  transfer_history(source, target);
}

double PairTangency::memory_usage() {
  return Pair::memory_usage() + bodies_.memory_usage() + 2.0 * sizeof(PairBlock);
}

}  // namespace tangency::inline v0::lammps
