// SPDX-License-Identifier: MIT
/// @file
/// Vectors and rotations of space over an arithmetic T that is a class: double-double, 512 bits.
#pragma once

#include <array>
#include <cstddef>

namespace tangency::inline v0::detail {

template <class T>
using Vector3 = std::array<T, 3>;
template <class T>
using Matrix3 = std::array<Vector3<T>, 3>;  ///< by rows

template <class T>
Vector3<T> operator*(const T& s, const Vector3<T>& v) noexcept {
  return {s * v[0], s * v[1], s * v[2]};
}
template <class T>
Vector3<T> operator+(const Vector3<T>& a, const Vector3<T>& b) noexcept {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class T>
Vector3<T> operator-(const Vector3<T>& v) noexcept {
  return {-v[0], -v[1], -v[2]};
}
template <class T>
T dot(const Vector3<T>& a, const Vector3<T>& b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T>
T length(const Vector3<T>& v) noexcept {
  return sqrt(dot(v, v));
}
/// Times 2^power.
template <class T>
Vector3<T> scaled_by_power(const Vector3<T>& v, int power) noexcept {
  return {scaled_by_power(v[0], power), scaled_by_power(v[1], power), scaled_by_power(v[2], power)};
}

/// R v
template <class T>
Vector3<T> turned(const Matrix3<T>& r, const Vector3<T>& v) noexcept {
  return {dot(r[0], v), dot(r[1], v), dot(r[2], v)};
}
/// R' v
template <class T>
Vector3<T> turned_back(const Matrix3<T>& r, const Vector3<T>& v) noexcept {
  const auto component = [&](std::size_t k) {
    return r[0][k] * v[0] + r[1][k] * v[1] + r[2][k] * v[2];
  };
  return {component(0), component(1), component(2)};
}

/// R(q/|q|), each entry within 20 units of T's epsilon.
/// @param product  the exact product of two components, in T
template <class T, class Component, class Product>
Matrix3<T> rotation_matrix(const Component& w, const Component& x, const Component& y,
                           const Component& z, const Product& product) noexcept {
  const T ww = product(w, w), xx = product(x, x), yy = product(y, y), zz = product(z, z);
  const T wx = product(w, x), wy = product(w, y), wz = product(w, z);
  const T xy = product(x, y), yz = product(y, z), zx = product(z, x);
  const T s = T(1.0) / (ww + xx + (yy + zz)), t = s + s;
  return {{{s * (ww + xx - (yy + zz)), t * (xy - wz), t * (zx + wy)},
           {t * (xy + wz), s * (ww + yy - (xx + zz)), t * (yz - wx)},
           {t * (zx - wy), t * (yz + wx), s * (ww + zz - (xx + yy))}}};
}

}  // namespace tangency::inline v0::detail
