// SPDX-License-Identifier: MIT
#include <tangency/dem/micromechanics/contact_statistics.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "contact_sides.hpp"
#include "spheroid_integrals.hpp"

namespace tangency::inline v0::micromechanics {
namespace {

using std::numbers::pi;

double p2(double cosine) { return legendre2(cosine * cosine); }

/// The share of contact vectors that are longer, from the share within beta of one end.
template <typename Distribution>
double longer_by(const Spheroid& s, double length, Distribution within) {
  if (length < std::min(s.along, s.across)) return 1.0;
  const auto beta = angle_of_length(s, length);
  if (!beta) return 0.0;
  const double both_ends = 2.0 * within(*beta);
  return s.along > s.across ? both_ends : 1.0 - both_ends;
}

/// Lengths that part short from intermediate, and intermediate from long.
std::array<double, 2> class_borders(double shortest, double longest) {
  const double third = (longest - shortest) / 3.0;
  return {shortest + third, longest - third};
}

template <typename Distribution>
std::optional<LengthShares> shares_by(const Spheroid& s, Distribution within) {
  require_sound(s);
  if (s.along == s.across) return std::nullopt;
  const auto border = class_borders(std::min(s.along, s.across), std::max(s.along, s.across));
  const double above_first = longer_by(s, border[0], within);
  const double above_second = longer_by(s, border[1], within);
  return LengthShares{1.0 - above_first, above_first - above_second, above_second};
}

/// A(beta)/A(pi).
double area_share(const Spheroid& s, double beta) {
  return surface_within(s, beta) / surface_within(s, pi);
}

}  // namespace

double local_density(double a1, double beta) { return 0.25 / pi * (1.0 + a1 * p2(std::cos(beta))); }

double local_distribution(double a1, double beta) {
  const double c = std::cos(beta);
  return 0.5 * (1.0 - c + 0.5 * a1 * c * std::sin(beta) * std::sin(beta));
}

double local_angle(double a1, double g) {
  if (!(a1 >= -1.0 && a1 <= 2.0))
    throw std::invalid_argument("a1 = " + std::to_string(a1) + ": must be -1 to 2");
  if (!(g >= 0.0 && g <= 1.0))
    throw std::invalid_argument("g = " + std::to_string(g) + ": must be 0 to 1");
  // G grows everywhere: halve the interval until no double is between.
  double below = 0.0, above = pi;
  for (;;) {
    const double middle = 0.5 * (below + above);
    if (!(below < middle && middle < above)) return middle;
    (local_distribution(a1, middle) < g ? below : above) = middle;
  }
}

double longer_share(const Spheroid& s, double a1, double length) {
  require_sound(s);
  return longer_by(s, length, [a1](double beta) { return local_distribution(a1, beta); });
}

std::optional<LengthShares> length_shares(const Spheroid& s, double a1) {
  return shares_by(s, [a1](double beta) { return local_distribution(a1, beta); });
}

std::optional<LengthShares> length_shares_by_area(const Spheroid& s) {
  return shares_by(s, [&s](double beta) { return area_share(s, beta); });
}

PairShares pair_shares(const LengthShares& f) {
  return {f[0] * f[0], 2.0 * f[0] * f[1], 2.0 * f[0] * f[2],
          f[1] * f[1], 2.0 * f[1] * f[2], f[2] * f[2]};
}

std::optional<std::size_t> length_class(const Vec3& semi_axes, const Vec3& direction) {
  if (shape_of(semi_axes) == Shape::sphere) return std::nullopt;
  const double length = 1.0 / direction.normalized().cwiseQuotient(semi_axes).norm();
  const auto border = class_borders(semi_axes.minCoeff(), semi_axes.maxCoeff());
  return (length > border[0] ? 1U : 0U) + (length > border[1] ? 1U : 0U);
}

double area_law_a1(const Spheroid& s) {
  require_sound(s);
  // At the height t along the axis, in semi-axes, cos^2 beta = t^2/(w + kappa t^2); the area is
  // that of zone().
  const double ratio = s.across / s.along, w = ratio * ratio, kappa = kappa_of(ratio);
  const double area = half_zone(ratio);
  if (std::abs(kappa) < kSeries) {
    double coefficient = 0.0, root = 1.0;  // of sqrt(1 - kappa t^2)
    const double sum = series([&](int n) {
      if (n > 0) root *= (n - 1.5) / n * kappa;
      coefficient = -kappa / w * coefficient + root;
      return coefficient / (2 * n + 3);
    });
    return kScalarFactor2 * (sum / (w * area) - 1.0 / 3.0);
  }
  // The integral of sqrt(1 - kappa t^2)/(w + kappa t^2).
  const double eccentricity = std::sqrt(std::abs(kappa));
  const double angle = kappa > 0.0 ? std::acos(w) : std::acosh(w);
  const double turned = 2.0 * area - ratio;  // the integral of 1/sqrt(1 - kappa t^2)
  const double rest = std::sqrt((1.0 + w) / w) * angle / eccentricity - turned;
  return kScalarFactor2 * ((1.0 - w * rest / area) / kappa - 1.0 / 3.0);
}

namespace {

/// The largest distance of the values' distribution from the even one on 0 to 1.
double off_even(std::vector<double> values) {
  std::ranges::sort(values);
  const auto count = static_cast<double>(values.size());
  double most = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto at = static_cast<double>(i);
    most = std::max({most, values[i] - at / count, (at + 1.0) / count - values[i]});
  }
  return most;
}

/// What one side of a body of revolution is asked for.
struct Place {
  Spheroid spheroid;
  double cosine = 0.0;       ///< of beta, not negative
  Vec3 axis = Vec3::Zero();  ///< in space
};

std::vector<Place> places_of(const ContactArrays& contacts, const BodyArrays& bodies,
                             std::span<const Side> sides) {
  std::vector<Place> places;
  places.reserve(sides.size());
  for (const Side& side : sides) {
    const auto symmetry = symmetry_of(bodies.semi_axes[side.body]);
    const Vec3 axis = axis_in_space(bodies, side.body, symmetry->axis);
    const double cosine = std::abs(axis.dot(contact_vector(contacts, side)));
    places.push_back({symmetry->spheroid, std::min(cosine, 1.0), axis});
  }
  return places;
}

/// The correlation of two values a side; its deviation if there is none.
Estimate correlation(std::span<const Side> sides, std::span<const double> x,
                     std::span<const double> y, std::size_t bodies) {
  const auto count = static_cast<double>(sides.size());
  double x_mean = 0.0, y_mean = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    x_mean += x[s] / count;
    y_mean += y[s] / count;
  }
  for (std::size_t s = 0; s < sides.size(); ++s) {
    xx += (x[s] - x_mean) * (x[s] - x_mean);
    yy += (y[s] - y_mean) * (y[s] - y_mean);
    xy += (x[s] - x_mean) * (y[s] - y_mean);
  }
  const double none = kRoundedVariance * count;
  if (!(xx > none) || !(yy > none * (1.0 + y_mean * y_mean))) return {kNotDefined, kNotDefined};
  const double size = std::sqrt(xx * yy);
  ClusteredErrors errors(bodies, 1);
  for (std::size_t s = 0; s < sides.size(); ++s)
    errors.add(sides[s], std::array{(x[s] - x_mean) * (y[s] - y_mean) / size});
  return {xy / size, errors.deviations().front()};
}

