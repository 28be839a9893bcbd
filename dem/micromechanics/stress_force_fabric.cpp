// SPDX-License-Identifier: MIT
#include <tangency/dem/micromechanics/stress_force_fabric.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <tangency/dem/micromechanics/direction_integrals.hpp>

namespace tangency::inline v0::micromechanics {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// (a:b) I + 2 (ab + ba), which every product of two normal components leaves; (105/2) times
/// average_with.
Mat3 joint(const Mat3& a, const Mat3& b) {
  return contracted(a, b) * Mat3::Identity() + 2.0 * (a * b + b * a);
}

double sign(double x) { return x > 0.0 ? 1.0 : (x < 0.0 ? -1.0 : 0.0); }

/// Principal values by size, the largest first, and their axes.
struct Principal {
  Vec3 value;
  Mat3 axes;

  explicit Principal(const Mat3& x) {
    const Eigen::SelfAdjointEigenSolver<Mat3> solved(0.5 * (x + x.transpose()));
    std::array<int, 3> order = {0, 1, 2};
    std::ranges::sort(order, [&](int i, int j) {
      return std::abs(solved.eigenvalues()[i]) > std::abs(solved.eigenvalues()[j]);
    });
    for (int k = 0; k < 3; ++k) {
      value[k] = solved.eigenvalues()[order[static_cast<std::size_t>(k)]];
      axes.col(k) = solved.eigenvectors().col(order[static_cast<std::size_t>(k)]);
    }
  }
};

double angle_deg(const Vec3& u, const Vec3& v) {
  return std::atan2(u.cross(v).norm(), std::abs(u.dot(v))) / kDegree;
}

/// A point of the rule of Gauss and Legendre on -1 to 1.
struct Node {
  double place, weight;
};

/// With eight points: exact to degree 15, and models of orders 2 and 4 have 14 in cos(beta).
std::array<Node, 8> gauss_legendre() {
  std::array<Node, 8> nodes{};
  constexpr auto count = static_cast<int>(nodes.size());
  for (int k = 0; k < count; ++k) {
    double x = std::cos(std::numbers::pi * (k + 0.75) / (count + 0.5)), slope = 0.0;
    for (int step = 0; step < 8; ++step) {  // Newton: doubles the digits, four suffice
      double before = 1.0, now = x;
      for (int m = 2; m <= count; ++m) {
        const double next = ((2.0 * m - 1.0) * x * now - (m - 1.0) * before) / m;
        before = now;
        now = next;
      }
      slope = count * (x * now - before) / (x * x - 1.0);
      x -= now / slope;
    }
    nodes[static_cast<std::size_t>(k)] = {x, 2.0 / ((1.0 - x * x) * slope * slope)};
  }
  return nodes;
}

}  // namespace

std::optional<SecondOrderState> second_order_state(const Fabric& fabric) {
  if (!fabric.normals || !fabric.force || !fabric.branch) return std::nullopt;
  SecondOrderState state;
  state.contact_density = fabric.contact_density;
  state.force = fabric.force->normal.model.mean;
  state.branch = fabric.branch->normal.model.mean;
  state.r = fabric.normals->model.second;
  state.n = fabric.force->normal.model.second;
  state.t = fabric.force->tangential.model.second;
  state.z = fabric.branch->normal.model.second;
  state.zt = fabric.branch->tangential.model.second;
  return state;
}

Mat3 StressParts::seven() const {
  return isotropic + fabric + branch + force + fabric_branch + fabric_force + force_branch;
}

StressParts stress_parts(const SecondOrderState& state) {
  const Mat3 &r = state.r, &t = state.t, &zt = state.zt;
  const Mat3 df = state.n - state.t, dz = state.z - state.zt;
  const double s0 = state.isotropic_stress(), single = 0.4 * s0, pair = 2.0 / 35.0 * s0;
  StressParts parts;
  parts.isotropic = s0 * Mat3::Identity();
  parts.fabric = single * r;
  parts.branch = single * (state.z + 1.5 * zt);
  parts.force = single * (state.n + 1.5 * t);
  parts.fabric_branch = pair * (7.0 * r * zt + joint(r, dz));
  parts.fabric_force = pair * (7.0 * t * r + joint(r, df));
  parts.force_branch = pair * (17.5 * t * zt + 7.0 * (t * dz + df * zt) + joint(df, dz));
  const Mat3 normal = contracted(df, dz) * r + contracted(r, dz) * df + contracted(r, df) * dz;
  parts.fabric_force_branch =
      2.0 / 315.0 * s0 *
      (63.0 * t * r * zt + 9.0 * (t * joint(r, dz) + joint(r, df) * zt) + 2.0 * normal +
       4.0 * sum_of_products(r, df, dz) + 4.0 * (r * df * dz).trace() * Mat3::Identity());
  return parts;
}

double mean_stress(const SecondOrderState& state) {
  const double pairs = contracted(state.r, state.n) + contracted(state.r, state.z) +
                       contracted(state.n, state.z) + 1.5 * contracted(state.t, state.zt);
  return state.isotropic_stress() * (1.0 + 2.0 / 15.0 * pairs);
}

Mat3 deviatoric_stress(const SecondOrderState& state) {
  const Mat3 &r = state.r, &t = state.t, &zt = state.zt;
  const Mat3 df = state.n - state.t, dz = state.z - state.zt;
  const Mat3 single = r + state.z + 1.5 * zt + state.n + 1.5 * t;
  const Mat3 pairs = 7.0 * r * zt + 4.0 * r * dz + 7.0 * r * t + 4.0 * r * df + 17.5 * t * zt +
                     7.0 * t * dz + 7.0 * df * zt + 4.0 * dz * df;
  return state.isotropic_stress() * (0.4 * single + 2.0 / 35.0 * harmonic_part(pairs));
}

