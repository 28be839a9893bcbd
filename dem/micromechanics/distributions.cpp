// SPDX-License-Identifier: MIT
#include <tangency/dem/micromechanics/distributions.hpp>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "require_length.hpp"

namespace tangency::inline v0::micromechanics {
namespace {

void require_length(std::size_t length, std::size_t contacts) {
  micromechanics::require_length("values", length, contacts, "contacts");
}

/// numerator / denominator, NaN where the denominator is 0 but for rounding of values of that size.
double share(double numerator, double denominator, double size) {
  return denominator > kRoundedVariance * size ? numerator / denominator : kNotDefined;
}

}  // namespace

DirectionGroups::DirectionGroups(SpherePartition partition, std::span<const Vec3> normals)
    : partition_(std::move(partition)),
      normals_(normals.begin(), normals.end()),
      sides_(partition_.size(), 0) {
  group_.reserve(normals.size());
  for (const Vec3& n : normals) {
    const std::size_t g = partition_.class_of(n);
    group_.push_back(g);
    ++sides_[g];
    ++sides_[partition_.opposite(g)];
  }
  for (std::size_t g = 0; g < partition_.size(); ++g)
    if (sides_[g] > 0)
      filled_ += partition_.area(g);
    else
      ++empty_;
}

double DirectionGroups::density(std::size_t g) const {
  if (contacts() == 0) return 0.0;
  return static_cast<double>(sides_[g]) /
         (2.0 * static_cast<double>(contacts()) * partition_.area(g));
}

double DirectionGroups::weight(std::size_t g) const {
  return sides_[g] > 0 ? partition_.area(g) / filled_ : 0.0;
}

double DirectionGroups::contact_weight(std::size_t contact) const {
  const std::size_t g = group_[contact];
  return 2.0 * weight(g) / static_cast<double>(sides_[g]);
}

std::vector<double> DirectionGroups::means(std::span<const double> scalars) const {
  require_length(scalars.size(), contacts());
  std::vector<double> mean(partition_.size(), 0.0);
  for (std::size_t c = 0; c < scalars.size(); ++c) {
    mean[group_[c]] += scalars[c];
    mean[partition_.opposite(group_[c])] += scalars[c];
  }
  for (std::size_t g = 0; g < mean.size(); ++g)
    if (sides_[g] > 0) mean[g] /= static_cast<double>(sides_[g]);
  return mean;
}

std::vector<Vec3> DirectionGroups::means(std::span<const Vec3> vectors) const {
  require_length(vectors.size(), contacts());
  std::vector<Vec3> mean(partition_.size(), Vec3::Zero());
  for (std::size_t c = 0; c < vectors.size(); ++c) {
    mean[group_[c]] += vectors[c];
    mean[partition_.opposite(group_[c])] -= vectors[c];
  }
  for (std::size_t g = 0; g < mean.size(); ++g)
    if (sides_[g] > 0) mean[g] /= static_cast<double>(sides_[g]);
  return mean;
}

double DirectionGroups::over_contacts(std::span<const double> scalars) const {
  require_length(scalars.size(), contacts());
  double sum = 0.0;
  for (const double value : scalars) sum += value;
  return scalars.empty() ? 0.0 : sum / static_cast<double>(scalars.size());
}

double DirectionGroups::over_orientations(std::span<const double> scalars) const {
  require_length(scalars.size(), contacts());
  double sum = 0.0;
  for (std::size_t c = 0; c < scalars.size(); ++c) sum += contact_weight(c) * scalars[c];
  return sum;
}

std::vector<double> normal_components(std::span<const Vec3> normals, std::span<const Vec3> v) {
  require_length(v.size(), normals.size());
  std::vector<double> along;
  along.reserve(v.size());
  for (std::size_t c = 0; c < v.size(); ++c) along.push_back(v[c].dot(normals[c]));
  return along;
}

std::vector<Vec3> tangential_components(std::span<const Vec3> normals, std::span<const Vec3> v) {
  require_length(v.size(), normals.size());
  std::vector<Vec3> across;
  across.reserve(v.size());
  for (std::size_t c = 0; c < v.size(); ++c)
    across.push_back(v[c] - v[c].dot(normals[c]) * normals[c]);
  return across;
}

std::vector<double> lengths(std::span<const Vec3> v) {
  std::vector<double> found;
  found.reserve(v.size());
  for (const Vec3& each : v) found.push_back(each.norm());
  return found;
}

GroupSums group_sums(const DirectionGroups& groups, const ContactArrays& contacts) {
  require_sound(contacts);
  require_length(contacts.size(), groups.contacts());
  const SpherePartition& partition = groups.partition();
  GroupSums sums;
  sums.products.assign(partition.size(), Mat3::Zero());
  std::vector<Vec3> levers(partition.size(), Vec3::Zero());
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Vec3 of_a = contacts.arm.empty() ? Vec3(0.5 * contacts.branch[c]) : contacts.arm[c];
    const Vec3 of_b = of_a - contacts.branch[c];
    const std::size_t a = groups.group(c), b = partition.opposite(a);
    sums.products[a] += contacts.force[c] * of_a.transpose();
    sums.products[b] -= contacts.force[c] * of_b.transpose();
    levers[a] += of_a;
    levers[b] += of_b;
  }
  const std::vector<Vec3> forces = groups.means(contacts.force);
  for (std::size_t g = 0; g < partition.size(); ++g) {
    sums.exact += sums.products[g];
    sums.independent += forces[g] * levers[g].transpose();  // M_g mean(f) mean(l)
  }
  sums.exact /= contacts.volume;
  sums.independent /= contacts.volume;
  return sums;
}

