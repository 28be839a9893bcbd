// SPDX-License-Identifier: GPL-2.0-or-later
// What a PairTangency is told: the words of its commands, a restart file, and what it needs of the
// host before a run.
#include <atom.h>
#include <comm.h>
#include <domain.h>
#include <error.h>
#include <force.h>
#include <modify.h>
#include <mpi.h>
#include <neighbor.h>
#include <update.h>
#include <utils.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

#include <tangency/dem/lammps/fix_contact_history.hpp>
#include <tangency/dem/lammps/pair_coefficients.hpp>
#include <tangency/dem/lammps/pair_tangency.hpp>
#include <tangency/dem/lammps/words.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>

namespace tangency::inline v0::lammps {

void PairTangency::settings(int count, char** words) {
  branch_ = dem::Branch::follow;
  accuracy_ = Accuracy::certified();
  is_timed_ = false;
  for (int k = 0; k < count; k += 2) {
    const std::string key = words[k];
    if (key != "branch" && key != "accuracy" && key != "timing")
      error->all(FLERR,
                 "Pair style tangency: word = " + key + ": branch, accuracy or timing is allowed");
    const std::string value = k + 1 < count ? words[k + 1] : "";
    if (key == "branch" && (value == "follow" || value == "global"))
      branch_ = value == "global" ? dem::Branch::global : dem::Branch::follow;
    else if (key == "accuracy" && (value == "certified" || value == "standard"))
      accuracy_ = value == "standard" ? Accuracy::standard() : Accuracy::certified();
    else if (key == "timing" && (value == "yes" || value == "no"))
      is_timed_ = value == "yes";
    else
      error->all(FLERR, "Pair style tangency: " + key + " = " + value + ": " +
                            (key == "branch"     ? "follow or global"
                             : key == "accuracy" ? "certified or standard"
                                                 : "yes or no") +
                            " is allowed");
  }
}

void PairTangency::coeff(int count, char** arguments) {
  Words words(lmp, "Pair_coeff of pair style tangency", count, arguments, 0);
  const std::string of_i = words.next("two types"), of_j = words.next("two types");
  const dem::ContactLaw law = law_of(words);
  if (!allocated) allocate();
  int first_i = 0, last_i = 0, first_j = 0, last_j = 0;
  LAMMPS_NS::utils::bounds(FLERR, of_i, 1, atom->ntypes, first_i, last_i, error);
  LAMMPS_NS::utils::bounds(FLERR, of_j, 1, atom->ntypes, first_j, last_j, error);
  bool any = false;
  for (int i = first_i; i <= last_i; ++i)
    for (int j = std::max(first_j, i); j <= last_j; ++j) {
      laws_are_new_ |= setflag[i][j] == 0 || stored(law_between(i, j)) != stored(law);
      law_between(i, j) = law_between(j, i) = law;
      setflag[i][j] = 1;
      any = true;
    }
  if (!any) error->all(FLERR, "Pair_coeff of pair style tangency: I <= J is needed");
}

dem::ContactLaw& PairTangency::law_between(int i, int j) {
  return laws_.law[static_cast<std::size_t>(i - 1) * laws_.types + static_cast<std::size_t>(j - 1)];
}

void PairTangency::require_host() {
  if (AtomBodies::ellipsoids(lmp) == nullptr)
    error->all(FLERR, "Pair style tangency needs atom style ellipsoid");
  if (domain->dimension != 3) error->all(FLERR, "Pair style tangency needs dimension 3");
  if (comm->ghost_velocity == 0)
    error->all(FLERR, "Pair style tangency needs the velocities of ghosts: comm_modify vel yes");
  if (std::string_view(update->integrate_style) == "respa")
    error->all(FLERR, "Pair style tangency does not work with run_style respa: verlet is allowed");
  // A library that was linked with -ffast-math changes it for the whole process.
  if (!environment_is_default())
    error->all(FLERR,
               "Pair style tangency needs arithmetic that rounds to nearest and keeps subnormal "
               "numbers: something in this program, as what -ffast-math links, changes that");
}

void PairTangency::require_one_law() {
  const dem::ContactLaw* first = nullptr;
  for (int i = 1; i <= atom->ntypes; ++i)
    for (int j = i; j <= atom->ntypes; ++j) {
      if (setflag[i][j] == 0) continue;
      if (first == nullptr) first = &law_between(i, j);
      if (law_between(i, j).hertz.has_value() != first->hertz.has_value())
        error->all(FLERR,
                   "Pair style tangency: all pairs of types need the law hooke, or all "
                   "hertz/material");
    }
  // Where one is missing init_one() says so; with pair_style hybrid it is of another style, and
  // nobody asks for its law.
  for (int i = 1; i <= atom->ntypes; ++i)
    for (int j = i; j <= atom->ntypes; ++j)
      if (setflag[i][j] == 0 && first != nullptr) law_between(i, j) = law_between(j, i) = *first;
}

void PairTangency::init_style() {
  require_host();
  require_one_law();
  reach_ = AtomBodies::reach_by_type(lmp);
  // LAMMPS copies atoms for their images before the first list: a skin of many boxes fills memory.
  require_room(longest_cutoff());
  neighbor->request(this, instance_me);
  make_history();
}

void PairTangency::make_history() {
  if (history_ == nullptr)
    modify->replace_fix(
        (history_id_ + "_DUMMY").c_str(),
        history_id_ + " all NEIGH_HISTORY_TANGENCY " + std::to_string(kRecordNumbers), 1);
  const int at = modify->find_fix(history_id_);
  if (at < 0) error->all(FLERR, "Pair style tangency: its history of neighbours is gone");
  history_ = dynamic_cast<FixContactHistory*>(modify->fix[at]);
  history_->pair = this;
  // The list is made by the cutoffs of types: it has no bit that says which pairs touch.
  history_->use_bit_flag = 0;
}

double PairTangency::init_one(int i, int j) {
  if (setflag[i][j] == 0)
    error->all(FLERR, "Pair style tangency: pair_coeff " + std::to_string(i) + " " +
                          std::to_string(j) + " is missing: laws are not mixed");
  return reach_[static_cast<std::size_t>(i)] + reach_[static_cast<std::size_t>(j)];
}

/// Of the pairs of types that are of this style.
double PairTangency::longest_cutoff() const {
  double longest = 0.0;
  for (int i = 1; i <= atom->ntypes; ++i)
    for (int j = i; j <= atom->ntypes; ++j)
      if (setflag[i][j] != 0)
        longest = std::max(
            longest, reach_[static_cast<std::size_t>(i)] + reach_[static_cast<std::size_t>(j)]);
  return longest;
}

void PairTangency::require_room(double cutoff) {
  const Vec3 thickness = BoxMotion::thickness(*domain);
  for (int k = 0; k < 3; ++k)
    if (domain->periodicity[k] != 0 && !(thickness[k] > 2.0 * (cutoff + neighbor->skin)))
      error->all(FLERR,
                 "Pair style tangency: the box is {:.6g} thick along its periodic direction {}: "
                 "more than twice cutoff, {:.6g}, and skin, {:.6g}, is needed, lest a pair meet "
                 "twice",
                 thickness[k], "xyz"[k], cutoff, neighbor -> skin);
}

void PairTangency::write_restart_settings(FILE* file) {
  const int branch = static_cast<int>(branch_), normals = accuracy_.normals ? 1 : 0;
  std::fwrite(&branch, sizeof branch, 1, file);
  std::fwrite(&normals, sizeof normals, 1, file);
}

void PairTangency::read_restart_settings(FILE* file) {
  int numbers[2] = {0, 0};
  if (comm->me == 0)
    LAMMPS_NS::utils::sfread(FLERR, numbers, sizeof numbers[0], 2, file, nullptr, error);
  MPI_Bcast(numbers, 2, MPI_INT, 0, world);
  branch_ = static_cast<dem::Branch>(numbers[0]);
  accuracy_ = numbers[1] != 0 ? Accuracy::certified() : Accuracy::standard();
}

void PairTangency::write_restart(FILE* file) {
  write_restart_settings(file);
  for (int i = 1; i <= atom->ntypes; ++i)
    for (int j = i; j <= atom->ntypes; ++j) {
      const StoredLaw numbers = stored(law_between(i, j));
      std::fwrite(&setflag[i][j], sizeof(int), 1, file);
      std::fwrite(numbers.data(), sizeof(double), numbers.size(), file);
    }
}

void PairTangency::read_restart(FILE* file) {
  read_restart_settings(file);
  allocate();
  for (int i = 1; i <= atom->ntypes; ++i)
    for (int j = i; j <= atom->ntypes; ++j) {
      StoredLaw numbers{};
      if (comm->me == 0) {
        LAMMPS_NS::utils::sfread(FLERR, &setflag[i][j], sizeof(int), 1, file, nullptr, error);
        LAMMPS_NS::utils::sfread(FLERR, numbers.data(), sizeof(double), numbers.size(), file,
                                 nullptr, error);
      }
      MPI_Bcast(&setflag[i][j], 1, MPI_INT, 0, world);
      MPI_Bcast(numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, 0, world);
      law_between(i, j) = law_between(j, i) = restored(numbers);
    }
}

}  // namespace tangency::inline v0::lammps