LocalCorrelations correlations_of(const ContactArrays& contacts, std::span<const Side> sides,
                                  std::span<const Place> places, std::size_t bodies) {
  std::vector<double> touching(bodies, 0.0);
  for (const auto& pair : contacts.bodies)
    for (const auto body : pair) touching[static_cast<std::size_t>(body)] += 1.0;
  std::vector<double> local, other;
  for (const Place& place : places) local.push_back(p2(place.cosine));
  for (const Side& side : sides) other.push_back(touching[side.body]);
  LocalCorrelations found;
  found.coordination = correlation(sides, local, other, bodies);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t s = 0; s < places.size(); ++s) {
      const double component = places[s].axis[static_cast<Eigen::Index>(i)];
      other[s] = component * component;
    }
    found.orientation[i] = correlation(sides, local, other, bodies);
  }
  return found;
}

SpheroidStatistics spheroid_statistics(const ContactArrays& contacts, const BodyArrays& bodies,
                                       std::span<const Side> sides) {
  const std::vector<Place> places = places_of(contacts, bodies, sides);
  const std::size_t particles = bodies.semi_axes.size();
  const auto count = static_cast<double>(places.size());
  std::vector<double> values;
  for (const Place& place : places) values.push_back(5.0 * p2(place.cosine));
  SpheroidStatistics found;
  found.a1 = mean_of(sides, values, particles);
  std::vector<double> by_model, by_area;
  for (const Place& place : places) {
    const Spheroid& s = place.spheroid;
    const double beta = std::acos(place.cosine);
    by_model.push_back(2.0 * local_distribution(found.a1.value, beta));
    by_area.push_back(2.0 * area_share(s, beta));
    found.area_law_a1 += area_law_a1(s) / count;
    const auto calculated = length_shares(s, found.a1.value), area = length_shares_by_area(s);
    for (std::size_t i = 0; i < 3; ++i) {
      found.calculated[i] += (*calculated)[i] / count;
      found.by_area[i] += (*area)[i] / count;
    }
  }
  found.calculated_pairs = pair_shares(found.calculated);
  found.off_model = 0.5 * off_even(std::move(by_model));
  found.off_area = 0.5 * off_even(std::move(by_area));
  found.correlations = correlations_of(contacts, sides, places, particles);
  return found;
}

