// SPDX-License-Identifier: GPL-2.0-or-later
#include <tangency/dem/lammps/compute_fabric.hpp>

#include <atom.h>
#include <comm.h>
#include <domain.h>
#include <error.h>
#include <force.h>
#include <update.h>

#include <algorithm>
#include <climits>
#include <cstddef>
#include <exception>
#include <optional>
#include <string>

#include <tangency/dem/lammps/box.hpp>
#include <tangency/dem/lammps/contact_source.hpp>
#include <tangency/dem/lammps/words.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::lammps {
namespace {

namespace mm = micromechanics;

constexpr int kNumbers = 34;
constexpr std::size_t kOfContact = 9;  ///< numbers that are gathered: normal, branch, force

mm::Estimator estimator_named(Words& words) {
  const std::string name = words.next("estimator");
  if (name == "unbiased") return mm::Estimator::unbiased;
  if (name == "published") return mm::Estimator::published;
  if (name != "contact_sums")
    words.refuse("estimator", name, "unbiased, published or contact_sums");
  return mm::Estimator::contact_sums;
}

mm::Classes classes_named(Words& words) {
  const std::string name = words.next("partition");
  if (name != "near_uniform" && name != "polar")
    words.refuse("partition", name, "near_uniform or polar");
  mm::Classes classes;
  classes.kind = name == "polar" ? mm::Classes::Kind::polar : mm::Classes::Kind::near_uniform;
  const int fewest = mm::Classes::fewest(classes.kind);
  const double count = words.number("partition " + name);
  if (!(count >= fewest && count <= mm::Classes::kMost) || count != static_cast<int>(count))
    words.refuse(
        "partition " + name, std::to_string(count),
        "an integer from " + std::to_string(fewest) + " to " + std::to_string(mm::Classes::kMost));
  classes.count = static_cast<int>(count);
  return classes;
}

/// Writes tensors and numbers one after the other.
class Row {
 public:
  explicit Row(double* at) : at_(at) {}
  void add(double value) { *at_++ = value; }
  void add(const std::optional<Mat3>& tensor) {
    const Mat3 t = tensor.value_or(Mat3::Constant(mm::kNotDefined));
    for (const double value : {t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(0, 2), t(1, 2)}) add(value);
  }

 private:
  double* at_;
};

void write(const mm::Fabric& fabric, double* to) {
  Row row(to);
  const auto second = [](const auto& fit) {
    return fit ? std::optional<Mat3>(fit->model.second) : std::nullopt;
  };
  const auto normal = [](const auto& fit) {
    return fit ? std::optional<Mat3>(fit->normal.model.second) : std::nullopt;
  };
  const auto tangential = [](const auto& fit) {
    return fit ? std::optional<Mat3>(fit->tangential.model.second) : std::nullopt;
  };
  row.add(second(fabric.normals));
  row.add(normal(fabric.force));
  row.add(tangential(fabric.force));
  row.add(normal(fabric.branch));
  row.add(tangential(fabric.branch));
  row.add(fabric.force ? fabric.force->normal.model.mean : mm::kNotDefined);
  row.add(fabric.branch ? fabric.branch->normal.model.mean : mm::kNotDefined);
  row.add(fabric.contact_density);
  row.add(static_cast<double>(fabric.contacts));
}

}  // namespace

ComputeFabric::ComputeFabric(LAMMPS_NS::LAMMPS* lammps, int count, char** arguments)
    : Compute(lammps, count, arguments) {
  Words words(lammps, "compute tangency/fabric", count, arguments, 3);
  while (words.any()) {
    const std::string key = words.next("a keyword");
    if (key == "estimator")
      estimator_ = estimator_named(words);
    else if (key == "partition")
      classes_ = classes_named(words);
    else
      words.refuse("keyword", key, "estimator or partition");
  }
  if (domain->dimension != 3) words.refuse("needs dimension 3");
  vector_flag = 1;
  size_vector = kNumbers;
  extvector = 0;
  vector = new double[kNumbers];
}

ComputeFabric::~ComputeFabric() { delete[] vector; }

void ComputeFabric::init() {
  if (ContactSource::of(*force) == nullptr)
    error->all(FLERR, "compute tangency/fabric: the pair style does not tell its contacts");
}

/// Of all ranks, on the first one.
std::vector<double> ComputeFabric::gathered() {
  std::vector<double> here;
  ContactSource::of(*force)->for_each_contact([&](const SeenContact& contact) {
    for (const Vec3& v : {contact.normal, contact.branch, contact.force})
      here.insert(here.end(), v.data(), v.data() + 3);
  });
  const int of_rank = static_cast<int>(here.size() / kOfContact);
  std::vector<int> counts(static_cast<std::size_t>(comm->nprocs));
  MPI_Gather(&of_rank, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, world);
  std::vector<int> places;
  LAMMPS_NS::bigint all = 0;
  for (const int count : counts) {
    places.push_back(static_cast<int>(all));
    all += count;
  }
  int too_many = all > INT_MAX ? 1 : 0;
  MPI_Bcast(&too_many, 1, MPI_INT, 0, world);
  if (too_many != 0) error->all(FLERR, "compute tangency/fabric: more than 2^31 contacts");
  MPI_Datatype contact = MPI_DATATYPE_NULL;
  MPI_Type_contiguous(static_cast<int>(kOfContact), MPI_DOUBLE, &contact);
  MPI_Type_commit(&contact);
  std::vector<double> found(comm->me == 0 ? static_cast<std::size_t>(all) * kOfContact : 0);
  MPI_Gatherv(here.data(), of_rank, contact, found.data(), counts.data(), places.data(), contact, 0,
              world);
  MPI_Type_free(&contact);
  return found;
}

void ComputeFabric::compute_vector() {
  invoked_vector = update->ntimestep;
  const std::vector<double> rows = gathered();
  std::string fault;
  if (comm->me == 0) {
    std::vector<Vec3> normal, branch, force_on_b;
    for (std::size_t at = 0; at < rows.size(); at += kOfContact) {
      normal.emplace_back(rows[at], rows[at + 1], rows[at + 2]);
      branch.emplace_back(rows[at + 3], rows[at + 4], rows[at + 5]);
      force_on_b.emplace_back(rows[at + 6], rows[at + 7], rows[at + 8]);
    }
    mm::ContactArrays contacts{normal, branch, force_on_b};
    contacts.particles = atom->natoms;
    contacts.volume = Box::of(*domain).volume();
    try {
      write(mm::fabric_of(contacts, classes_.partition(), estimator_), vector);
    } catch (const std::exception& error_of_contacts) {
      fault = error_of_contacts.what();
    }
  }
  if (!fault.empty()) error->one(FLERR, "compute tangency/fabric: " + fault);
  MPI_Bcast(vector, kNumbers, MPI_DOUBLE, 0, world);
}

}  // namespace tangency::inline v0::lammps
