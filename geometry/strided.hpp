// SPDX-License-Identifier: MIT
/// @file
/// Numbers where their owner has them: columns of vectors and quaternions, double or float, any
/// distance apart. Nothing is kept or converted until a row is read; a float means its value, which
/// a double has exactly.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0 {

/// Rows whose numbers lie next to each other. A row may lie anywhere, aligned for no type.
template <std::floating_point Number>
struct Strided {
  const Number* first = nullptr;  ///< of the first row
  std::size_t size = 0;           ///< rows
  /// Bytes from one row to the next: negative for rows in reverse order, 0 for one row that all
  /// have in common.
  std::ptrdiff_t stride = 0;
};

/// Where a quaternion's real part stands.
enum class QuaternionOrder { wxyz, xyzw };

/// Rows of N numbers, double or float.
template <std::size_t N>
class NumberColumn {
 public:
  NumberColumn() = default;
  /// Rows of doubles.
  NumberColumn(const Strided<double>& rows) : NumberColumn(rows, false) {}
  /// Rows of floats, each of which means the value that it has.
  NumberColumn(const Strided<float>& rows) : NumberColumn(rows, true) {}

  /// The number of rows.
  std::size_t size() const noexcept { return size_; }
  /// i < size(), not checked.
  void read(std::size_t i, double* row) const noexcept {
    const std::byte* const from = first_ + static_cast<std::ptrdiff_t>(i) * stride_;
    if (!is_float_) {
      std::memcpy(row, from, N * sizeof(double));
      return;
    }
    float numbers[N];
    std::memcpy(numbers, from, sizeof numbers);
    for (std::size_t k = 0; k < N; ++k) row[k] = numbers[k];
  }

 private:
  template <class Number>
  NumberColumn(const Strided<Number>& rows, bool is_float)
      : first_(reinterpret_cast<const std::byte*>(rows.first)),
        size_(rows.size),
        stride_(rows.stride),
        is_float_(is_float) {}

  const std::byte* first_ = nullptr;
  std::size_t size_ = 0;
  std::ptrdiff_t stride_ = 0;
  bool is_float_ = false;
};

/// x y z of each row.
class VectorColumn : public NumberColumn<3> {
 public:
  /// From rows of doubles or floats.
  using NumberColumn::NumberColumn;
  /// Vectors one after the other.
  VectorColumn(std::span<const Vec3> vectors)
      : NumberColumn(Strided<double>{vectors.empty() ? nullptr : vectors[0].data(), vectors.size(),
                                     static_cast<std::ptrdiff_t>(sizeof(Vec3))}) {}

  /// @overload
  VectorColumn(const std::vector<Vec3>& vectors) : VectorColumn(std::span<const Vec3>(vectors)) {}

  /// Row i < size().
  Vec3 operator[](std::size_t i) const noexcept {
    Vec3 v;
    read(i, v.data());
    return v;
  }
};

/// The four numbers of each row, in the order that is said.
class QuaternionColumn : public NumberColumn<4> {
 public:
  QuaternionColumn() = default;
  /// Rows of four numbers in the order given.
  QuaternionColumn(const NumberColumn& rows, QuaternionOrder order)
      : NumberColumn(rows), order_(order) {}
  /// Quaternions one after the other.
  QuaternionColumn(std::span<const Quaternion> quaternions)
      : NumberColumn(Strided<double>{quaternions.empty() ? nullptr : quaternions[0].coeffs().data(),
                                     quaternions.size(),
                                     static_cast<std::ptrdiff_t>(sizeof(Quaternion))}),
        order_(QuaternionOrder::xyzw) {}

  /// @overload
  QuaternionColumn(const std::vector<Quaternion>& quaternions)
      : QuaternionColumn(std::span<const Quaternion>(quaternions)) {}

  /// Row i < size().
  Quaternion operator[](std::size_t i) const noexcept {
    double q[4];
    read(i, q);
    if (order_ == QuaternionOrder::wxyz) return {q[0], q[1], q[2], q[3]};
    return {q[3], q[0], q[1], q[2]};
  }

 private:
  QuaternionOrder order_ = QuaternionOrder::xyzw;
};

}  // namespace tangency::inline v0