/// Shares of contacts between two bodies of the shape, by the classes of their sides.
void count_pairs(std::span<const Side> sides, std::span<const std::size_t> classes,
                 ContactStatistics& found) {
  constexpr std::array<std::array<std::size_t, 3>, 3> kPair{{{0, 1, 2}, {1, 3, 4}, {2, 4, 5}}};
  std::array<double, 6> counts{};
  for (std::size_t s = 0; s + 1 < sides.size(); ++s) {
    if (sides[s].contact != sides[s + 1].contact) continue;
    counts[kPair[classes[s]][classes[s + 1]]] += 1.0;
    ++found.contacts;
  }
  const auto all = static_cast<double>(found.contacts);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double share = counts[i] / all;
    found.pairs[i] = {share,
                      found.contacts < 2 ? kNotDefined : std::sqrt(share * (1.0 - share) / all)};
  }
}

}  // namespace

std::optional<ContactStatistics> contact_statistics_of(const ContactArrays& contacts,
                                                       const BodyArrays& bodies, Shape shape) {
  require_sound(contacts, bodies);
  require_dimensions(contacts, 3, "contact_statistics_of");
  if (shape == Shape::sphere) return std::nullopt;
  const std::vector<Side> sides = sides_of(contacts, bodies, shape);
  if (sides.empty()) return std::nullopt;
  std::vector<Vec3> local;
  std::vector<std::size_t> classes;
  for (const Side& side : sides) {
    local.push_back(local_vector(contacts, bodies, side));
    classes.push_back(*length_class(bodies.semi_axes[side.body], local.back()));
  }
  ContactStatistics found;
  found.sides = sides.size();
  found.local = *fit_orientations(local);
  for (std::size_t i = 0; i < 3; ++i) {
    std::vector<double> in_class;
    for (const std::size_t of_side : classes) in_class.push_back(of_side == i ? 1.0 : 0.0);
    found.length[i] = mean_of(sides, in_class, bodies.semi_axes.size());
  }
  count_pairs(sides, classes, found);
  if (shape != Shape::triaxial) found.spheroid = spheroid_statistics(contacts, bodies, sides);
  return found;
}

std::vector<double> measured_distribution(const ContactArrays& contacts, const BodyArrays& bodies,
                                          Shape shape, std::span<const double> beta) {
  require_sound(contacts, bodies);
  require_dimensions(contacts, 3, "measured_distribution");
  if (!rotates(shape)) return {};
  const std::vector<Side> sides = sides_of(contacts, bodies, shape);
  if (sides.empty()) return {};
  std::vector<double> angles;
  for (const Place& place : places_of(contacts, bodies, sides))
    angles.push_back(std::acos(place.cosine));
  std::ranges::sort(angles);
  std::vector<double> found;
  for (const double each : beta) {
    const auto within = std::ranges::upper_bound(angles, each) - angles.begin();
    found.push_back(0.5 * static_cast<double>(within) / static_cast<double>(angles.size()));
  }
  return found;
}

}  // namespace tangency::inline v0::micromechanics
