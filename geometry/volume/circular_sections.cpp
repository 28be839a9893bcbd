// SPDX-License-Identifier: MIT
#include <tangency/geometry/volume/circular_sections.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace tangency::detail {
namespace {

/// diag(1/b) R_B' R_A diag(a) before its columns are turned, and what turns them.
struct Columns {
  std::array<DoubleDoubleVector, 3> image;  ///< columns of W V
  std::array<DoubleDoubleVector, 3> turn;   ///< columns of V
};

/// Of a rotation's product and of a scaled column, over the aspect ratio: section 3.
constexpr double kOfMatrix = 0x1p-92;
/// Of k, of the frame and of the circles' numbers: section 3.
constexpr double kOfCircles = 0x1p-94;
/// Of d in body axes, over |d|_1: 30 units of kDoubleDoubleEpsilon.
constexpr double kOfSeparation = 0x1p-97;

DoubleDouble axis(const Ellipsoid& body, std::size_t k) {
  return body.semi_axes()[static_cast<int>(k)];
}

Columns columns_of(const Ellipsoid& first, const Ellipsoid& second,
                   const DoubleDoubleMatrix& of_first) {
  const DoubleDoubleMatrix of_second = double_double_rotation(second.orientation());
  Columns c{};
  for (std::size_t k = 0; k < 3; ++k) {
    const DoubleDoubleVector in_space{of_first[0][k], of_first[1][k], of_first[2][k]};
    c.image[k] = turned_back(of_second, in_space);
    for (std::size_t i = 0; i < 3; ++i) {
      c.image[k][i] = axis(first, k) * c.image[k][i] / axis(second, i);
    }
    c.turn[k] = {0.0, 0.0, 0.0};
    c.turn[k][k] = 1.0;
  }
  return c;
}

/// The first column times cosine less the second times sine, and the other way round.
void turn(DoubleDoubleVector& p, DoubleDoubleVector& q, const DoubleDouble& cosine,
          const DoubleDouble& sine) {
  const DoubleDoubleVector old = p;
  p = cosine * old + -(sine * q);
  q = sine * old + cosine * q;
}

/// One-sided Jacobi: turns columns by twos until all are normal to each other [Demmel1992].
void orthogonalise(Columns& c) {
  constexpr int kMostSweeps = 16;         // 8 seen
  constexpr double kOrthogonal = 0x1p-98;  // of the cosine between two columns
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    bool turned_any = false;
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t j = i + 1; j < 3; ++j) {
        const DoubleDouble ii = dot(c.image[i], c.image[i]), jj = dot(c.image[j], c.image[j]);
        const DoubleDouble ij = dot(c.image[i], c.image[j]);
        if (!(std::abs(ij.high) > kOrthogonal * std::sqrt(ii.high) * std::sqrt(jj.high))) continue;
        turned_any = true;
        const DoubleDouble zeta = (jj - ii) / (ij + ij), size = abs(zeta);
        DoubleDouble tangent = 1.0 / std::abs(zeta.high + zeta.high);
        if (size.high < 0x1p60) {
          tangent = DoubleDouble(1.0) / (size + sqrt(DoubleDouble(1.0) + size * size));
        }
        if (zeta.high < 0.0) tangent = -tangent;
        const DoubleDouble cosine = DoubleDouble(1.0) / sqrt(DoubleDouble(1.0) + tangent * tangent);
        turn(c.image[i], c.image[j], cosine, cosine * tangent);
        turn(c.turn[i], c.turn[j], cosine, cosine * tangent);
      }
    }
    if (!turned_any) return;
  }
}

/// How far V is from a rotation and the columns of W V from right angles, whatever the sweeps did.
double disorder(const Columns& c) {
  double most = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {
      const DoubleDouble unit = i == j ? 1.0 : 0.0;
      most = std::max(most, std::abs((dot(c.turn[i], c.turn[j]) - unit).high));
      if (i == j) continue;
      const double lengths =
          std::sqrt(dot(c.image[i], c.image[i]).high) * std::sqrt(dot(c.image[j], c.image[j]).high);
      most = std::max(most, std::abs(dot(c.image[i], c.image[j]).high) / lengths);
    }
  }
  return 12.0 * most + kOfCircles;
}

/// By the length of their images, ascending.
void sort(Columns& c) {
  const auto shorter = [&](std::size_t i, std::size_t j) {
    return (dot(c.image[i], c.image[i]) - dot(c.image[j], c.image[j])).high < 0.0;
  };
  for (const auto& [i, j] : {std::pair{0, 1}, std::pair{1, 2}, std::pair{0, 1}}) {
    const auto p = static_cast<std::size_t>(i), q = static_cast<std::size_t>(j);
    if (shorter(q, p)) std::swap(c.image[p], c.image[q]), std::swap(c.turn[p], c.turn[q]);
  }
}

