// SPDX-License-Identifier: MIT
/// @file
/// Spherical harmonics of orders 2 and 4 as tensors, and the models of a scalar and of a tangential
/// vector that are made of them [Ouadfel1998, sections 2.3 to 2.5 and 6.3].
///
/// A harmonic of order 2 is a:nn with a symmetric, traceless 3x3 tensor a; of order 4 b::nnnn with
/// a fully symmetric, traceless tensor b of order 4. n is a unit vector. Coefficients are pure
/// numbers. Values and functions are free of state: any number of threads may use them.
#pragma once

#include <array>
#include <cstddef>

#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::micromechanics {

/// A fully symmetric tensor of order 4 in space by its 15 different components.
class SymmetricTensor4 {
 public:
  static constexpr std::size_t kComponents = 15;  ///< of a fully symmetric tensor of order 4

  /// nnnn
  static SymmetricTensor4 power(const Vec3& n);
  /// The symmetric part of v (x) nnn: the mean over the four places of v.
  static SymmetricTensor4 product(const Vec3& v, const Vec3& n);
  /// The symmetric part of any T_ijkl: the mean over the 24 orders of its indices.
  /// @param t  81 components, the last index runs fastest
  static SymmetricTensor4 symmetrised(const std::array<double, 81>& t);

  /// Component with indices 0 to 2, in any order.
  double operator()(int i, int j, int k, int l) const { return components[index(i, j, k, l)]; }
  /// A component; the order of the indices does not matter.
  double& operator()(int i, int j, int k, int l) { return components[index(i, j, k, l)]; }

  /// b_ijkl n_i n_j n_k n_l
  double along(const Vec3& n) const { return n.dot(vector_along(n)); }
  /// b_ijkl n_j n_k n_l
  Vec3 vector_along(const Vec3& n) const;
  /// b_ijkk
  Mat3 trace() const;
  /// The sum of products of all 81 components.
  double contracted(const SymmetricTensor4& other) const;
  /// sqrt(b_ijkl b_ijkl)
  double norm() const;
  /// R_ia R_jb R_kc R_ld b_abcd
  SymmetricTensor4 rotated(const Mat3& rotation) const;

  /// Component by component.
  SymmetricTensor4& operator+=(const SymmetricTensor4& other);
  /// Component by component.
  SymmetricTensor4& operator*=(double factor);
  /// Component by component.
  friend SymmetricTensor4 operator+(SymmetricTensor4 a, const SymmetricTensor4& b) {
    return a += b;
  }
  /// Component by component.
  friend SymmetricTensor4 operator-(SymmetricTensor4 a, SymmetricTensor4 b) {
    return a += b *= -1.0;
  }
  /// Component by component.
  friend SymmetricTensor4 operator*(double factor, SymmetricTensor4 a) { return a *= factor; }

  /// With y occurring q times and z r times among the indices: at s (s + 1) / 2 + r, s = q + r.
  std::array<double, kComponents> components{};

 private:
  static constexpr std::size_t index(int i, int j, int k, int l) {
    const int z = (i == 2) + (j == 2) + (k == 2) + (l == 2);
    const int not_x = (i != 0) + (j != 0) + (k != 0) + (l != 0);
    return static_cast<std::size_t>(not_x * (not_x + 1) / 2 + z);
  }
};

/// The part of order 2 of a tensor: symmetric and traceless.
///
/// (1) leaves a symmetric, traceless tensor as it is
Mat3 harmonic_part(const Mat3& t);

/// The part of order 4 of a fully symmetric tensor: traceless, 9 components are free.
///
/// (2) leaves a traceless tensor as it is, and has itself no trace
SymmetricTensor4 harmonic_part(const SymmetricTensor4& t);

/// What a mean of harmonics <n...n> is multiplied by to be the coefficients of a density or of a
/// scalar: 1 over the mean square of a harmonic whose tensor has modulus 1, by order.
inline constexpr double kScalarFactor2 = 15.0 / 2.0, kScalarFactor4 = 315.0 / 8.0;

/// Legendre's polynomials of orders 2 and 4 of a cosine, by its square and its fourth power: their
/// means are those of the means of these.
///
/// (3) harmonic_part(nn):uu is (2/3) P2(n . u), and harmonic_part(nnnn)::uuuu (8/35) P4(n . u)
constexpr double legendre2(double square) { return 1.5 * square - 0.5; }
/// P4, as legendre2() is P2.
constexpr double legendre4(double square, double fourth) {
  return (35.0 * fourth - 30.0 * square + 3.0) / 8.0;
}

/// sqrt(a_ij a_ij), the size of an anisotropy [Ouadfel1998, section 5.4.8.1]: sqrt(3/2) times the
/// axial principal value's size where it is axisymmetric.
double modulus(const Mat3& a);

/// Orthonormal bases of the harmonics: of the symmetric traceless tensors of order 2, and of the
/// fully symmetric traceless ones of order 4. Made at the first call.
const std::array<Mat3, 5>& second_basis();
/// An orthonormal basis of the deviatoric fully symmetric tensors of order 4.
const std::array<SymmetricTensor4, 9>& fourth_basis();

/// g(n) = mean (1 + a:nn + b::nnnn). Of contact normals the mean is 1/(4 pi).
struct ScalarHarmonics {
  double mean = 0.0;           ///< over all directions
  Mat3 second = Mat3::Zero();  ///< relative, deviatoric
  /// relative, deviatoric
  SymmetricTensor4 fourth{};

  /// At a unit normal n.
  double value(const Vec3& n) const { return mean * (1.0 + n.dot(second * n) + fourth.along(n)); }
};

/// g(n) = mean (a n - (a:nn) n + b nnn - (b::nnnn) n): mean times the gradient on the sphere of
/// a:nn/2 + b::nnnn/4. Perpendicular to n, g(-n) = -g(n). The mean is that of the normal component.
struct TangentialHarmonics {
  double mean = 0.0;           ///< what the tensors are relative to
  Mat3 second = Mat3::Zero();  ///< deviatoric
  /// deviatoric
  SymmetricTensor4 fourth{};

  /// At a unit normal n: tangential to the sphere.
  Vec3 value(const Vec3& n) const;

  /// The mean over all directions with the angle beta to an axis of value . r, where
  /// n = axis cos(beta) + r sin(beta): the radial component [Ouadfel1998, eq. 2.77-2.79]. Only
  /// axis.a.axis and b::axis^4 survive, of fields that are not axisymmetric too.
  /// @param beta  angles to the axis, rad
  /// @param axis  unit
  double radial(double beta, const Vec3& axis) const;
};

}  // namespace tangency::inline v0::micromechanics
