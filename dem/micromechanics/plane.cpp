// SPDX-License-Identifier: MIT
#include <tangency/dem/micromechanics/plane.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <tangency/dem/micromechanics/distributions.hpp>
#include <tangency/dem/micromechanics/sphere_partition.hpp>

#include "regression.hpp"

namespace tangency::inline v0::micromechanics {
namespace {

using Complex = std::complex<double>;

constexpr std::size_t kFree = 2;  ///< components of a plane tensor

/// A e^(2 i phi) of a tensor of amplitude A whose major axis has the angle phi, and back.
Complex as_complex(const Mat3& a) { return {0.5 * (a(0, 0) - a(1, 1)), 0.5 * (a(0, 1) + a(1, 0))}; }

Mat3 as_tensor(double along, double across) {
  Mat3 a = Mat3::Zero();
  a(0, 0) = along;
  a(1, 1) = -along;
  a(0, 1) = a(1, 0) = across;
  return a;
}

/// cos 2 theta and sin 2 theta of a direction.
Complex doubled(const Vec3& n) { return {n[0] * n[0] - n[1] * n[1], 2.0 * n[0] * n[1]}; }

Vec3 turned_left(const Vec3& n) { return {-n[1], n[0], 0.0}; }

Coefficients scalar_basis(const Vec3& n) {
  const Complex twice = doubled(n);
  return {1.0, twice.real(), twice.imag()};
}

/// Of the component to the left of n: that of a n.
Coefficients tangential_basis(const Vec3& n) {
  const Complex twice = doubled(n);
  return {-twice.imag(), twice.real()};
}

/// The tensor whose two components begin at `first`, and their deviations.
void set_tensor(PlaneScalarFit& fit, const Coefficients& c, const Covariance& covariance,
                std::size_t first) {
  Coefficients along{}, across{};
  along[first] = across[first + 1] = 1.0;
  fit.second = as_tensor(c[first], c[first + 1]);
  fit.second_error =
      as_tensor(covariance.deviation(along), covariance.deviation(across)).cwiseAbs();
}

/// What each contact weighs, and where it is evaluated.
struct Plan {
  std::vector<double> weight;
  std::vector<Vec3> place;
  bool projected = true;