/// A unit vector normal to v, and one normal to both; of v = 0 any.
void across(const DoubleDoubleVector& v, DoubleDoubleVector& along, DoubleDoubleVector& second,
            DoubleDoubleVector& third) {
  const DoubleDouble size = length(v);
  along = {1.0, 0.0, 0.0};
  if (size.high > 0.0) along = (DoubleDouble(1.0) / size) * v;
  std::size_t least = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (std::abs(along[k].high) < std::abs(along[least].high)) least = k;
  }
  DoubleDoubleVector e{0.0, 0.0, 0.0};
  e[least] = 1.0;
  second = e + -(along[least] * along);
  second = (DoubleDouble(1.0) / length(second)) * second;
  third = {along[1] * second[2] - along[2] * second[1], along[2] * second[0] - along[0] * second[2],
           along[0] * second[1] - along[1] * second[0]};
}

double aspect(const Ellipsoid& e) { return e.largest_semi_axis() / e.smallest_semi_axis(); }

/// The axes of the second body in the ball, k its squared inverse semi-axes, ascending, and the
/// direction (n1, 0, n3) among them that its circles are normal to.
struct Circles {
  std::array<DoubleDouble, 3> k;
  std::array<DoubleDoubleVector, 3> axes;
  DoubleDouble n1, n3;
};

/// Of its two families of circles the one whose planes are nearer to holding the line of centres.
Circles circles(Columns& c, const DoubleDoubleVector& centre) {
  sort(c);
  Circles of{};
  for (std::size_t i = 0; i < 3; ++i) of.k[i] = dot(c.image[i], c.image[i]);
  of.axes = c.turn;
  const DoubleDouble range = of.k[2] - of.k[0];
  if (!(range.high > kOfCircles * of.k[2].high)) {
    // A sphere to all digits: any axes are its axes.
    across(centre, of.axes[0], of.axes[1], of.axes[2]);
    of.n1 = 0.0, of.n3 = 1.0;
    return of;
  }
  const DoubleDouble low = of.k[1] - of.k[0], high = of.k[2] - of.k[1];
  of.n1 = sqrt(low / range), of.n3 = sqrt(high / range);
  const double along_first = dot(of.axes[0], centre).high, along_last = dot(of.axes[2], centre).high;
  if ((along_first < 0.0) == (along_last < 0.0)) of.n3 = -of.n3;
  return of;
}

}  // namespace

double CircularSections::layer() const noexcept {
  return 1.01 * (distortion * (2.0 + centre_distance) + shift);
}

double CircularSections::level_error() const noexcept {
  const double share = distortion + steepness * layer();  // of the second body, at its surface
  if (!(share < 0.05)) return std::numeric_limits<double>::infinity();
  return 2.1 * beta.high * share;
}

CircularSections circular_sections(const Ellipsoid& first, const Ellipsoid& second,
                                   const DoubleDoubleVector& d) noexcept {
  const DoubleDoubleMatrix of_first = double_double_rotation(first.orientation());
  DoubleDoubleVector centre = turned_back(of_first, d);
  for (std::size_t k = 0; k < 3; ++k) centre[k] = centre[k] / axis(first, k);

  Columns columns = columns_of(first, second, of_first);
  orthogonalise(columns);
  const double turned = disorder(columns);
  const Circles of = circles(columns, centre);
  const DoubleDouble &k1 = of.k[0], &k3 = of.k[2], &n1 = of.n1, &n3 = of.n3;
  const DoubleDouble k2 = k1 * n3 * n3 + k3 * n1 * n1, one(1.0);
  const DoubleDouble s1 = dot(of.axes[0], centre), s3 = dot(of.axes[2], centre);

  CircularSections result{};
  result.beta = one / k2;
  result.mu = (k1 / k2) * (k3 / k2);
  result.half_height = sqrt(result.beta / result.mu);
  result.tau = n1 * n3 * (k3 - k1) / k2;
  result.z0 = n1 * s1 + n3 * s3;
  result.x0 = n3 * s1 - n1 * s3 - result.tau * result.z0;
  result.y0 = dot(of.axes[1], centre);
  const DoubleDoubleVector x = n3 * of.axes[0] + -(n1 * of.axes[2]);
  const DoubleDoubleVector z = n1 * of.axes[0] + n3 * of.axes[2];
  result.frame << rounded(x), rounded(of.axes[1]), rounded(z);
  result.distortion = turned + kOfMatrix * std::min(aspect(first), aspect(second));
  result.centre_distance = length(centre).high;
  result.shift = kOfSeparation * sum_of_absolutes(d) / first.smallest_semi_axis() +
                 kOfCircles * result.centre_distance;
  result.steepness = std::sqrt(k3.high);
  const Vec3 &a = first.semi_axes(), &b = second.semi_axes();
  result.second_volume = (b[0] / a[0]) * (b[1] / a[1]) * (b[2] / a[2]);
  return result;
}

}  // namespace tangency::detail
