// SPDX-License-Identifier: MIT
#include <tangency/dem/samples/body_sizes.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <tangency/dem/lanes/elementary.hpp>

namespace tangency::inline v0::dem {
namespace {

/// Steps of the additive sequence that fills a square evenly: 1/g and 1/g^2 of the root g of
/// g^3 = g + 1 [Roberts2018].
constexpr double kFirstStep = 0.7548776662466927, kSecondStep = 0.5698402909980532;

/// Terms of the series of normal_quantile() beyond this share of their sum are left out. Derived:
/// by then each is at most half of the one before (k > 2 z^2 for the allowed shares, z <= 5.2), so
/// that the rest is below 2^-59, a small part of a rounding.
constexpr double kRestOfSeries = 1e-18;
/// The last step of its Newton's method is shorter. Derived: the error after it is z/2 times its
/// square, 3e-20 at most.
constexpr double kLastStep = 1e-10;

double fraction_of(double x) { return x - std::floor(x); }

/// x^-k with k = 2 in the plane and 3 in space, which numbers of equal mass go with.
double number_of(double opening, int dimensions) {
  return 1.0 / (dimensions == 2 ? opening * opening : opening * opening * opening);
}
double opening_of(double number, int dimensions) {
  return 1.0 / (dimensions == 2 ? std::sqrt(number) : cube_root(number));
}

/// The distribution in number that a sieve curve stands for: of a mass that grows with the
/// logarithm of the opening D the number goes with -dD^-k.
class SieveCurve {
 public:
  SieveCurve(const BodySizes& sizes, int dimensions) : sizes_(sizes), dimensions_(dimensions) {
    below_.push_back(0.0);
    for (std::size_t k = 1; k < sizes.openings.size(); ++k)
      below_.push_back(below_.back() + density(k) * (power(k - 1) - power(k)));
  }
  /// The opening that so much of the number passes.
  double opening(double share) const {
    const double wanted = share * below_.back();
    std::size_t k = 1;
    while (k + 1 < below_.size() && below_[k] <= wanted) ++k;
    const double inside = power(k - 1) - (wanted - below_[k - 1]) / density(k);
    return std::clamp(opening_of(inside, dimensions_), sizes_.openings[k - 1], sizes_.openings[k]);
  }

 private:
  double power(std::size_t k) const { return number_of(sizes_.openings[k], dimensions_); }
  /// Mass over logarithm of the opening between opening k - 1 and k.
  double density(std::size_t k) const {
    return (sizes_.passing[k] - sizes_.passing[k - 1]) /
           logarithm(sizes_.openings[k] / sizes_.openings[k - 1]);
  }

  const BodySizes& sizes_;
  int dimensions_;
  std::vector<double> below_;  ///< numbers that pass each opening
};

/// But for a sieve curve.
double radius_at(const BodySizes& sizes, double share) {
  const double z = sizes.rule == BodySizes::Rule::normal || sizes.rule == BodySizes::Rule::lognormal
                       ? normal_quantile(sizes.tails + (1.0 - 2.0 * sizes.tails) * share)
                       : 2.0 * share - 1.0;
  if (sizes.rule == BodySizes::Rule::equal) return sizes.radius;
  if (sizes.rule == BodySizes::Rule::lognormal) return sizes.radius * exponential(sizes.spread * z);
  return sizes.radius * (1.0 + sizes.spread * z);
}

}  // namespace

double sieve_opening(const Shape& shape, int dimensions) {
  const Vec3 axes = shape.semi_axes(dimensions);
  return dimensions == 2 ? 2.0 * axes[1] : std::sqrt(2.0 * (axes[1] * axes[1] + axes[2] * axes[2]));
}

std::vector<Shape> shapes_of(const BodySizes& sizes, const BodyRatios& ratios, std::size_t count,
                             int dimensions) {
  const bool by_sieve = sizes.rule == BodySizes::Rule::sieve;
  const SieveCurve curve(sizes, dimensions);
  std::vector<Shape> shapes;
  for (std::size_t i = 0; i < count; ++i) {
    const double place = static_cast<double>(i) + 0.5;
    const double share = place / static_cast<double>(count);
    Shape shape{
        1.0, std::lerp(ratios.elongation[0], ratios.elongation[1], fraction_of(place * kFirstStep)),
        std::lerp(ratios.flatness[0], ratios.flatness[1], fraction_of(place * kSecondStep))};
    shape.mean_radius = by_sieve ? curve.opening(share) / sieve_opening(shape, dimensions)
                                 : radius_at(sizes, share);
    shapes.push_back(shape);
  }
  return shapes;
}

double normal_quantile(double share) {
  // Newton's method on the share below z, which is 1/2 + f (z + z^3/3 + z^5/15 + ...), f the
  // density [Marsaglia2004]. From 0 it goes up to the root of a share above 1/2 without
  // passing it, but by rounding, which ends it: beyond the root a step goes down.
  const bool low = share < 0.5;
  const double wanted = std::max(share, 1.0 - share) - 0.5;
  double z = 0.0, change = 0.0;
  do {
    const double density = exponential(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
    double sum = z, term = z;
    for (int k = 3; term > kRestOfSeries * sum; k += 2) sum += term *= z * z / k;
    change = (wanted - density * sum) / density;
    z += change;
  } while (change > kLastStep);
  return low ? -z : z;
}

}  // namespace tangency::inline v0::dem
