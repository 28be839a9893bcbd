// SPDX-License-Identifier: MIT
#include <tangency/dem/micromechanics/fabric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "regression.hpp"

namespace tangency::inline v0::micromechanics {
namespace {

constexpr std::size_t kSecond = 5, kFourth = 9;  // free components of the orders

/// As kScalarFactor2, of a tangential vector.
constexpr double kTangentialFactor2 = 5.0, kTangentialFactor4 = 63.0 / 2.0;

std::size_t size_of(int order) {
  if (order != 2 && order != 4)
    throw std::invalid_argument("order = " + std::to_string(order) + ": must be 2 or 4");
  return order == 2 ? kSecond : kSecond + kFourth;
}

Coefficients scalar_basis(const Vec3& n, int order) {
  Coefficients basis{};
  basis[0] = 1.0;
  for (std::size_t m = 0; m < kSecond; ++m) basis[1 + m] = n.dot(second_basis()[m] * n);
  if (order == 4)
    for (std::size_t m = 0; m < kFourth; ++m) basis[1 + kSecond + m] = fourth_basis()[m].along(n);
  return basis;
}

/// Of the three components of a tangential vector. As published, before the part along n is taken
/// away, which no tangential vector sees but at the middle of its class.
std::array<Coefficients, 3> tangential_basis(const Vec3& n, int order, bool as_published) {
  std::array<Coefficients, 3> basis{};
  const std::size_t size = size_of(order);
  for (std::size_t m = 0; m < size; ++m) {
    Vec3 v =
        m < kSecond ? Vec3(second_basis()[m] * n) : fourth_basis()[m - kSecond].vector_along(n);
    if (!as_published) v -= v.dot(n) * n;
    for (std::size_t i = 0; i < 3; ++i) basis[i][m] = v[static_cast<Eigen::Index>(i)];
  }
  return basis;
}

/// The factors of the tensors' coefficients, which begin at `first`.
Coefficients factors(double of_second, double of_fourth, std::size_t first) {
  Coefficients made{};
  if (first > 0) made[0] = 1.0;
  for (std::size_t m = 0; m < kSecond; ++m) made[first + m] = of_second;
  for (std::size_t m = 0; m < kFourth && first + kSecond + m < made.size(); ++m)
    made[first + kSecond + m] = of_fourth;
  return made;
}

/// Tensors of coefficients in the bases, from `first` on.
template <typename Model>
void set_tensors(Model& model, const Coefficients& c, int order, std::size_t first) {
  for (std::size_t m = 0; m < kSecond; ++m) model.second += c[first + m] * second_basis()[m];
  if (order == 4)
    for (std::size_t m = 0; m < kFourth; ++m)
      model.fourth += c[first + kSecond + m] * fourth_basis()[m];
}

/// Deviations of the tensors' components.
void set_errors(HarmonicErrors& error, const Covariance& covariance, int order, std::size_t first) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Coefficients direction{};
      for (std::size_t m = 0; m < kSecond; ++m) direction[first + m] = second_basis()[m](i, j);
      error.second(i, j) = covariance.deviation(direction);
    }
  if (order == 2) return;
  for (std::size_t at = 0; at < SymmetricTensor4::kComponents; ++at) {
    Coefficients direction{};
    for (std::size_t m = 0; m < kFourth; ++m)
      direction[first + kSecond + m] = fourth_basis()[m].components[at];
    error.fourth.components[at] = covariance.deviation(direction);
  }
}

/// (influence - its mean's part of the coefficients) / mean: of coefficients relative to a mean.
void make_relative(Coefficients& influence, const Coefficients& relative, double mean,
                   double mean_influence, std::size_t first) {
  for (std::size_t m = first; m < influence.size(); ++m)
    influence[m] = (influence[m] - mean_influence * relative[m]) / mean;
}

Coefficients divided(Coefficients c, double mean, std::size_t first) {
  for (std::size_t m = first; m < c.size(); ++m) c[m] /= mean;
  return c;
}

void require_unit(std::span<const Vec3> directions) {
  for (std::size_t i = 0; i < directions.size(); ++i)
    if (!(std::abs(directions[i].norm() - 1.0) <= kUnitTolerance))
      throw std::invalid_argument("directions[" + std::to_string(i) + "]: must be a unit vector");
}

