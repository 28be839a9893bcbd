// SPDX-License-Identifier: MIT
/// @file
/// What the questions of the C interface have in common: structs that begin with their size, lists
/// of pairs that are checked, columns of answers, and loops over pairs. Internal.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <tangency/geometry/batch/parts.hpp>
#include <tangency/geometry/bindings/c/bodies.hpp>
#include <tangency/geometry/gap_batch.hpp>

namespace tangency::inline v0::c {

/// Every field of the structs is a pointer, a double or a pair of ints.
inline constexpr std::size_t kFieldBytes = 8;
/// What is longer is no struct of any version. Chosen: 511 fields, 20 times the most there are.
inline constexpr std::size_t kMostBytes = 4096;

/// The size of a caller's struct, which ends with a field.
/// @throws Refused  where no version has such a struct
void require_size(const char* argument, std::size_t size);

/// The caller's struct as this version knows it. A shorter one asks for nothing of what it lacks;
/// of a longer one nothing may be set that is not known here.
template <class Struct>
Struct known(const Struct* given, const char* argument) {
  if (given == nullptr) refuse(argument, "must not be NULL");
  static_assert(sizeof(Struct) % kFieldBytes == 0 && sizeof(Struct) <= kMostBytes);
  Struct copy{};
  const std::size_t size = given->size;
  require_size(argument, size);
  std::memcpy(&copy, given, std::min(size, sizeof copy));
  const auto* const bytes = reinterpret_cast<const unsigned char*>(given);
  for (std::size_t i = sizeof copy; i < size; ++i) {
    if (bytes[i] != 0)
      refuse(argument, "has fields that this version of the library does not know");
  }
  return copy;
}

inline const Vec3* vectors(const double* numbers) { return reinterpret_cast<const Vec3*>(numbers); }

/// A column of answers of `count` rows, empty where it is not asked for.
inline std::span<double> numbers(double* column, std::size_t count) {
  return {column, column == nullptr ? 0 : count};
}
inline std::span<Vec3> vectors(double* column, std::size_t count) {
  return {reinterpret_cast<Vec3*>(column), column == nullptr ? 0 : count};
}
template <class Enumeration>
std::span<Enumeration> values(int* column, std::size_t count) {
  static_assert(sizeof(Enumeration) == sizeof(int));
  return {reinterpret_cast<Enumeration*>(column), column == nullptr ? 0 : count};
}

inline void put(double* column, std::size_t k, double x) {
  if (column != nullptr) column[k] = x;
}
template <class Enumeration>
requires std::is_enum_v<Enumeration>
void put(int* column, std::size_t k, Enumeration x) {
  if (column != nullptr) column[k] = static_cast<int>(x);
}
inline void put(int* column, std::size_t k, int x) {
  if (column != nullptr) column[k] = x;
}
/// A vector or a matrix row by row.
template <class Matrix>
requires requires(const Matrix& m) { m.derived(); }
void put(double* column, std::size_t k, const Matrix& m) {
  if (column == nullptr) return;
  double* to = column + k * static_cast<std::size_t>(m.size());
  for (Eigen::Index row = 0; row < m.rows(); ++row)
    for (Eigen::Index i = 0; i < m.cols(); ++i) *to++ = m(row, i);
}

/// What of a Gap, BoundedGap, OtherGap or PlaneGap is asked for.
template <class Columns, class AnyGap>
void put_gap(const Columns& to, std::size_t k, const AnyGap& gap) {
  put(to.gap, k, gap.gap);
  put(to.gap_error, k, gap.gap_error);
  put(to.normal, k, gap.normal);
  put(to.arm_a, k, gap.arm_a);
  put(to.arm_b, k, gap.arm_b);
  put(to.status, k, gap.status);
}

/// The same, tier and the point between the witness points, of the separation of the centres.
template <class Columns, class AnyGap>
void put_contact(const Columns& to, std::size_t k, const AnyGap& gap, const Vec3& separation) {
  put_gap(to, k, gap);
  put(to.tier, k, gap.tier);
  put(to.point, k, Vec3(0.5 * (gap.arm_a + (separation + gap.arm_b))));
}

/// @throws Refused  naming row and component
void require_finite_rows(const char* argument, const double* rows, std::size_t width,
                         std::size_t count, const char* const* names);

/// Of pairs k and count + k, which are not listed before their number is known to be right.
/// @throws Refused  where count is not half of `things`
void require_half(std::size_t count, std::size_t things, const char* what);

const tangency_bodies& required(const tangency_bodies* bodies);

/// The pairs of a call, checked.
class Pairs {
 public:
  /// Of bodies among each other; without pairs those of k and count + k.
  Pairs(const tangency_bodies& bodies, const unsigned* pairs, std::size_t count,
        const double* separations = nullptr);
  /// Of a body and something else, of which there are `others`; without pairs both are k.
  Pairs(std::size_t bodies, std::size_t others, const char* what, const unsigned* pairs,
        std::size_t count);

