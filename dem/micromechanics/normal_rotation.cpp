// SPDX-License-Identifier: MIT
#include <tangency/dem/micromechanics/normal_rotation.hpp>

#include <array>
#include <span>
#include <vector>

#include "contact_sides.hpp"

namespace tangency::inline v0::micromechanics {
namespace {

double p2(double cosine) { return legendre2(cosine * cosine); }
double p4(double cosine) {
  const double square = cosine * cosine;
  return legendre4(square, square * square);
}

/// a and b of one direction: means of these are the anisotropies.
struct Harmonics {
  Mat3 second = Mat3::Zero();
  SymmetricTensor4 fourth{};

  void add(const Harmonics& other, double weight) {
    second += weight * other.second;
    fourth += weight * other.fourth;
  }
};
Harmonics harmonics_of(const Vec3& n) {
  return {kScalarFactor2 * harmonic_part(Mat3(n * n.transpose())),
          kScalarFactor4 * harmonic_part(SymmetricTensor4::power(n))};
}

/// The model's factors with the a1 of these sides, the mean over them.
RotationFactors calculated_factors(const ContactArrays& contacts, const BodyArrays& bodies,
                                   std::span<const Side> sides, std::span<const Turned> turned) {
  const auto count = static_cast<double>(sides.size());
  double a1 = 0.0;
  for (std::size_t s = 0; s < sides.size(); ++s)
    a1 += 5.0 * p2(turned[s].axis.dot(contact_vector(contacts, sides[s]))) / count;
  RotationFactors mean, factors;
  Vec3 last = Vec3::Zero();  // most bodies have one size
  for (const Side& side : sides) {
    const Vec3& semi_axes = bodies.semi_axes[side.body];
    if (semi_axes != last) factors = space_rotation(symmetry_of(semi_axes)->spheroid).factors(a1);
    last = semi_axes;
    mean.second += factors.second / count;
    mean.fourth += factors.fourth / count;
  }
  return mean;
}

/// Deviations of what is left of both tensors, from the scatter of normals about what the axes say.
void set_errors(NormalRotation& found, std::span<const Side> sides, std::span<const Turned> turned,
                std::size_t bodies) {
  constexpr std::size_t kSecond = 9;
  ClusteredErrors errors(bodies, kSecond + SymmetricTensor4::kComponents);
  const auto count = static_cast<double>(sides.size());
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const Harmonics n = harmonics_of(turned[s].normal), u = harmonics_of(turned[s].axis);
    const double off2 = p2(turned[s].cosine) - found.second.value;
    const double off4 = p4(turned[s].cosine) - found.fourth.value;
    const Mat3 second = (n.second - found.normals) - off2 * found.axes_of_sides -
                        found.second.value * (u.second - found.axes_of_sides);
    const SymmetricTensor4 fourth = (n.fourth - found.fourth_normals) -
                                    off4 * found.fourth_axes_of_sides -
                                    found.fourth.value * (u.fourth - found.fourth_axes_of_sides);
    std::array<double, kSecond + SymmetricTensor4::kComponents> influence{};
    for (std::size_t m = 0; m < kSecond; ++m)
      influence[m] =
          second(static_cast<Eigen::Index>(m / 3), static_cast<Eigen::Index>(m % 3)) / count;
    for (std::size_t m = 0; m < SymmetricTensor4::kComponents; ++m)
      influence[kSecond + m] = fourth.components[m] / count;
    errors.add(sides[s], influence);
  }
  const std::vector<double> deviation = errors.deviations();
  for (std::size_t m = 0; m < kSecond; ++m)
    found.other_error(static_cast<Eigen::Index>(m / 3), static_cast<Eigen::Index>(m % 3)) =
        deviation[m];
  for (std::size_t m = 0; m < SymmetricTensor4::kComponents; ++m)
    found.fourth_other_error.components[m] = deviation[kSecond + m];
}

}  // namespace

