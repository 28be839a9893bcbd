// SPDX-License-Identifier: MIT
#include <tangency/dem/micromechanics/averages.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <tangency/dem/micromechanics/distributions.hpp>
#include <tangency/dem/micromechanics/spheroid.hpp>

#include "contact_sides.hpp"

namespace tangency::inline v0::micromechanics {
namespace {

/// With the harmonics of order 4 left out.
template <class Model>
Model of_order_two(Model model) {
  model.fourth = {};
  return model;
}

template <class Model>
TensorEstimate estimate(const Model& model, const HarmonicErrors& error) {
  TensorEstimate found;
  found.mean = model.mean;
  found.mean_error = error.mean;
  found.second = model.second;
  found.second_error = error.second;
  found.fourth = model.fourth;
  found.fourth_error = error.fourth;
  return found;
}

TensorEstimate estimate(const PlaneScalarFit& fit) {
  TensorEstimate found;
  found.mean = fit.mean;
  found.mean_error = fit.mean_error;
  found.second = fit.second;
  found.second_error = fit.second_error;
  return found;
}

/// Of directions, in space or in the plane.
Averages::Tensor of_directions(std::span<const Vec3> directions, int dimensions) {
  if (dimensions == 2) {
    const auto fit = fit_plane_orientations(directions);
    return fit ? Averages::Tensor(estimate(*fit)) : std::nullopt;
  }
  const auto fit = fit_orientations(directions);
  return fit ? Averages::Tensor(estimate(fit->model, fit->error)) : std::nullopt;
}

Averages::Tensor of_scalars(const DirectionGroups& groups, std::span<const double> values,
                            Estimator estimator) {
  const auto fit = fit_scalars(groups, values, estimator);
  if (!fit) return std::nullopt;
  TensorEstimate found = estimate(fit->model, fit->error);
  found.unexplained2 = unexplained_variance(groups, values, of_order_two(fit->model));
  found.unexplained4 = fit->unexplained;
  return found;
}

struct VectorEstimate {
  Averages::Tensor normal, tangential;
  double asymmetry = kNotDefined;
};

VectorEstimate of_vectors(const DirectionGroups& groups, std::span<const Vec3> vectors,
                          Estimator estimator) {
  const auto fit = fit_vectors(groups, vectors, estimator);
  if (!fit) return {};
  const std::vector<double> along = normal_components(groups.normals(), vectors);
  const std::vector<Vec3> across = tangential_components(groups.normals(), vectors);
  VectorEstimate found;
  found.normal = estimate(fit->normal.model, fit->normal.error);
  found.normal->unexplained2 = unexplained_variance(groups, along, of_order_two(fit->normal.model));
  found.normal->unexplained4 = fit->normal.unexplained;
  found.tangential = estimate(fit->tangential.model, fit->tangential.error);
  found.tangential->unexplained2 =
      unexplained_variance(groups, across, of_order_two(fit->tangential.model));
  found.tangential->unexplained4 = fit->tangential.unexplained;
  found.asymmetry = fit->tangential.asymmetry;
  return found;
}

void average_in_space(Averages& found, const ContactArrays& contacts, const Classes& classes,
                      Estimator estimator) {
  const DirectionGroups groups(classes.partition(), contacts.normal);
  found.classes = groups.partition().size();
  found.empty_classes = groups.empty_classes();
  if (found.normals) {
    const ScalarHarmonics density{found.normals->mean, found.normals->second,
                                  *found.normals->fourth};
    found.normals->unexplained2 = unexplained_variance(groups, of_order_two(density));
    found.normals->unexplained4 = unexplained_variance(groups, density);
  }
  const VectorEstimate force = of_vectors(groups, contacts.force, estimator);
  found.force_normal = force.normal;
  found.force_tangential = force.tangential;
  found.force_asymmetry = force.asymmetry;
  const VectorEstimate branch = of_vectors(groups, contacts.branch, estimator);
  found.branch_normal = branch.normal;
  found.branch_tangential = branch.tangential;
  found.branch_asymmetry = branch.asymmetry;
  found.branch_length = of_scalars(groups, lengths(contacts.branch), estimator);
}

void average_in_plane(Averages& found, const ContactArrays& contacts, const Classes& classes,
                      Estimator estimator) {
  const int arcs = classes.arcs();
  found.classes = static_cast<std::size_t>(arcs);
  // As plane.cpp sorts them.
  found.empty_classes =
      DirectionGroups(SpherePartition::polar(1, arcs), contacts.normal).empty_classes();
  const auto fit = [&](std::span<const Vec3> vectors) {
    return fit_plane_vectors(contacts.normal, vectors, arcs, estimator);
  };
  if (const auto force = fit(contacts.force)) {
    found.force_normal = estimate(force->normal);
    found.force_tangential = estimate(force->tangential);
  }
  if (const auto branch = fit(contacts.branch)) {
    found.branch_normal = estimate(branch->normal);
    found.branch_tangential = estimate(branch->tangential);
  }
  std::vector<Vec3> along(contacts.size());
  for (std::size_t c = 0; c < along.size(); ++c)
    along[c] = contacts.branch[c].norm() * contacts.normal[c];
  if (const auto length = fit(along)) found.branch_length = estimate(length->normal);
}

/// Contact vectors in body axes, of the bodies that have an axis that tells how they lie.
std::vector<Vec3> local_contact_vectors(const ContactArrays& contacts, const BodyArrays& bodies) {
  std::vector<bool> asked;
  asked.reserve(bodies.semi_axes.size());
  for (const Vec3& semi_axes : bodies.semi_axes)
    asked.push_back(telling_axis(semi_axes, contacts.dimensions).has_value());
  std::vector<Vec3> found;
  for (const Side& side : sides_of(contacts, asked))
    found.push_back(local_vector(contacts, bodies, side));
  return found;
}

std::vector<Vec3> long_axes_of(const BodyArrays& bodies, int dimensions) {
  std::vector<Vec3> found;
  for (std::size_t i = 0; i < bodies.semi_axes.size(); ++i) {
    if (dimensions == 2) {
      if (const auto body = plane_body(bodies, i)) found.push_back(body->axis);
    } else if (const auto axis = telling_axis(bodies.semi_axes[i])) {
      found.push_back(axis_in_space(bodies, i, static_cast<std::size_t>(*axis)));
    }
  }
  return found;
}

/// That of all bodies that have one.
std::optional<int> common_axis(const BodyArrays& bodies, int dimensions) {
  std::optional<int> common;
  for (const Vec3& semi_axes : bodies.semi_axes)
    if (const auto axis = telling_axis(semi_axes, dimensions)) {
      if (common && *common != *axis) return std::nullopt;
      common = axis;
    }
  return common;
}

/// SecondOrderState and PlaneState have the same members; empty where a tensor is.
template <class State>
std::optional<State> state_of(const Averages& averages) {
  if (!averages.normals || !averages.force_normal || !averages.branch_normal) return std::nullopt;
  State state;
  state.contact_density = averages.contact_density;
  state.force = averages.force_normal->mean;
  state.branch = averages.branch_normal->mean;
  state.r = averages.normals->second;
  state.n = averages.force_normal->second;
  state.t = averages.force_tangential->second;
  state.z = averages.branch_normal->second;
  state.zt = averages.branch_tangential->second;
  return state;
}

}  // namespace

SpherePartition Classes::partition() const {
  return kind == Kind::near_uniform ? SpherePartition::near_uniform(count)
                                    : SpherePartition::polar(count, 2 * count);
}

std::optional<int> telling_axis(const Vec3& semi_axes, int dimensions) {
  const double a = semi_axes[0], b = semi_axes[1];
  if (dimensions == 2) {
    if (are_equal_axes(a, b)) return std::nullopt;
    return a > b ? 0 : 1;
  }
  if (shape_of(semi_axes) == Shape::sphere) return std::nullopt;
  if (const auto symmetry = symmetry_of(semi_axes)) return static_cast<int>(symmetry->axis);
  Eigen::Index longest = 0;
  semi_axes.maxCoeff(&longest);
  return static_cast<int>(longest);
}

std::optional<Mat3> Averages::stress_of_both_orders() const {
  if (!normals || !force_normal || !branch_normal || !normals->fourth) return std::nullopt;
  const auto scalar = [](const TensorEstimate& x) {
    return ScalarHarmonics{x.mean, x.second, *x.fourth};
  };
  const auto tangential = [](const TensorEstimate& x) {
    return TangentialHarmonics{x.mean, x.second, *x.fourth};
  };
  return stress_of_models(contact_density, scalar(*normals), scalar(*force_normal),
                          tangential(*force_tangential), scalar(*branch_normal),
                          tangential(*branch_tangential));
}

Averages averages_of(const ContactArrays& contacts, const BodyArrays& bodies,
                     const Classes& classes, Estimator estimator) {
  require_sound(contacts);
  const int dimensions = contacts.dimensions;
  Averages found;
  found.stress = stress_of(contacts);
  found.contact_density = contact_density(contacts);
  found.normals = of_directions(contacts.normal, dimensions);
  if (dimensions == 2)
    average_in_plane(found, contacts, classes, estimator);
  else
    average_in_space(found, contacts, classes, estimator);
  if (!contacts.arm.empty())
    found.contact_vectors = of_directions(contact_vectors(contacts), dimensions);
  if (bodies.orientation.empty() && bodies.semi_axes.empty()) return found;
  require_sound(bodies, contacts.particles, dimensions);
  found.body_axis = common_axis(bodies, dimensions);
  found.long_axes = of_directions(long_axes_of(bodies, dimensions), dimensions);
  if (!contacts.arm.empty() && !contacts.bodies.empty())
    found.local_contacts = of_directions(local_contact_vectors(contacts, bodies), dimensions);
  return found;
}

std::optional<SecondOrderState> second_order_state(const Averages& averages, int dimensions) {
  return dimensions == 3 ? state_of<SecondOrderState>(averages) : std::nullopt;
}

std::optional<PlaneState> plane_state(const Averages& averages, int dimensions) {
  return dimensions == 2 ? state_of<PlaneState>(averages) : std::nullopt;
}

}  // namespace tangency::inline v0::micromechanics
