// SPDX-License-Identifier: MIT
#include <tangency/dem/micromechanics/harmonics.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace tangency::inline v0::micromechanics {
namespace {

/// Sorted indices of each different component, in the order of SymmetricTensor4::components.
constexpr std::array<std::array<int, 4>, SymmetricTensor4::kComponents> kIndices = [] {
  std::array<std::array<int, 4>, SymmetricTensor4::kComponents> all{};
  std::size_t next = 0;
  for (int not_x = 0; not_x <= 4; ++not_x)
    for (int z = 0; z <= not_x; ++z, ++next)
      for (int place = 0; place < 4; ++place)
        all[next][static_cast<std::size_t>(place)] =
            place < 4 - not_x ? 0 : (place < 4 - z ? 1 : 2);
  return all;
}();

/// How many of the 81 components are equal to each different one.
constexpr std::array<double, SymmetricTensor4::kComponents> kMultiplicity = {
    1, 4, 4, 6, 12, 6, 4, 12, 12, 4, 1, 4, 6, 4, 1};

template <typename Value>
SymmetricTensor4 from_components(Value value) {
  SymmetricTensor4 t;
  for (std::size_t c = 0; c < t.components.size(); ++c) {
    const auto& [i, j, k, l] = kIndices[c];
    t.components[c] = value(i, j, k, l);
  }
  return t;
}

double delta(int i, int j) { return i == j ? 1.0 : 0.0; }

}  // namespace

SymmetricTensor4 SymmetricTensor4::power(const Vec3& n) {
  return from_components([&](int i, int j, int k, int l) { return n[i] * n[j] * n[k] * n[l]; });
}

SymmetricTensor4 SymmetricTensor4::product(const Vec3& v, const Vec3& n) {
  return from_components([&](int i, int j, int k, int l) {
    return 0.25 * (v[i] * n[j] * n[k] * n[l] + n[i] * v[j] * n[k] * n[l] +
                   n[i] * n[j] * v[k] * n[l] + n[i] * n[j] * n[k] * v[l]);
  });
}

SymmetricTensor4 SymmetricTensor4::symmetrised(const std::array<double, 81>& t) {
  return from_components([&](int i, int j, int k, int l) {
    std::array<int, 4> at = {i, j, k, l};
    double sum = 0.0;
    int orders = 0;  // those that differ; each stands for equally many of the 24
    do {
      sum += t[static_cast<std::size_t>(((at[0] * 3 + at[1]) * 3 + at[2]) * 3 + at[3])];
      ++orders;
    } while (std::next_permutation(at.begin(), at.end()));
    return sum / orders;
  });
}

Vec3 SymmetricTensor4::vector_along(const Vec3& n) const {
  // The 10 different products of three components of n, each as often as it occurs.
  const auto& b = components;
  const double x = n[0], y = n[1], z = n[2];
  const std::array<double, 10> cubic = {
      x * x * x,       3.0 * x * x * y, 3.0 * x * x * z, 3.0 * x * y * y, 6.0 * x * y * z,
      3.0 * x * z * z, y * y * y,       3.0 * y * y * z, 3.0 * y * z * z, z * z * z};
  // The index of a component moves on by s + 1 with one more y, by s + 2 with one more z.
  constexpr std::array<std::size_t, 10> kSize = {0, 1, 1, 2, 2, 2, 3, 3, 3, 3};
  Vec3 v = Vec3::Zero();
  for (std::size_t c = 0; c < cubic.size(); ++c)
    v += cubic[c] * Vec3(b[c], b[c + kSize[c] + 1], b[c + kSize[c] + 2]);
  return v;
}

Mat3 SymmetricTensor4::trace() const {
  Mat3 t;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      t(i, j) = (*this)(i, j, 0, 0) + (*this)(i, j, 1, 1) + (*this)(i, j, 2, 2);
  return t;
}

double SymmetricTensor4::contracted(const SymmetricTensor4& other) const {
  double sum = 0.0;
  for (std::size_t c = 0; c < kComponents; ++c)
    sum += kMultiplicity[c] * components[c] * other.components[c];
  return sum;
}

double SymmetricTensor4::norm() const { return std::sqrt(contracted(*this)); }