double unexplained_variance(const DirectionGroups& groups, std::span<const double> scalars,
                            const ScalarHarmonics& model) {
  const std::vector<double> mean = groups.means(scalars);
  const double average = groups.over_orientations(scalars);
  double left = 0.0, all = 0.0, size = 0.0;
  for (std::size_t g = 0; g < mean.size(); ++g) {
    const double w = groups.weight(g);
    const double off = mean[g] - model.value(groups.partition().direction(g));
    left += w * off * off;
    all += w * (mean[g] - average) * (mean[g] - average);
    size += w * mean[g] * mean[g];
  }
  return share(left, all, size);
}

double unexplained_variance(const DirectionGroups& groups, std::span<const Vec3> tangential,
                            const TangentialHarmonics& model) {
  const std::vector<Vec3> mean = groups.means(tangential);
  double left = 0.0, all = 0.0;
  for (std::size_t g = 0; g < mean.size(); ++g) {
    const double w = groups.weight(g);
    left += w * (mean[g] - model.value(groups.partition().direction(g))).squaredNorm();
    all += w * mean[g].squaredNorm();
  }
  return share(left, all, 0.0);
}

double unexplained_variance(const DirectionGroups& groups, const ScalarHarmonics& density) {
  const double uniform = 0.25 / std::numbers::pi;
  double left = 0.0, all = 0.0, size = 0.0;
  for (std::size_t g = 0; g < groups.partition().size(); ++g) {
    const double area = groups.partition().area(g), seen = groups.density(g);
    const double off = seen - density.value(groups.partition().direction(g));
    left += area * off * off;
    all += area * (seen - uniform) * (seen - uniform);
    size += area * seen * seen;
  }
  return share(left, all, size);
}

std::array<AxisGroup, 3> axis_groups(std::span<const Vec3> normals, std::span<const Vec3> forces) {
  const std::vector<double> along = normal_components(normals, forces);
  std::array<AxisGroup, 3> groups;
  std::array<double, 3> sum{};
  for (std::size_t c = 0; c < normals.size(); ++c) {
    Eigen::Index largest = 0;
    normals[c].cwiseAbs().maxCoeff(&largest);
    const auto k = static_cast<std::size_t>(largest);
    ++groups[k].contacts;
    sum[k] += along[c];
  }
  // 0/0 is the NaN of what is not defined.
  for (std::size_t k = 0; k < groups.size(); ++k) {
    groups[k].fraction =
        static_cast<double>(groups[k].contacts) / static_cast<double>(normals.size());
    groups[k].mean_normal_force = sum[k] / static_cast<double>(groups[k].contacts);
  }
  return groups;
}

std::vector<RadialRing> radial_means(const DirectionGroups& groups,
                                     std::span<const Vec3> tangential) {
  const SpherePartition& partition = groups.partition();
  if (partition.rings() == 0)
    throw std::invalid_argument("radial means: the partition must be polar");
  const std::vector<Vec3> mean = groups.means(tangential);
  std::vector<RadialRing> rings(partition.rings());
  for (std::size_t ring = 0; ring < rings.size(); ++ring) {
    RadialRing& found = rings[ring];
    found.beta =
        (static_cast<double>(ring) + 0.5) * std::numbers::pi / static_cast<double>(rings.size());
    for (std::size_t sector = 0; sector < partition.sectors(); ++sector) {
      const std::size_t g = ring * partition.sectors() + sector;
      if (groups.sides(g) == 0) continue;
      const Vec3& n = partition.direction(g);
      const Vec3 away = (n - n.dot(partition.axis()) * partition.axis()).normalized();
      found.value += mean[g].dot(away);
      ++found.filled_sectors;
    }
    if (found.filled_sectors > 0) found.value /= static_cast<double>(found.filled_sectors);
  }
  return rings;
}

}  // namespace tangency::inline v0::micromechanics