std::optional<NormalRotation> normal_rotation_of(const ContactArrays& contacts,
                                                 const BodyArrays& bodies, Shape shape) {
  require_sound(contacts, bodies);
  require_dimensions(contacts, 3, "normal_rotation_of");
  if (!rotates(shape)) return std::nullopt;
  const std::vector<Side> sides = sides_of(contacts, bodies, shape);
  if (sides.empty()) return std::nullopt;
  const std::vector<Turned> turned = turned_of(contacts, bodies, sides);
  const auto count = static_cast<double>(sides.size());
  Harmonics normals, axes, of_bodies;
  std::vector<double> second, fourth;
  for (const Turned& side : turned) {
    normals.add(harmonics_of(side.normal), 1.0 / count);
    axes.add(harmonics_of(side.axis), 1.0 / count);
    second.push_back(p2(side.cosine));
    fourth.push_back(p4(side.cosine));
  }
  std::size_t alike = 0;
  for (std::size_t body = 0; body < bodies.semi_axes.size(); ++body) {
    if (shape_of(bodies.semi_axes[body]) != shape) continue;
    const std::size_t axis = symmetry_of(bodies.semi_axes[body])->axis;
    of_bodies.add(harmonics_of(axis_in_space(bodies, body, axis)), 1.0);
    ++alike;
  }
  NormalRotation found;
  found.sides = sides.size();
  found.second = mean_of(sides, second, bodies.semi_axes.size());
  found.fourth = mean_of(sides, fourth, bodies.semi_axes.size());
  found.calculated = calculated_factors(contacts, bodies, sides, turned);
  found.axes_of_bodies = of_bodies.second / static_cast<double>(alike);
  found.fourth_axes_of_bodies = 1.0 / static_cast<double>(alike) * of_bodies.fourth;
  found.axes_of_sides = axes.second;
  found.fourth_axes_of_sides = axes.fourth;
  found.normals = normals.second;
  found.fourth_normals = normals.fourth;
  found.rotated = found.second.value * axes.second;
  found.other = found.normals - found.rotated;
  found.fourth_rotated = found.fourth.value * axes.fourth;
  found.fourth_other = found.fourth_normals - found.fourth_rotated;
  set_errors(found, sides, turned, bodies.semi_axes.size());
  return found;
}

namespace {

/// cos 2 theta and sin 2 theta as a tensor; twice its mean is the anisotropy.
Mat3 plane_harmonic(const Vec3& n) {
  Mat3 a = Mat3::Zero();
  a(0, 0) = n[0] * n[0] - n[1] * n[1];
  a(1, 1) = -a(0, 0);
  a(0, 1) = a(1, 0) = 2.0 * n[0] * n[1];
  return a;
}

double cosine_twice(const Vec3& a, const Vec3& b) {
  const double along = a[0] * b[0] + a[1] * b[1], across = a[0] * b[1] - a[1] * b[0];
  return along * along - across * across;
}

void set_errors(PlaneNormalRotation& found, const ContactArrays& contacts,
                const PlaneSides& plane) {
  ClusteredErrors errors(plane.of_body.size(), 2);
  const auto count = static_cast<double>(plane.sides.size());
  for (const Side& side : plane.sides) {
    const Vec3 &n = contacts.normal[side.contact], &u = plane.of_body[side.body]->axis;
    const Mat3 off = (2.0 * plane_harmonic(n) - found.normals) -
                     (cosine_twice(n, u) - found.mean_cosine.value) * found.axes_of_sides -
                     found.mean_cosine.value * (2.0 * plane_harmonic(u) - found.axes_of_sides);
    errors.add(side, std::array{off(0, 0) / count, off(0, 1) / count});
  }
  const std::vector<double> deviation = errors.deviations();
  found.other_error(0, 0) = found.other_error(1, 1) = deviation[0];
  found.other_error(0, 1) = found.other_error(1, 0) = deviation[1];
}

}  // namespace

std::optional<PlaneNormalRotation> plane_normal_rotation_of(const ContactArrays& contacts,
                                                            const BodyArrays& bodies) {
  require_sound(contacts, bodies);
  require_dimensions(contacts, 2, "plane_normal_rotation_of");
  const PlaneSides plane = plane_sides(contacts, bodies);
  if (plane.sides.empty()) return std::nullopt;
  const auto count = static_cast<double>(plane.sides.size());
  PlaneNormalRotation found;
  found.sides = plane.sides.size();
  std::vector<double> local, turned;
  for (const Side& side : plane.sides) {
    const PlaneBody& body = *plane.of_body[side.body];
    const Vec3& n = contacts.normal[side.contact];
    local.push_back(2.0 * cosine_twice(contact_vector(contacts, side), body.axis));
    turned.push_back(cosine_twice(n, body.axis));
    found.normals += 2.0 / count * plane_harmonic(n);
    found.axes_of_sides += 2.0 / count * plane_harmonic(body.axis);
    found.arc_law_a_l += arc_law_anisotropy(body.ellipse) / count;
  }
  found.a_l = mean_of(plane.sides, local, plane.of_body.size());
  found.mean_cosine = mean_of(plane.sides, turned, plane.of_body.size());
  for (const Side& side : plane.sides)
    found.calculated -=
        plane_rotation(plane.of_body[side.body]->ellipse).factor(found.a_l.value) / count;
  double alike = 0.0;
  for (const auto& body : plane.of_body) {
    if (!body) continue;
    found.axes_of_bodies += 2.0 * plane_harmonic(body->axis);
    alike += 1.0;
  }
  found.axes_of_bodies /= alike;
  found.rotated = found.mean_cosine.value * found.axes_of_sides;
  found.other = found.normals - found.rotated;
  set_errors(found, contacts, plane);
  return found;
}

}  // namespace tangency::inline v0::micromechanics