/// Where each contact is evaluated and what it weighs; empty weights where the estimator has none.
struct Plan {
  std::vector<double> weight;
  bool at_class_middle = false, projected = true;

  Plan(const DirectionGroups& groups, Estimator estimator) {
    at_class_middle = estimator == Estimator::published;
    projected = estimator != Estimator::unbiased;
    const std::size_t contacts = groups.contacts();
    weight.reserve(contacts);
    if (estimator != Estimator::contact_sums) {
      for (std::size_t c = 0; c < contacts; ++c) weight.push_back(groups.contact_weight(c));
      return;
    }
    const auto density = fit_orientations(groups.normals());
    if (!density) return;
    for (const Vec3& n : groups.normals()) {
      const double relative = 1.0 + n.dot(density->model.second * n);
      weight.push_back(1.0 / (static_cast<double>(contacts) * relative));
    }
    if (std::ranges::any_of(weight, [](double w) { return !(w > 0.0 && std::isfinite(w)); }))
      weight.clear();
  }

  const Vec3& place(const DirectionGroups& groups, std::size_t c) const {
    return at_class_middle ? groups.partition().direction(groups.group(c)) : groups.normals()[c];
  }
};

/// The regression of a scalar, and what each contact did to its mean.
struct ScalarRegression {
  ScalarFit fit;
  std::vector<double> mean_influence;
};

std::optional<ScalarRegression> regress(const DirectionGroups& groups, const Plan& plan,
                                        std::span<const double> values, int order) {
  const std::size_t size = 1 + size_of(order);
  if (values.empty() || plan.weight.empty()) return std::nullopt;
  Regression regression(size);
  for (std::size_t c = 0; c < values.size(); ++c)
    regression.add(scalar_basis(plan.place(groups, c), order), values[c], plan.weight[c]);
  if (plan.projected)
    regression.project(factors(kScalarFactor2, kScalarFactor4, 1));
  else if (!regression.least_squares())
    return std::nullopt;
  ScalarRegression found;
  ScalarHarmonics& model = found.fit.model;
  model.mean = regression.coefficients()[0];
  if (model.mean == 0.0) return std::nullopt;
  const Coefficients relative = divided(regression.coefficients(), model.mean, 1);
  set_tensors(model, relative, order, 1);

  Covariance covariance;
  found.mean_influence.reserve(values.size());
  for (std::size_t c = 0; c < values.size(); ++c) {
    const double off = values[c] - model.value(groups.normals()[c]);
    Coefficients influence =
        regression.influence(scalar_basis(plan.place(groups, c), order), off, plan.weight[c]);
    found.mean_influence.push_back(influence[0]);
    make_relative(influence, relative, model.mean, influence[0], 1);
    covariance.add(influence);
  }
  covariance.correct(values.size(), size);
  Coefficients mean_alone{};
  mean_alone[0] = 1.0;
  found.fit.error.mean = covariance.deviation(mean_alone);
  set_errors(found.fit.error, covariance, order, 1);
  found.fit.unexplained = unexplained_variance(groups, values, model);
  return found;
}

double asymmetry_of(const DirectionGroups& groups, std::span<const Vec3> tangential) {
  Mat3 f = Mat3::Zero();
  for (std::size_t c = 0; c < tangential.size(); ++c)
    f += groups.contact_weight(c) * tangential[c] * groups.normals()[c].transpose();
  return (f - f.transpose()).norm() / f.norm();
}

