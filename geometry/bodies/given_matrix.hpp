// SPDX-License-Identifier: MIT
/// @file
/// What MatrixEllipsoid and MatrixEllipse have in common: the refusals of a matrix, levels, and the
/// solid of a matrix and a level. Internal (GMP).
///
/// `Invalid` is the exception of the body, InvalidEllipsoid or InvalidEllipse: field, value, rule.
#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

#include <tangency/geometry/bodies/rational_solid.hpp>
#include <tangency/geometry/numbers/integer_forms.hpp>

namespace tangency::inline v0::exact {

inline constexpr const char* kFiniteEntry = "an entry of a matrix must be finite";
inline constexpr const char* kPositiveDefinite = "the smallest eigenvalue must be > 0";

template <class Invalid>
[[noreturn]] void refuse(const char* field, double value, const char* rule) {
  throw Invalid({field, value, rule});
}

/// @param field  of this entry, in messages
template <class Invalid>
mpq_class rational_entry(double value, const char* field, const char* rule = kFiniteEntry) {
  if (!std::isfinite(value)) refuse<Invalid>(field, value, rule);
  return to_rational(value);
}

template <class Invalid>
mpq_class rational_level(double level) {
  if (!std::isfinite(level) || !(level > 0.0))
    refuse<Invalid>("level", level, "a level must be finite and > 0");
  return to_rational(level);
}

/// @param field  of the whole matrix, in messages
template <class Invalid, std::size_t N>
void require_definite(const RationalMatrix<N>& matrix, const char* field,
                      const char* rule = kPositiveDefinite) {
  if (!is_positive_definite(matrix)) refuse<Invalid>(field, smallest_eigenvalue(matrix), rule);
}

/// Are the semi-axes doubles, and is it known how far they are off?
/// @param error  infinite where it is not
template <class Invalid, std::size_t N>
void require_in_range(const NearestSolid<N>& solid, double error, const char* field) {
  constexpr const char* rule = "the semi-axes of the body must be within the range of doubles";
  const auto [least, most] = std::minmax_element(solid.semi_axes.begin(), solid.semi_axes.end());
  if (!std::isfinite(*most)) refuse<Invalid>(field, *most, rule);
  if (!std::isfinite(error)) refuse<Invalid>(field, *least, rule);
}

template <std::size_t N>
RationalMatrix<N> scaled(RationalMatrix<N> matrix, const mpq_class& factor) {
  for (auto& row : matrix) {
    for (mpq_class& entry : row) entry *= factor;
  }
  return matrix;
}

template <std::size_t N>
std::shared_ptr<const RationalSolid<N>> shared(RationalSolid<N> solid) {
  return std::make_shared<const RationalSolid<N>>(std::move(solid));
}

}  // namespace tangency::inline v0::exact
