// SPDX-License-Identifier: MIT
#include <tangency/geometry/volume/circular_sections.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <tangency/geometry/normals/precise_perram_wertheim.hpp>

namespace tangency::inline v0::detail {
namespace {

/// diag(1/b) R_B' R_A diag(a) before its columns are turned, and what turns them.
template <class T>
struct Columns {
  std::array<Vector3<T>, 3> image;  ///< columns of W V
  std::array<Vector3<T>, 3> turn;   ///< columns of V
};

/// What is asked in no more than double.
template <class T>
double rough(const T& v) {
  return static_cast<double>(v);
}

// In units of the arithmetic's epsilon: section 3.

constexpr double kOfMatrix = 0x1p12;     // of the columns, turned, over A's aspect ratio
constexpr double kOfCircles = 0x1p10;    // k, the frame, the circles' numbers
constexpr double kOfSeparation = 0x1p5;  // d in body axes, over |d|_1
constexpr double kOrthogonal = 0x1p4;    // the cosine between two columns at which sweeps end

template <class T>
constexpr double epsilon(double units) {
  return units * Arithmetic<T>::kEpsilon;
}

template <class T>
T axis(const Ellipsoid& body, std::size_t k) {
  return body.semi_axes()[static_cast<int>(k)];
}

template <class T>
Columns<T> columns_of(const Ellipsoid& first, const Ellipsoid& second, const Matrix3<T>& of_first) {
  const Matrix3<T> of_second = Arithmetic<T>::rotation(second.orientation());
  Columns<T> c{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3<T> in_space{of_first[0][k], of_first[1][k], of_first[2][k]};
    c.image[k] = turned_back(of_second, in_space);
    for (std::size_t i = 0; i < 3; ++i) {
      c.image[k][i] = axis<T>(first, k) * c.image[k][i] / axis<T>(second, i);
    }
    c.turn[k] = {T(0.0), T(0.0), T(0.0)};
    c.turn[k][k] = T(1.0);
  }
  return c;
}

/// The first column times cosine less the second times sine, and the other way round.
template <class T>
void turn(Vector3<T>& p, Vector3<T>& q, const T& cosine, const T& sine) {
  const Vector3<T> old = p;
  p = cosine * old + -(sine * q);
  q = sine * old + cosine * q;
}

/// The tangent of the angle by which two columns of these products are normal to each other.
template <class T>
T tangent_of(const T& ii, const T& jj, const T& ij) {
  constexpr double kSteep = 0x1p200;  // beyond it a square would leave the range of doubles
  const T zeta = (jj - ii) / (ij + ij), size = abs(zeta), one(1.0);
  T tangent(0.5 / rough(size));
  if (rough(size) < kSteep) tangent = one / (size + sqrt(one + size * size));
  return rough(zeta) < 0.0 ? -tangent : tangent;
}

/// One-sided Jacobi: turns columns by twos until all are normal to each other.
template <class T>
void orthogonalise(Columns<T>& c) {
  constexpr int kMostSweeps = 20;  // 10 seen
  const T one(1.0);
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    bool turned_any = false;
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t j = i + 1; j < 3; ++j) {
        const T ii = dot(c.image[i], c.image[i]), jj = dot(c.image[j], c.image[j]);
        const T ij = dot(c.image[i], c.image[j]);
        const double lengths = std::sqrt(rough(ii)) * std::sqrt(rough(jj));
        if (!(std::abs(rough(ij)) > epsilon<T>(kOrthogonal) * lengths)) continue;
        turned_any = true;
        const T tangent = tangent_of(ii, jj, ij), cosine = one / sqrt(one + tangent * tangent);
        turn<T>(c.image[i], c.image[j], cosine, cosine * tangent);
        turn<T>(c.turn[i], c.turn[j], cosine, cosine * tangent);
      }
    }
    if (!turned_any) return;
  }
}

/// How far V is from a rotation and the columns of W V from right angles, whatever the sweeps did.
template <class T>
double disorder(const Columns<T>& c) {
  double most = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {
      const T unit(i == j ? 1.0 : 0.0);
      most = std::max(most, std::abs(rough(dot(c.turn[i], c.turn[j]) - unit)));
      if (i == j) continue;
      const double lengths = std::sqrt(rough(dot(c.image[i], c.image[i]))) *
                             std::sqrt(rough(dot(c.image[j], c.image[j])));
      most = std::max(most, std::abs(rough(dot(c.image[i], c.image[j]))) / lengths);
    }
  }
  return 12.0 * most + epsilon<T>(kOfCircles);
}

/// By the length of their images, ascending.
template <class T>
void sort(Columns<T>& c) {
  for (const std::size_t i : std::array<std::size_t, 3>{0, 1, 0}) {
    const T shorter = dot(c.image[i], c.image[i]) - dot(c.image[i + 1], c.image[i + 1]);
    if (rough(shorter) <= 0.0) continue;
    std::swap(c.image[i], c.image[i + 1]), std::swap(c.turn[i], c.turn[i + 1]);
  }
}

