// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/families/displacement.hpp>

#include <Eigen/LU>

#include <cassert>
#include <cmath>

namespace tangency::inline v0::verify {
namespace {

using Mat2 = Eigen::Matrix2d;
using Basis = Eigen::Matrix<double, 3, 2>;

/// Second derivative of the support function, M/h - (M n)(M n)'/h^3; it maps n to 0.
Mat3 support_hessian(const Ellipsoid& body, const Vec3& n) {
  const double h = body.support(n);
  const Vec3 point = body.support_point(n);  // M n / h
  return (body.shape().matrix() - point * point.transpose()) / h;
}

DisplacementContact contact_of(std::string_view name, double short_over_long, double overlap,
                               const Vec3& long_axis_a, const Vec3& long_axis_b) {
  const Vec3 semi_axes(1.0 / short_over_long, 1.0, 1.0);
  // The shortest turn from x, the long body axis, to `axis`; not normalised, which an Ellipsoid
  // does not ask for.
  const auto along = [](const Vec3& axis) {
    const Vec3 u = axis.normalized(), turn = Vec3::UnitX().cross(u);
    return Eigen::Quaterniond(1.0 + u.x(), turn.x(), turn.y(), turn.z());
  };
  const Vec3 normal = Vec3::UnitZ();
  const Ellipsoid a(Vec3::Zero(), semi_axes, along(long_axis_a));
  const Ellipsoid b(Vec3::Zero(), semi_axes, along(long_axis_b));
  const Vec3 centre = a.support_point(normal) - overlap * normal + b.support_point(normal);
  return {name, a, b.moved_to(centre), normal, overlap, Vec3::UnitX(), Vec3::UnitY()};
}

}  // namespace

std::vector<DisplacementContact> displacement_contacts(double short_over_long, double overlap) {
  assert(short_over_long > 0.0 && short_over_long <= 1.0);
  assert(overlap > 0.0 && overlap < 2.0 * short_over_long * short_over_long);
  const Vec3 side = Vec3::UnitX(), end = Vec3::UnitZ();
  return {
      contact_of("side-side", short_over_long, overlap, side, side),
      contact_of("side-end", short_over_long, overlap, side, end),
      contact_of("end-end", short_over_long, overlap, end, end),
      // Chosen so that no plane of symmetry is left and neither body turns about an own axis.
      contact_of("skew", short_over_long, overlap, {2.0, 1.0, 1.0}, {2.0, -2.0, 1.0}),
  };
}

std::string_view to_string(Motion motion) {
  switch (motion) {
    case Motion::normal:
      return "normal";
    case Motion::tangential:
      return "tangential";
    case Motion::rotation:
      break;
  }
  return "rotation";
}

Ellipsoid displaced(const DisplacementContact& contact, Motion motion, double amount) {
  const Ellipsoid& b = contact.b;
  switch (motion) {
    case Motion::normal:
      return b.moved_to(b.centre() + amount * contact.normal);
    case Motion::tangential:
      return b.moved_to(b.centre() + amount * contact.tangent);
    case Motion::rotation:
      break;
  }
  // In long double, so that the doubles are the same with every libm.
  const long double half = 0.5L * static_cast<long double>(amount);
  const Vec3 vector = static_cast<double>(std::sin(half)) * contact.rotation_axis;
  const Eigen::Quaterniond turn(static_cast<double>(std::cos(half)), vector.x(), vector.y(),
                                vector.z());
  return {b.centre(), b.semi_axes(), turn * b.orientation()};
}

// The overlap is the least value over unit m of psi(m, s) = h_A(m) + h_B(m, s) - m . d(s). With n
// the minimum at s = 0, psi_s and psi_ss its derivatives in s, v that of its gradient in m, and K
// its second derivative in m, the latter two in the tangent plane,
//     slope = psi_s,    curvature = psi_ss - v' K^-1 v    (the envelope theorem).
// K = Hess h_A + Hess h_B - overlap P, the last term from the sphere's own curvature: psi is
// homogeneous of degree 1 in m and equals the overlap at n.
OverlapExpansion expected_overlap(const DisplacementContact& contact, Motion motion) {
  const Vec3& n = contact.normal;
  if (motion == Motion::normal) return {-1.0, 0.0};  // n stays the minimum: v = 0

  double slope = 0.0, second = 0.0;
  Vec3 v = -contact.tangent;  // tangential: d = d_0 + s t, psi_s = -n . t = 0
  const Mat3 hessian_b = support_hessian(contact.b, n);
  if (motion == Motion::rotation) {
    // h_B(m, s) = h_B(R(s)' m), R(s)' m = m - s w x m + s^2/2 w x (w x m) + ...; h_B's gradient is
    // its support point x, and p_B - c_B = -x because B's normal points against n.
    const Vec3& w = contact.rotation_axis;
    const Vec3 x = contact.b.support_point(n), turn = w.cross(n);
    slope = n.dot((-x).cross(w));
    second = turn.dot(hessian_b * turn) + x.dot(w.cross(turn));
    v = w.cross(x) - hessian_b * turn;
  }
  Basis basis;
  basis.col(0) = n.unitOrthogonal();
  basis.col(1) = n.cross(basis.col(0));
  const Mat2 k = basis.transpose() * (support_hessian(contact.a, n) + hessian_b) * basis -
                 contact.overlap * Mat2::Identity();
  const Eigen::Vector2d in_plane = basis.transpose() * v;
  return {slope, second - in_plane.dot(k.inverse() * in_plane)};
}

double published_overlap(const DisplacementContact& contact, Motion motion, double amount) {
  const double z = (contact.b.centre() - contact.a.centre()).norm();
  switch (motion) {
    case Motion::normal:
      return contact.overlap - amount;
    case Motion::tangential:
      return contact.overlap + z - std::hypot(z, amount);
    case Motion::rotation:
      break;
  }
  return contact.overlap + expected_overlap(contact, motion).slope * amount;
}

}  // namespace tangency::inline v0::verify
