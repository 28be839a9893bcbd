// SPDX-License-Identifier: MIT
/// @file
/// What stands behind the opaque types of tangency.h, and how rows of numbers become bodies.
/// Internal.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include <tangency/geometry/bindings/c/failure.hpp>
#include <tangency/geometry/body_array.hpp>
#include <tangency/geometry/matrix_ellipse.hpp>
#include <tangency/geometry/matrix_ellipsoid.hpp>
#include <tangency/geometry/moving_bodies.hpp>
#include <tangency/geometry/strided.hpp>

namespace tangency::inline v0::c {

/// Ellipsoids, and what calls with a BodyArray read of them.
struct Prepared {
  explicit Prepared(std::vector<Ellipsoid> of) : ellipsoids(std::move(of)), array(ellipsoids) {}

  std::vector<Ellipsoid> ellipsoids;
  BodyArray array;
};

/// Rows as a caller describes them: which argument they are, and where they lie.
struct Rows {
  const char* argument;
  const void* first;
  int number;
  std::size_t count;
  std::ptrdiff_t stride;

  /// A NumberColumn or VectorColumn of the numbers from the `from`-th of each row on.
  /// @throws Refused  a null pointer, an unknown type of number
  template <class Column>
  Column column(std::size_t from = 0) const {
    if (number == TANGENCY_NUMBER_DOUBLE) return strided<double>(from);
    if (number == TANGENCY_NUMBER_FLOAT) return strided<float>(from);
    refuse_value("number", number, "must be a tangency_number");
  }

 private:
  template <class Number>
  Strided<Number> strided(std::size_t from) const {
    if (first == nullptr && count > 0) refuse(argument, "must not be NULL");
    const auto* const numbers = static_cast<const Number*>(first);
    return {numbers == nullptr ? nullptr : numbers + from, count, stride};
  }
};

/// @throws Refused  naming the first row that makes no ellipsoid, field, value and rule
void require_axes(const Rows& rows);

}  // namespace tangency::inline v0::c

struct tangency_bodies {
 public:
  std::size_t size() const noexcept { return moving_.size(); }
  bool by_matrices() const noexcept { return !matrices_.empty(); }
  /// All of them, centres included.
  const tangency::MovingBodies& moving() const noexcept { return moving_; }
  /// Of bodies by matrices.
  const tangency::MatrixEllipsoid& matrix(std::size_t i) const noexcept { return matrices_[i]; }
  std::span<const tangency::MatrixEllipsoid> matrices() const noexcept { return matrices_; }
  /// Is the solid another than that of its semi-axes?
  bool rounded(std::size_t i) const noexcept {
    return by_matrices() && matrices_[i].exact() != nullptr;
  }
  /// Made when it is first asked for. Any number of threads may ask.
  const tangency::c::Prepared& prepared() const;

  /// Behind those there are. Where it throws nothing has changed.
  void append(int form, const tangency::c::Rows& rows, double level);
  void set(std::size_t first, const tangency::c::Rows& rows);

 private:
  void append_axes(const tangency::c::Rows& rows);
  void append_matrices(int form, const tangency::c::Rows& rows, double level);

  tangency::MovingBodies moving_;
  std::vector<tangency::MatrixEllipsoid> matrices_;  ///< none, or as many as bodies
  mutable std::mutex preparing_;
  mutable std::unique_ptr<const tangency::c::Prepared> prepared_;
};

struct tangency_ellipses {
  std::vector<tangency::MatrixEllipse> all;
};
