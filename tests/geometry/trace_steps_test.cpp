// SPDX-License-Identifier: GPL-3.0-or-later
/// The published scheme done once more, step by step and without a formula of geometry/: curves are
/// sampled and bisected against B's level function, the corners' plane is a cross product, the line
/// is bisected too. Slow, and for bodies of distinct semi-axes whose published cone is good.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <vector>

#include <tangency/geometry/trace_contact.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/manufactured.hpp>

namespace tangency {
namespace {

using Function = std::function<double(double)>;

/// Where f, negative at low and positive at high or the other way round, changes sign.
double bisected(const Function& f, double low, double high) {
  const bool rising = f(low) < 0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    ((f(middle) < 0) == rising ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// The changes of sign between low and high, by samples.
std::vector<double> changes(const Function& f, double low, double high) {
  constexpr int kSamples = 2000;
  std::vector<double> found;
  for (int i = 0; i < kSamples; ++i) {
    const double left = low + (high - low) * i / kSamples;
    const double right = low + (high - low) * (i + 1) / kSamples;
    if ((f(left) < 0) != (f(right) < 0)) found.push_back(bisected(f, left, right));
  }
  return found;
}

/// A in its own frame: columns by decreasing semi-axis.
struct Surface {
  Vec3 radii;
  Mat3 axes;
  explicit Surface(const Ellipsoid& e) {
    std::array<int, 3> order{0, 1, 2};
    std::ranges::sort(order, [&](int i, int j) { return e.semi_axes()[i] > e.semi_axes()[j]; });
    for (int k = 0; k < 3; ++k) {
      radii[k] = e.semi_axes()[order[static_cast<std::size_t>(k)]];
      axes.col(k) = e.rotation().col(order[static_cast<std::size_t>(k)]);
    }
  }
  Vec3 point(double theta, double phi) const {
    return axes * radii.cwiseProduct(Vec3(std::cos(theta) * std::sin(phi),
                                          std::sin(theta) * std::sin(phi), std::cos(phi)));
  }
  double theta_of(const Vec3& direction) const {
    const Vec3 y = (axes.transpose() * direction).cwiseQuotient(radii);
    return std::atan2(y.y(), y.x());
  }
};

/// The limits of theta in the cone about d, by samples of its rim; nothing where it holds the pole.
std::optional<std::array<double, 2>> theta_in_cone(const Surface& surface, const Vec3& d,
                                                   double cosine) {
  const Vec3 axis = d.normalized(), u = axis.unitOrthogonal(), v = axis.cross(u);
  if (std::abs(axis.dot(surface.axes.col(2))) >= cosine) return std::nullopt;
  const double centre = surface.theta_of(axis), sine = std::sqrt(1 - cosine * cosine);
  const auto offset = [&](double t) {
    const Vec3 rim = cosine * axis + sine * (std::cos(t) * u + std::sin(t) * v);
    return std::remainder(surface.theta_of(rim) - centre, 2 * M_PI);
  };
  constexpr int kRim = 20000;
  double low = 0, high = 0;
  for (int i = 0; i < kRim; ++i) {
    low = std::min(low, offset(2 * M_PI * i / kRim));
    high = std::max(high, offset(2 * M_PI * i / kRim));
  }
  return {{centre + low, centre + high}};
}

struct Steps {
  double depth;
  Vec3 normal;
};

/// The scheme where the middle theta-curve has one arc in B; nothing elsewhere.
std::optional<Steps> by_steps(const Ellipsoid& a, const Ellipsoid& b) {
  const Surface surface(a);
  const Vec3 d = b.centre() - a.centre();
  const double distance = d.norm(), r = a.largest_semi_axis(), s = b.largest_semi_axis();
  const double cosine = (distance * distance + r * r - s * s) / (2 * distance * r);
  if (cosine <= 0 || cosine >= 1) return std::nullopt;
  const auto box = theta_in_cone(surface, d, cosine);
  if (!box) return std::nullopt;
  const auto level = [&](const Vec3& x) { return b.level(a.centre() + x) - 1; };
  const double theta = 0.5 * ((*box)[0] + (*box)[1]);
  const auto phi = changes([&](double t) { return level(surface.point(theta, t)); }, 0, M_PI);
  if (phi.size() != 2) return std::nullopt;
  const double middle = 0.5 * (phi[0] + phi[1]);
  const Function along = [&](double t) { return level(surface.point(theta + t, middle)); };
  const auto after = changes(along, 0, M_PI), before = changes(along, 0, -M_PI);
  if (after.empty() || before.empty()) return std::nullopt;
  const double theta_1 = theta + before.front(), theta_2 = theta + after.front();
  const Vec3 c1 = surface.point(theta_1, phi[0]), c2 = surface.point(theta_2, phi[0]),
             c3 = surface.point(theta_2, phi[1]), c4 = surface.point(theta_1, phi[1]);
  const Vec3 centroid = 0.25 * (c1 + c2 + c3 + c4);
  Vec3 normal = (c3 - c1).cross(c4 - c2).normalized();
  if (normal.dot(centroid) < 0) normal = -normal;
  const double far = 2 * (r + s + distance);
  const auto on_line = [&](const Ellipsoid& e) {
    return changes([&](double t) { return e.level(a.centre() + centroid + t * normal) - 1; }, -far,
                   far);
  };
  const auto p = on_line(a), q = on_line(b);
  if (p.size() != 2 || q.size() != 2) return std::nullopt;
  double depth = far;
  for (const double p_i : p) {
    for (const double q_j : q) depth = std::min(depth, std::abs(p_i - q_j));
  }
  return Steps{depth, normal};
}

TEST(TraceContact, IsThePublishedSchemeDoneByStepsWithoutItsFormulas) {
  verify::ContactFamily family = verify::contact_classes()[1];
  family.aspect = 2.5;
  verify::ManufacturedContacts contacts(family, 20261122);
  int compared = 0;
  double worst = 0;
  for (int i = 0; i < 400; ++i) {
    const auto c = contacts.next();
    if (c.gap > -0.005 * c.smallest_semi_axis) continue;
    const Ellipsoid a = verify::to_ellipsoid(c.a), b = verify::to_ellipsoid(c.b);
    const auto steps = by_steps(a, b);
    const TraceContact t = trace_contact(a, b);
    if (!steps || t.status != TraceStatus::ok) continue;
    ++compared;
    // The limits of the cone are sampled: 1e-8 of a turn, and the depth follows them.
    EXPECT_EQ(t.curves, 1);
    EXPECT_NEAR(-t.gap, steps->depth, 1e-7 * steps->depth) << i;
    EXPECT_LE((t.normal - steps->normal).norm(), 1e-6) << i;
    worst = std::max(worst, std::abs(-t.gap / steps->depth - 1));
  }
  EXPECT_GE(compared, 40);
  std::printf("compared %d, largest relative difference of depth %.1e\n", compared, worst);
}

}  // namespace
}  // namespace tangency