  Plan(std::span<const Vec3> normals, int arcs, Estimator estimator)
      : place(normals.begin(), normals.end()), projected(estimator != Estimator::unbiased) {
    const DirectionGroups groups(SpherePartition::polar(1, arcs), normals);
    const auto density = fit_plane_orientations(normals);
    for (std::size_t c = 0; c < normals.size(); ++c) {
      if (estimator == Estimator::published)
        place[c] = groups.partition().direction(groups.group(c));
      const double relative = 1.0 + normals[c].dot(density->second * normals[c]);
      weight.push_back(estimator == Estimator::contact_sums
                           ? 1.0 / (static_cast<double>(normals.size()) * relative)
                           : groups.contact_weight(c));
    }
    if (std::ranges::any_of(weight, [](double w) { return !(w > 0.0 && std::isfinite(w)); }))
      weight.clear();
  }
};

/// Coefficients of one component by a basis; false where they are open.
bool solved(Regression& regression, const Plan& plan, std::span<const double> values,
            Coefficients (*basis)(const Vec3&), const Coefficients& factors) {
  for (std::size_t c = 0; c < values.size(); ++c)
    regression.add(basis(plan.place[c]), values[c], plan.weight[c]);
  if (!plan.projected) return regression.least_squares();
  regression.project(factors);
  return true;
}

double model_value(const Coefficients& basis, const Coefficients& c) {
  return basis[0] * c[0] + basis[1] * c[1] + basis[2] * c[2];
}

void require_plane(std::span<const Vec3> directions) {
  for (std::size_t i = 0; i < directions.size(); ++i)
    if (!(std::abs(directions[i].norm() - 1.0) <= kUnitTolerance) || directions[i][2] != 0.0)
      throw std::invalid_argument("directions[" + std::to_string(i) +
                                  "]: must be a unit vector with z = 0");
}

}  // namespace

Mat3 plane_stress(const PlaneState& state) {
  // Vectors as numbers of the complex plane, e^(i theta) times (normal + i tangential); in
  // u = e^(-2 i theta) that is 1 + p u + q~ u~ of forces, 1 + s u + v~ u~ of branches, and the
  // density 1 + (r u + r~ u~)/2. What has no u left is the mean over the circle.
  const Complex r = as_complex(state.r);
  const Complex n = as_complex(state.n), t = as_complex(state.t);
  const Complex z = as_complex(state.z), zt = as_complex(state.zt);
  const Complex p = 0.5 * (n + t), q = 0.5 * (n - t), s = 0.5 * (z + zt), v = 0.5 * (z - zt);
  // f z: (s11 - s22) + i (s12 + s21); f~ z: (s11 + s22) + i (s12 - s21). Both over s0.
  const Complex deviator =
      p + s + 0.5 * r + 0.5 * (p * s * std::conj(r) + (p * std::conj(v) + std::conj(q) * s) * r);
  const Complex trace = 1.0 + std::conj(p) * s + q * std::conj(v) +
                        0.5 * (std::conj(r) * (q + s) + r * (std::conj(p) + std::conj(v)));
  Mat3 stress = as_tensor(deviator.real(), deviator.imag());
  stress(0, 0) += trace.real();
  stress(1, 1) += trace.real();
  stress(0, 1) += trace.imag();
  stress(1, 0) -= trace.imag();
  return state.isotropic_stress() * stress;
}

double plane_shear_ratio(const Mat3& stress) {
  const double mean = 0.5 * (stress(0, 0) + stress(1, 1));
  if (mean == 0.0) return kNotDefined;
  return amplitude(stress) / mean;
}

double amplitude(const Mat3& a) { return std::abs(as_complex(a)); }

double shear_ratio_of_small_anisotropy(const PlaneAmplitudes& a) { return 0.5 * (a.r + a.n + a.t); }

double coaxial_shear_ratio(const PlaneAmplitudes& a) {
  const double single = 0.5 * (a.r + a.n + a.z + a.t + a.zt);
  const double triple =
      0.125 * (3.0 * a.r * a.n * a.z + a.r * a.n * a.zt + a.r * a.z * a.t - a.r * a.t * a.zt);
  const double pairs = 0.5 * (a.r * a.n + a.r * a.z + a.n * a.z + a.t * a.zt);
  return (single + triple) / (1.0 + pairs);
}

std::optional<PlaneScalarFit> fit_plane_orientations(std::span<const Vec3> directions) {
  require_plane(directions);
  if (directions.empty()) return std::nullopt;
  const auto count = static_cast<double>(directions.size());
  Complex mean = 0.0;
  for (const Vec3& n : directions) mean += 2.0 / count * doubled(n);
  Covariance covariance;
  for (const Vec3& n : directions) {
    const Complex off = (2.0 * doubled(n) - mean) / count;
    covariance.add({off.real(), off.imag()});
  }
  covariance.correct(directions.size(), 1);
  PlaneScalarFit found;
  found.mean = 0.5 / std::numbers::pi;
  set_tensor(found, {mean.real(), mean.imag()}, covariance, 0);
  return found;
}

std::optional<PlaneVectorFit> fit_plane_vectors(std::span<const Vec3> normals,
                                                std::span<const Vec3> vectors, int arcs,
                                                Estimator estimator) {
  require_plane(normals);
  if (arcs < 4) throw std::invalid_argument("arcs = " + std::to_string(arcs) + ": must be >= 4");
  const std::vector<double> along = normal_components(normals, vectors);
  std::vector<double> across;
  for (std::size_t c = 0; c < normals.size(); ++c)
    across.push_back(vectors[c].dot(turned_left(normals[c])));
  const Plan plan(normals, arcs, estimator);
  if (plan.weight.empty()) return std::nullopt;

  Regression normal(1 + kFree), tangential(kFree);
  if (!solved(normal, plan, along, scalar_basis, {1.0, 2.0, 2.0}) ||
      !solved(tangential, plan, across, tangential_basis, {2.0, 2.0}))
    return std::nullopt;
  const Coefficients& n = normal.coefficients();
  const Coefficients& t = tangential.coefficients();
  const double mean = n[0];
  if (mean == 0.0) return std::nullopt;
  const Coefficients relative = {mean, n[1] / mean, n[2] / mean, t[0] / mean, t[1] / mean};
  Covariance covariance;
  for (std::size_t c = 0; c < normals.size(); ++c) {
    const double weight = plan.weight[c];
    const Coefficients of_n = normal.influence(
        scalar_basis(plan.place[c]), along[c] - model_value(scalar_basis(normals[c]), n), weight);
    const Coefficients of_t =
        tangential.influence(tangential_basis(plan.place[c]),
                             across[c] - model_value(tangential_basis(normals[c]), t), weight);
    Coefficients influence = {of_n[0], of_n[1], of_n[2], of_t[0], of_t[1]};
    for (std::size_t m = 1; m <= 2 * kFree; ++m)
      influence[m] = (influence[m] - of_n[0] * relative[m]) / mean;
    covariance.add(influence);
  }
  covariance.correct(normals.size(), 1 + kFree);
  Coefficients mean_alone{};
  mean_alone[0] = 1.0;
  PlaneVectorFit found;
  found.normal.mean = found.tangential.mean = mean;
  found.normal.mean_error = covariance.deviation(mean_alone);
  set_tensor(found.normal, relative, covariance, 1);
  set_tensor(found.tangential, relative, covariance, 1 + kFree);
  return found;
}

PlaneFabric plane_fabric_of(const ContactArrays& contacts, int arcs, Estimator estimator) {
  require_sound(contacts);
  if (contacts.dimensions != 2)
    throw std::invalid_argument("dimensions = 3: fabric_of takes contacts in space");
  PlaneFabric found;
  found.stress = stress_of(contacts);
  found.contact_density = contact_density(contacts);
  found.contacts = contacts.size();
  found.normals = fit_plane_orientations(contacts.normal);
  found.force = fit_plane_vectors(contacts.normal, contacts.force, arcs, estimator);
  found.branch = fit_plane_vectors(contacts.normal, contacts.branch, arcs, estimator);
  return found;
}

std::optional<PlaneState> plane_state(const PlaneFabric& fabric) {
  if (!fabric.normals || !fabric.force || !fabric.branch) return std::nullopt;
  PlaneState state;
  state.contact_density = fabric.contact_density;
  state.force = fabric.force->normal.mean;
  state.branch = fabric.branch->normal.mean;
  state.r = fabric.normals->second;
  state.n = fabric.force->normal.second;
  state.t = fabric.force->tangential.second;
  state.z = fabric.branch->normal.second;
  state.zt = fabric.branch->tangential.second;
  return state;
}

}  // namespace tangency::inline v0::micromechanics
