// SPDX-License-Identifier: MIT
#include <tangency/dem/observe.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <tangency/dem/chunks.hpp>
#include <tangency/dem/motion/motion.hpp>

namespace tangency::inline v0::dem {
namespace {

/// One type for eigenvalues of any size here: a solver takes seconds to compile.
using UpTo6 = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

double standard_deviation(const std::vector<std::int32_t>& counts, double mean) {
  double sum = 0.0;
  for (const std::int32_t count : counts) {
    const double off = static_cast<double>(count) - mean;
    sum += off * off;
  }
  return std::sqrt(sum / static_cast<double>(counts.size()));
}

/// Over the particles of a chunk.
struct Unbalanced {
  double sum = 0.0, force = 0.0, moment = 0.0;                  ///< of forces, and the largest
  std::int64_t with_contacts = 0, rattlers = 0, of_others = 0;  ///< contacts of no rattlers

  Unbalanced& operator+=(const Unbalanced& other) {
    sum += other.sum;
    force = std::max(force, other.force);
    moment = std::max(moment, other.moment);
    with_contacts += other.with_contacts;
    rattlers += other.rattlers;
    of_others += other.of_others;
    return *this;
  }
};

/// What a growth changes and is drawn against.
void see_shapes(const Particles& particles, const Cell& cell, Observation& seen) {
  double solid = 0.0, radii = 0.0;
  for (const Vec3& axes : particles.semi_axes) {
    solid += volume_of(axes, particles.dimensions);
    radii += mean_radius_of(axes, particles.dimensions);
  }
  seen.porosity = 1.0 - solid / cell.volume();
  seen.packing_density = solid / cell.volume();
  // Of a cell without bound, as of a run that blows up, it is not defined.
  seen.void_ratio = seen.packing_density > 0.0 ? seen.porosity / seen.packing_density
                                               : std::numeric_limits<double>::quiet_NaN();
  seen.contact_density = 2.0 * static_cast<double>(seen.contacts) / cell.volume();
  seen.overlap_fraction = seen.mean_overlap / (2.0 * radii / static_cast<double>(particles.size()));
  // All of a type have one shape; in memory its particles stand anywhere.
  const auto first = std::min_element(particles.type.begin(), particles.type.end());
  const Vec3& axes = particles.semi_axes[static_cast<std::size_t>(first - particles.type.begin())];
  seen.elongation = axes[0] / axes[1];
  seen.eccentricity = (axes[0] - axes[1]) / (axes[0] + axes[1]);
}

/// Over the pairs of a chunk.
struct TensorSum {
  Mat3 tensor = Mat3::Zero();