SymmetricTensor4 SymmetricTensor4::rotated(const Mat3& rotation) const {
  return from_components([&](int i, int j, int k, int l) {
    double sum = 0.0;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        for (int c = 0; c < 3; ++c)
          for (int d = 0; d < 3; ++d)
            sum += rotation(i, a) * rotation(j, b) * rotation(k, c) * rotation(l, d) *
                   (*this)(a, b, c, d);
    return sum;
  });
}

SymmetricTensor4& SymmetricTensor4::operator+=(const SymmetricTensor4& other) {
  for (std::size_t c = 0; c < kComponents; ++c) components[c] += other.components[c];
  return *this;
}

SymmetricTensor4& SymmetricTensor4::operator*=(double factor) {
  for (double& component : components) component *= factor;
  return *this;
}

Mat3 harmonic_part(const Mat3& t) {
  const Mat3 symmetric = 0.5 * (t + t.transpose());
  return symmetric - symmetric.trace() / 3.0 * Mat3::Identity();
}

SymmetricTensor4 harmonic_part(const SymmetricTensor4& t) {
  const Mat3 once = t.trace();
  const double twice = once.trace();
  return t - from_components([&](int i, int j, int k, int l) {
           const double single = delta(i, j) * once(k, l) + delta(i, k) * once(j, l) +
                                 delta(i, l) * once(j, k) + delta(j, k) * once(i, l) +
                                 delta(j, l) * once(i, k) + delta(k, l) * once(i, j);
           const double both =
               delta(i, j) * delta(k, l) + delta(i, k) * delta(j, l) + delta(i, l) * delta(j, k);
           return single / 7.0 - twice / 35.0 * both;
         });
}

double modulus(const Mat3& a) { return a.norm(); }

const std::array<Mat3, 5>& second_basis() {
  static const std::array<Mat3, 5> basis = [] {
    const double half = std::sqrt(0.5), sixth = std::sqrt(1.0 / 6.0);
    std::array<Mat3, 5> made;
    made.fill(Mat3::Zero());
    made[0].diagonal() = sixth * Vec3(-1.0, -1.0, 2.0);
    made[1].diagonal() = half * Vec3(1.0, -1.0, 0.0);
    for (const int k : {0, 1, 2}) {
      Mat3& shear = made[static_cast<std::size_t>(2 + k)];
      shear((k + 1) % 3, (k + 2) % 3) = shear((k + 2) % 3, (k + 1) % 3) = half;
    }
    return made;
  }();
  return basis;
}

const std::array<SymmetricTensor4, 9>& fourth_basis() {
  // Of the moduli below, which have no unit: what depends on those before is left with rounding,
  // less than 1e-15, the nine others with 0.35 and more (all 15 computed).
  constexpr double kIndependent = 1e-6;
  static const std::array<SymmetricTensor4, 9> basis = [] {
    // The harmonic parts of the 15 different components, each made orthogonal to those before.
    std::array<SymmetricTensor4, 9> made{};
    std::size_t found = 0;
    for (std::size_t c = 0; c < SymmetricTensor4::kComponents && found < made.size(); ++c) {
      SymmetricTensor4 next;
      next.components[c] = 1.0;
      next = harmonic_part(next);
      for (int twice = 0; twice < 2; ++twice)
        for (std::size_t m = 0; m < found; ++m) next += -next.contracted(made[m]) * made[m];
      const double size = next.norm();
      if (size > kIndependent) made[found++] = 1.0 / size * next;
    }
    assert(found == made.size());
    return made;
  }();
  return basis;
}

Vec3 TangentialHarmonics::value(const Vec3& n) const {
  const Vec3 whole = second * n + fourth.vector_along(n);
  return mean * (whole - n.dot(whole) * n);
}

double TangentialHarmonics::radial(double beta, const Vec3& axis) const {
  const double a = axis.dot(second * axis), b = fourth.along(axis);
  const double s1 = std::sin(beta), s3 = std::sin(3.0 * beta), s5 = std::sin(5.0 * beta);
  return mean * (-0.375 * a * (s1 + s3) - 5.0 / 128.0 * b * (2.0 * s1 + 9.0 * s3 + 7.0 * s5));
}

}  // namespace tangency::inline v0::micromechanics