std::optional<TangentialFit> regress_tangential(const DirectionGroups& groups, const Plan& plan,
                                                std::span<const Vec3> values,
                                                const ScalarRegression& along, int order) {
  const std::size_t size = size_of(order);
  Regression regression(size);
  for (std::size_t c = 0; c < values.size(); ++c) {
    const auto basis = tangential_basis(plan.place(groups, c), order, plan.projected);
    for (std::size_t i = 0; i < 3; ++i)
      regression.add(basis[i], values[c][static_cast<Eigen::Index>(i)], plan.weight[c]);
  }
  if (plan.projected)
    regression.project(factors(kTangentialFactor2, kTangentialFactor4, 0));
  else if (!regression.least_squares())
    return std::nullopt;
  TangentialFit found;
  const double mean = found.model.mean = along.fit.model.mean;
  const Coefficients relative = divided(regression.coefficients(), mean, 0);
  set_tensors(found.model, relative, order, 0);

  Covariance covariance;
  for (std::size_t c = 0; c < values.size(); ++c) {
    const Vec3 off = values[c] - found.model.value(groups.normals()[c]);
    const auto basis = tangential_basis(plan.place(groups, c), order, plan.projected);
    Coefficients influence{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Coefficients added =
          regression.influence(basis[i], off[static_cast<Eigen::Index>(i)], plan.weight[c]);
      for (std::size_t m = 0; m < size; ++m) influence[m] += added[m];
    }
    make_relative(influence, relative, mean, along.mean_influence[c], 0);
    covariance.add(influence);
  }
  covariance.correct(2 * values.size(), size);  // two components a contact
  set_errors(found.error, covariance, order, 0);
  found.unexplained = unexplained_variance(groups, values, found.model);
  found.asymmetry = asymmetry_of(groups, values);
  return found;
}

}  // namespace

std::optional<OrientationFit> fit_orientations(std::span<const Vec3> directions) {
  require_unit(directions);
  if (directions.empty()) return std::nullopt;
  constexpr int order = 4;
  // Sums of the harmonics times their factors are the coefficients; each direction has its own.
  const auto count = static_cast<double>(directions.size());
  const Coefficients scale = factors(kScalarFactor2, kScalarFactor4, 1);
  const auto of_one = [&](const Vec3& n) {
    Coefficients c = scalar_basis(n, order);
    for (std::size_t m = 0; m < c.size(); ++m) c[m] *= scale[m];
    return c;
  };
  Coefficients mean{};
  for (const Vec3& n : directions) {
    const Coefficients c = of_one(n);
    for (std::size_t m = 0; m < c.size(); ++m) mean[m] += c[m] / count;
  }
  OrientationFit found;
  found.count = directions.size();
  found.model.mean = 0.25 / std::numbers::pi;
  set_tensors(found.model, mean, order, 1);
  Covariance covariance;
  for (const Vec3& n : directions) {
    Coefficients off = of_one(n);
    for (std::size_t m = 0; m < off.size(); ++m) off[m] = (off[m] - mean[m]) / count;
    covariance.add(off);
  }
  covariance.correct(directions.size(), 1);
  set_errors(found.error, covariance, order, 1);
  return found;
}

std::optional<ScalarFit> fit_scalars(const DirectionGroups& groups, std::span<const double> values,
                                     Estimator estimator, int order) {
  static_cast<void>(groups.over_contacts(values));  // one value a contact
  const auto found = regress(groups, Plan(groups, estimator), values, order);
  if (!found) return std::nullopt;
  return found->fit;
}

std::optional<VectorFit> fit_vectors(const DirectionGroups& groups, std::span<const Vec3> vectors,
                                     Estimator estimator, int order) {
  const Plan plan(groups, estimator);
  const auto along = regress(groups, plan, normal_components(groups.normals(), vectors), order);
  if (!along) return std::nullopt;
  const auto across = regress_tangential(
      groups, plan, tangential_components(groups.normals(), vectors), *along, order);
  if (!across) return std::nullopt;
  return VectorFit{along->fit, *across};
}

Fabric fabric_of(const ContactArrays& contacts, const SpherePartition& partition,
                 Estimator estimator, int order) {
  require_sound(contacts);
  if (contacts.dimensions != 3)
    throw std::invalid_argument("dimensions = 2: plane_fabric_of takes contacts in the plane");
  const DirectionGroups groups(partition, contacts.normal);
  Fabric found;
  found.stress = stress_of(contacts);
  found.contact_density = contact_density(contacts);
  found.contacts = contacts.size();
  found.empty_classes = groups.empty_classes();
  found.normals = fit_orientations(contacts.normal);
  found.normals_unexplained =
      found.normals ? unexplained_variance(groups, found.normals->model) : kNotDefined;
  found.force = fit_vectors(groups, contacts.force, estimator, order);
  found.branch = fit_vectors(groups, contacts.branch, estimator, order);
  found.branch_length = fit_scalars(groups, lengths(contacts.branch), estimator, order);
  if (!contacts.arm.empty()) found.contact_vectors = fit_orientations(contact_vectors(contacts));
  return found;
}

}  // namespace tangency::inline v0::micromechanics