  TensorSum& operator+=(const TensorSum& other) {
    tensor += other.tensor;
    return *this;
  }
};

}  // namespace

Stress stress_of(const Contacts& contacts, const Cell& cell) {
  const ContactSums& sums = contacts.sums();
  const double volume = cell.volume();
  return {0.5 / volume * (sums.force_branch + sums.force_branch.transpose()),
          sums.affine_stiffness / (cell.dimensions * volume), cell.dimensions};
}

double deviator_of(const Mat3& stress, int dimensions) {
  const auto part = stress.topLeftCorner(dimensions, dimensions);
  const double mean = part.trace() / dimensions;
  const double squares =
      (part - mean * Mat3::Identity().topLeftCorner(dimensions, dimensions)).squaredNorm();
  return std::sqrt(dimensions == 3 ? 1.5 * squares : 0.5 * squares);
}

double asymmetry_of(const Contacts& contacts, const Cell& cell) {
  const Mat3& sum = contacts.sums().force_branch;
  const double mean = sum.trace() / cell.dimensions;
  return mean > 0.0 ? (sum - sum.transpose()).norm() / mean : 0.0;
}

Mat3 boundary_stress_of(const Particles& particles, const Cell& cell, const Contacts& contacts,
                        const NeighbourList& list) {
  const std::vector<Pair>& pairs = list.pairs();
  const auto image_of = [&](std::int32_t i) {
    return cell.image_of(particles.position[static_cast<std::size_t>(i)]);
  };
  const auto sum = sum_by_chunks<TensorSum>(pairs.size(), [&](std::size_t first, std::size_t last) {
    TensorSum some;
    for (std::size_t k = first; k < last; ++k) {
      if (!contacts.touches(k)) continue;
      const Pair& pair = pairs[k];
      const Image of_a = image_of(pair.a);
      Vec3 lever;  // to the wall, or of the faces between the two as they are in the cell
      if (static_cast<std::size_t>(pair.b) >= particles.size()) {
        lever = particles.position[static_cast<std::size_t>(pair.a)] - cell.translation(of_a) +
                contacts.columns().branch[k];
      } else {
        Image crossed = image_of(pair.b);
        for (std::size_t axis = 0; axis < 3; ++axis) crossed[axis] += pair.image[axis] - of_a[axis];
        if (crossed == Image{}) continue;
        lever = cell.translation(crossed);
      }
      some.tensor += contacts.force(k) * lever.transpose();
    }
    return some;
  });
  return sum.tensor / cell.volume();
}

double friction_angle_deg(const Mat3& stress, int dimensions) {
  const Eigen::SelfAdjointEigenSolver<UpTo6> principal(stress.topLeftCorner(dimensions, dimensions),
                                                       Eigen::EigenvaluesOnly);
  const double least = principal.eigenvalues()[0];
  const double most = principal.eigenvalues()[dimensions - 1];
  if (!(least + most > 0.0)) return 0.0;
  const double sine = std::min(1.0, (most - least) / (least + most));
  return std::asin(sine) * 180.0 / std::numbers::pi;
}

Balance balance_of(const Particles& particles, const Contacts& contacts, const Vec3& gravity) {
  const Resultants& resultants = contacts.resultants();
  const std::int32_t least_contacts = gravity.isZero(0.0) ? 2 : 1;
  const auto all =
      sum_by_chunks<Unbalanced>(particles.size(), [&](std::size_t first, std::size_t last) {
        Unbalanced some;
        for (std::size_t i = first; i < last; ++i) {
          const bool rattles = resultants.contacts[i] < least_contacts;
          some.rattlers += rattles ? 1 : 0;
          some.of_others += rattles ? 0 : resultants.contacts[i];
          if (resultants.contacts[i] == 0) continue;
          const double force = (resultants.force[i] + particles.mass[i] * gravity).norm();
          some.sum += force;
          some.force = std::max(some.force, force);
          some.moment = std::max(some.moment,
                                 resultants.moment[i].norm() / particles.semi_axes[i].maxCoeff());
          ++some.with_contacts;
        }
        return some;
      });
  Balance balance;
  balance.rattlers = all.rattlers;
  if (const auto others = static_cast<std::int64_t>(particles.size()) - all.rattlers; others > 0)
    balance.mechanical_coordination =
        static_cast<double>(all.of_others) / static_cast<double>(others);
  const ContactTotals totals = contacts.totals();
  // A damped contact overlaps a while longer than it pushes.
  if (!(totals.force_length > 0.0)) return balance;
  const double mean = totals.force_length / static_cast<double>(totals.contacts);
  balance.mean_contact_force = mean;
  balance.inertial_fraction = all.sum / static_cast<double>(all.with_contacts) / mean;
  balance.largest_unbalanced_ratio = all.force / mean;
  balance.largest_unbalanced_moment_ratio = all.moment / mean;
  return balance;
}

double critical_time_step(const Particles& particles, const Contacts& contacts,
                          const NeighbourList& list) {
  using Mat6 = Eigen::Matrix<double, 6, 6>;
  double largest = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Vec3 inertia =
        principal_inertia(particles.mass[i], particles.semi_axes[i], particles.dimensions);
    // Shifts and turns about the body axes, each times the root of its inertia.
    const Mat3 turns = particles.orientation[i].toRotationMatrix() *
                       inertia.cwiseSqrt().cwiseInverse().asDiagonal();
    Mat6 sum = Mat6::Zero();
    list.for_each_pair_of(i, [&](std::size_t index, bool as_b) {
      if (!contacts.touches(index)) return;
      const Contact contact = contacts.records()[index];
      const Vec3& n = contact.normal;
      const double shear = contact.shear.stiffness;
      const Mat3 stiffness =
          shear * Mat3::Identity() + (contact.normal_stiffness - shear) * n * n.transpose();
      const Vec3 arm = as_b ? Vec3(contact.arm - contact.branch) : contact.arm;
      Eigen::Matrix<double, 3, 6> motion;  // of the contact point
      motion.leftCols<3>() = Mat3::Identity() / std::sqrt(particles.mass[i]);
      for (int k = 0; k < 3; ++k) motion.col(3 + k) = turns.col(k).cross(arm);
      if (particles.dimensions == 2) motion.middleCols<3>(2).setZero();
      sum += motion.transpose() * stiffness * motion;
    });
    const Eigen::SelfAdjointEigenSolver<UpTo6> modes(sum, Eigen::EigenvaluesOnly);
    largest = std::max(largest, modes.eigenvalues()[5]);
  }
  return std::sqrt(2.0 / largest);
}