  std::size_t size() const noexcept { return list_.size(); }
  IndexedPair operator[](std::size_t k) const noexcept { return list_[k]; }
  PairList list() const noexcept { return {list_, separations_}; }
  bool separated() const noexcept { return !separations_.empty(); }
  const Vec3& separation(std::size_t k) const noexcept { return separations_[k]; }
  /// That, or of the centres of bodies by matrices, rounded.
  Vec3 separation(const tangency_bodies& bodies, std::size_t k) const noexcept;

 private:
  void take(const unsigned* pairs, std::size_t count, std::size_t first_b);

  std::vector<IndexedPair> own_;
  std::span<const IndexedPair> list_;
  std::span<const Vec3> separations_;
};

/// work(k) for every k below count, many at a time in each thread's part.
template <class Work>
void each(std::size_t count, int threads, const Work& work) {
  // Questions that are asked one by one take from some 100 ns to 50 ms: many parts even that out.
  const std::size_t most = threads > 1 ? std::size_t{32} * static_cast<std::size_t>(threads) : 1;
  const std::size_t parts = std::min(count, most);
  if (parts == 0) return;
  detail::in_parts(parts, threads, [&](std::size_t part) {
    for (std::size_t k = count * part / parts; k < count * (part + 1) / parts; ++k) work(k);
  });
}

/// Do the calls with matrices take a separation?
enum class Separations { of_all, of_axes };

/// write(k, ask(a, b[, separation])) for every pair, of Ellipsoid or MatrixEllipsoid.
template <Separations kOf, class Ask, class Write>
void each_pair(const tangency_bodies& bodies, const Pairs& pairs, int threads, const Ask& ask,
               const Write& write) {
  if (bodies.by_matrices()) {
    if (kOf == Separations::of_axes && pairs.separated()) {
      refuse("separations", "must be NULL for bodies by matrices");
    }
    each(pairs.size(), threads, [&](std::size_t k) {
      const MatrixEllipsoid &a = bodies.matrix(pairs[k].a), &b = bodies.matrix(pairs[k].b);
      if constexpr (kOf == Separations::of_all) {
        if (pairs.separated()) return write(k, ask(a, b, pairs.separation(k)));
      }
      write(k, ask(a, b));
    });
    return;
  }
  const std::vector<Ellipsoid>& all = bodies.prepared().ellipsoids;
  each(pairs.size(), threads, [&](std::size_t k) {
    const Ellipsoid &a = all[pairs[k].a], &b = all[pairs[k].b];
    write(k, pairs.separated() ? ask(a, b, pairs.separation(k)) : ask(a, b));
  });
}

/// @throws Refused  a tolerance below 0, or a reserved field that is not
Accuracy accuracy_of(const tangency_accuracy* accuracy);

GapColumns gap_columns(const tangency_contact_columns& columns, std::size_t count);

}  // namespace tangency::inline v0::c