/// Unit vectors along v, which may be 0, and across it.
template <class T>
std::array<Vector3<T>, 3> frame_along(const Vector3<T>& v) {
  const T one(1.0), size = length(v);
  Vector3<T> along{one, T(0.0), T(0.0)};
  if (rough(size) > 0.0) along = (one / size) * v;
  std::size_t least = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (std::abs(rough(along[k])) < std::abs(rough(along[least]))) least = k;
  }
  Vector3<T> e{T(0.0), T(0.0), T(0.0)};
  e[least] = one;
  Vector3<T> across = e + -(along[least] * along);
  across = (one / length(across)) * across;
  const Vector3<T>&p = along, &q = across;
  return {along,
          across,
          {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]}};
}

double aspect(const Ellipsoid& e) { return e.largest_semi_axis() / e.smallest_semi_axis(); }

/// The axes of the second body in the ball, k its squared inverse semi-axes, ascending, and the
/// direction (n1, 0, n3) among them that its circles are normal to.
template <class T>
struct Circles {
  std::array<T, 3> k;
  std::array<Vector3<T>, 3> axes;
  T n1, n3;
};

/// Of its two families of circles the one whose planes are nearer to holding the line of centres.
template <class T>
Circles<T> circles(Columns<T>& c, const Vector3<T>& centre) {
  sort(c);
  Circles<T> of{};
  for (std::size_t i = 0; i < 3; ++i) of.k[i] = dot(c.image[i], c.image[i]);
  of.axes = c.turn;
  const T range = of.k[2] - of.k[0];
  if (!(rough(range) > epsilon<T>(kOfCircles) * rough(of.k[2]))) {
    // A sphere to all digits: any axes are its axes.
    of.axes = frame_along(centre);
    of.n1 = T(0.0), of.n3 = T(1.0);
    return of;
  }
  const T n1 = sqrt((of.k[1] - of.k[0]) / range), n3 = sqrt((of.k[2] - of.k[1]) / range);
  const T norm = sqrt(n1 * n1 + n3 * n3);
  of.n1 = n1 / norm, of.n3 = n3 / norm;
  const bool back = rough(dot(of.axes[0], centre)) < 0.0;
  if (back == (rough(dot(of.axes[2], centre)) < 0.0)) of.n3 = -of.n3;
  return of;
}

}  // namespace

template <class T>
double CircularSections<T>::layer() const noexcept {
  return 1.01 * (distortion * (2.0 + centre_distance) + shift);
}

template <class T>
double CircularSections<T>::level_error() const noexcept {
  const double share = distortion + steepness * layer();  // of the second body, at its surface
  if (!(share < 0.05)) return std::numeric_limits<double>::infinity();
  return 2.1 * rough(beta) * share;
}

template <class T>
CircularSections<T> circular_sections(const Ellipsoid& first, const Ellipsoid& second,
                                      const Vector3<T>& d) noexcept {
  const Matrix3<T> of_first = Arithmetic<T>::rotation(first.orientation());
  Vector3<T> centre = turned_back(of_first, d);
  for (std::size_t k = 0; k < 3; ++k) centre[k] = centre[k] / axis<T>(first, k);

  Columns<T> columns = columns_of(first, second, of_first);
  orthogonalise(columns);
  const double turned = disorder(columns);
  const Circles<T> of = circles(columns, centre);
  const T &k1 = of.k[0], &k3 = of.k[2], &n1 = of.n1, &n3 = of.n3;
  const T k2 = k1 * n3 * n3 + k3 * n1 * n1;
  const T s1 = dot(of.axes[0], centre), s3 = dot(of.axes[2], centre);

  CircularSections<T> result{};
  result.beta = T(1.0) / k2;
  result.mu = (k1 / k2) * (k3 / k2);
  result.half_height = sqrt(result.beta / result.mu);
  result.tau = n1 * n3 * (k3 - k1) / k2;
  result.z0 = n1 * s1 + n3 * s3;
  result.x0 = n3 * s1 - n1 * s3;
  result.y0 = dot(of.axes[1], centre);
  const Vector3<T> x = n3 * of.axes[0] + -(n1 * of.axes[2]);
  const Vector3<T> z = n1 * of.axes[0] + n3 * of.axes[2];
  result.frame << rounded(x), rounded(of.axes[1]), rounded(z);
  result.distortion = turned + epsilon<T>(kOfMatrix) * aspect(first);
  result.centre_distance = rough(length(centre));
  double sum_of_d = 0.0;
  for (const T& component : d) sum_of_d += std::abs(rough(component));
  result.shift = epsilon<T>(kOfSeparation) * sum_of_d / first.smallest_semi_axis() +
                 epsilon<T>(kOfCircles) * result.centre_distance;
  result.steepness = std::sqrt(rough(k3));
  return result;
}

template struct CircularSections<DoubleDouble>;
template struct CircularSections<WideFloat>;
template CircularSections<DoubleDouble> circular_sections(const Ellipsoid&, const Ellipsoid&,
                                                          const DoubleDoubleVector&) noexcept;
template CircularSections<WideFloat> circular_sections(const Ellipsoid&, const Ellipsoid&,
                                                       const WideVector&) noexcept;

}  // namespace tangency::inline v0::detail