Observation observe(const Particles& particles, const Cell& cell, const Contacts& contacts,
                    const Vec3& gravity) {
  Observation seen{};
  const Mat3 strain = cell.logarithmic_strain();
  const int axial = cell.dimensions - 1;
  seen.axial_strain = 0.0 - strain(axial, axial);  // not -0 of an unstrained cell
  seen.volumetric_strain = strain.trace();
  seen.shear_strain = Vec3::Zero() - cell.shear_strain();  // alike
  seen.stress = stress_of(contacts, cell);
  seen.asymmetry = asymmetry_of(contacts, cell);
  const ContactTotals totals = contacts.totals();
  seen.contacts = totals.contacts;
  if (seen.contacts > 0) {
    seen.mean_normal_force = totals.normal_force / static_cast<double>(seen.contacts);
    seen.mean_overlap = totals.overlap / static_cast<double>(seen.contacts);
  }
  seen.coordination_number =
      2.0 * static_cast<double>(seen.contacts) / static_cast<double>(particles.size());
  seen.coordination_std =
      standard_deviation(contacts.resultants().contacts, seen.coordination_number);
  see_shapes(particles, cell, seen);
  seen.balance = balance_of(particles, contacts, gravity);
  seen.kinetic_energy = kinetic_energy(particles);
  seen.elastic_energy = totals.energy;
  return seen;
}

std::vector<Field> history_fields(std::int64_t cycle, double time, const std::string& stage,
                                  std::int64_t stage_cycle, const Observation& seen) {
  const Mat3& s = seen.stress.tensor;
  const Mat3 b = 0.5 * (seen.boundary_stress + seen.boundary_stress.transpose());
  return {{"cycle", cycle},
          {"time", time},
          {"stage", stage},
          {"axial_strain", seen.axial_strain},
          {"volumetric_strain", seen.volumetric_strain},
          {"mean_stress", seen.stress.mean()},
          {"s_xx", s(0, 0)},
          {"s_yy", s(1, 1)},
          {"s_zz", s(2, 2)},
          {"s_xy", s(0, 1)},
          {"s_yz", s(1, 2)},
          {"s_zx", s(2, 0)},
          {"friction_angle_deg", friction_angle_deg(s, seen.stress.dimensions)},
          {"coordination_number", seen.coordination_number},
          {"coordination_std", seen.coordination_std},
          {"porosity", seen.porosity},
          {"contacts", seen.contacts},
          {"mean_normal_force", seen.mean_normal_force},
          {"mean_overlap", seen.mean_overlap},
          {"inertial_fraction", seen.balance.inertial_fraction},
          {"kinetic_energy", seen.kinetic_energy},
          {"elastic_energy", seen.elastic_energy},
          {"boundary_work", seen.account.boundary},
          {"gravity_work", seen.account.gravity},
          {"growth_work", seen.account.growth},
          {"branch_work", seen.account.branch},
          {"sliding_loss", seen.account.sliding},
          {"damping_loss", seen.account.damping},
          {"energy_error", seen.energy_error},
          {"stage_cycle", stage_cycle},
          {"elongation", seen.elongation},
          {"eccentricity", seen.eccentricity},
          {"packing_density", seen.packing_density},
          {"void_ratio", seen.void_ratio},
          {"contact_density", seen.contact_density},
          {"overlap_fraction", seen.overlap_fraction},
          {"asymmetry", seen.asymmetry},
          {"boundary_s_xx", b(0, 0)},
          {"boundary_s_yy", b(1, 1)},
          {"boundary_s_zz", b(2, 2)},
          {"boundary_s_xy", b(0, 1)},
          {"boundary_s_yz", b(1, 2)},
          {"boundary_s_zx", b(2, 0)},
          {"viscous_loss", seen.account.viscous},
          {"p", seen.stress.mean()},
          {"q", deviator_of(s, seen.stress.dimensions)},
          {"mechanical_coordination", seen.balance.mechanical_coordination},
          {"shear_strain_xy", seen.shear_strain[0]},
          {"shear_strain_yz", seen.shear_strain[1]},
          {"shear_strain_zx", seen.shear_strain[2]}};
}

}  // namespace tangency::inline v0::dem