Mat3 stress_of_models(double contact_density, const ScalarHarmonics& density,
                      const ScalarHarmonics& force, const TangentialHarmonics& tangential_force,
                      const ScalarHarmonics& branch, const TangentialHarmonics& tangential_branch) {
  static const std::array<Node, 8> kHeights = gauss_legendre();
  constexpr int kTurns = 16;  // exact to degree 15 in the angle about the axis
  Mat3 sum = Mat3::Zero();
  for (const Node& height : kHeights)
    for (int turn = 0; turn < kTurns; ++turn) {
      const double angle = 2.0 * std::numbers::pi * turn / kTurns;
      const double across = std::sqrt(1.0 - height.place * height.place);
      const Vec3 n(across * std::cos(angle), across * std::sin(angle), height.place);
      const Vec3 f = force.value(n) * n + tangential_force.value(n);
      const Vec3 z = branch.value(n) * n + tangential_branch.value(n);
      sum += height.weight * density.value(n) * f * z.transpose();
    }
  return 0.5 * contact_density * 2.0 * std::numbers::pi / kTurns * sum;
}

double shear_stress_ratio(const Mat3& stress) {
  const double mean = stress.trace() / 3.0;
  if (mean == 0.0) return kNotDefined;
  return std::sqrt(1.5) * harmonic_part(stress).norm() / mean;
}

double shear_stress_ratio_of_friction_angle(double degrees) {
  const double sine = std::sin(degrees * kDegree);
  return 6.0 * sine / (3.0 - sine);
}

double friction_angle_of_shear_stress_ratio(double ratio) {
  return std::asin(3.0 * ratio / (6.0 + ratio)) / kDegree;
}

ShearShares shear_shares(const SecondOrderState& state, bool eighth) {
  const StressParts parts = stress_parts(state);
  const Mat3 whole = eighth ? parts.sum() : parts.seven();
  const Mat3 deviator = harmonic_part(whole);
  const double scale = std::sqrt(1.5) / (deviator.norm() * whole.trace() / 3.0);
  const auto share = [&](const Mat3& part) {
    return scale * contracted(harmonic_part(part), deviator);
  };
  const double single = 0.4 * state.isotropic_stress();
  ShearShares shares;
  shares.r = share(parts.fabric);
  shares.z = share(single * state.z);
  shares.zt = share(1.5 * single * state.zt);
  shares.n = share(single * state.n);
  shares.t = share(1.5 * single * state.t);
  shares.rz = share(parts.fabric_branch);
  shares.rf = share(parts.fabric_force);
  shares.zf = share(parts.force_branch);
  shares.rfz = eighth ? share(parts.fabric_force_branch) : 0.0;
  return shares;
}

SignedMagnitudes signed_magnitudes(const SecondOrderState& state) {
  const auto magnitude = [&](const Mat3& x) { return sign(contracted(x, state.r)) * modulus(x); };
  SignedMagnitudes a;
  a.r = modulus(state.r);
  a.z = magnitude(state.z);
  a.zt = magnitude(state.zt);
  a.n = magnitude(state.n);
  a.t = magnitude(state.t);
  a.sense = sign(state.r.col(0).cross(state.r.col(1)).dot(state.r.col(2)));
  return a;
}

double mean_stress_factor(const SignedMagnitudes& a) {
  return 1.0 + 2.0 / 15.0 * (a.r * a.n + a.r * a.z + a.n * a.z + 1.5 * a.t * a.zt);
}

ShearShares axisymmetric_shares(const SignedMagnitudes& a) {
  const double factor = mean_stress_factor(a);
  const double c = std::sqrt(1.5) * 0.4 / factor;
  // (XY)' of two axisymmetric deviators has the size |X||Y|/sqrt(6), and the sense of the axis.
  const double d = std::sqrt(1.5) * 2.0 / 35.0 * a.sense / std::sqrt(6.0) / factor;
  ShearShares shares;
  shares.r = c * a.r;
  shares.z = c * a.z;
  shares.zt = 1.5 * c * a.zt;
  shares.n = c * a.n;
  shares.t = 1.5 * c * a.t;
  shares.rz = d * a.r * (4.0 * a.z + 3.0 * a.zt);
  shares.rf = d * a.r * (4.0 * a.n + 3.0 * a.t);
  shares.zf = d * (4.0 * a.n * a.z + 3.0 * a.t * a.z + 3.0 * a.n * a.zt + 7.5 * a.t * a.zt);
  return shares;
}

int joint_sign(const Mat3& x, const Mat3& y, const Mat3& r) {
  return static_cast<int>(sign(contracted(harmonic_part(x * y), r)));
}

Coaxiality coaxiality(const Mat3& x, const Mat3& y) {
  const Principal of_x(x), of_y(y);
  Coaxiality found;
  found.axial_deg = angle_deg(of_x.axes.col(0), of_y.axes.col(0));
  std::array<int, 3> order = {0, 1, 2};
  double nearest = -1.0;
  do {
    double together = 0.0;
    std::array<double, 3> angles{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 u = of_x.axes.col(static_cast<Eigen::Index>(k)), v = of_y.axes.col(order[k]);
      together += std::abs(u.dot(v));
      angles[k] = angle_deg(u, v);
    }
    if (together > nearest) {
      nearest = together;
      found.angles_deg = angles;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  std::ranges::sort(found.angles_deg);
  found.commutator = (x * y - y * x).norm() / (x.norm() * y.norm());
  return found;
}

double departure_from_axisymmetry(const Mat3& x) {
  const Vec3 value = Principal(x).value;
  return std::abs(value[1] - value[2]) / std::abs(value[0]);
}

}  // namespace tangency::inline v0::micromechanics
