// SPDX-License-Identifier: MIT
#include <tangency/geometry/bindings/c/ask.hpp>

#include <array>
#include <cstring>
#include <string>

#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::c {
namespace {

static_assert(sizeof(IndexedPair) == 2 * sizeof(unsigned) && sizeof(unsigned) == 4);

constexpr std::array<const char*, 3> kComponents{"x", "y", "z"};

/// What the entries a and b of pairs may be.
struct Limit {
  std::size_t count;
  const char* what;
};

[[noreturn]] void refuse_index(std::size_t row, const char* entry, std::size_t index,
                               const Limit& limit) {
  refuse_row("pairs", row, entry, static_cast<double>(index),
             "must be below " + tables::to_text(limit.count) + ", the number of " + limit.what);
}

/// The largest entries first, which vector instructions find: a million good pairs take 0.3 ms.
void require_indices(std::span<const IndexedPair> pairs, const Limit& a, const Limit& b) {
  std::uint32_t most_a = 0, most_b = 0;
  for (const IndexedPair& pair : pairs) {
    most_a = std::max(most_a, pair.a);
    most_b = std::max(most_b, pair.b);
  }
  if (pairs.empty() || (most_a < a.count && most_b < b.count)) return;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (pairs[k].a >= a.count) refuse_index(k, "a", pairs[k].a, a);
    if (pairs[k].b >= b.count) refuse_index(k, "b", pairs[k].b, b);
  }
}

}  // namespace

void require_size(const char* argument, std::size_t size) {
  const bool ends_with_a_field = size >= 2 * kFieldBytes && size % kFieldBytes == 0;
  if (!ends_with_a_field || size > kMostBytes) {
    refuse_value(std::string(argument) + ".size", static_cast<double>(size),
                 "must be sizeof of the struct");
  }
}

void require_half(std::size_t count, std::size_t things, const char* what) {
  if (things % 2 == 0 && count == things / 2) return;
  refuse_value(
      "count", static_cast<double>(count),
      "without pairs must be half of " + tables::to_text(things) + ", the number of " + what);
}

void require_finite_rows(const char* argument, const double* rows, std::size_t width,
                         std::size_t count, const char* const* names) {
  if (rows == nullptr && count > 0) refuse(argument, "must not be NULL");
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < width; ++i) {
      const double x = rows[width * k + i];
      if (!std::isfinite(x)) refuse_row(argument, k, names[i], x, "must be finite");
    }
  }
}

const tangency_bodies& required(const tangency_bodies* bodies) {
  if (bodies == nullptr) refuse("bodies", "must not be NULL");
  return *bodies;
}

Pairs::Pairs(const tangency_bodies& bodies, const unsigned* pairs, std::size_t count,
             const double* separations) {
  if (pairs == nullptr) require_half(count, bodies.size(), "bodies");
  take(pairs, count, count);
  require_indices(list_, {bodies.size(), "bodies"}, {bodies.size(), "bodies"});
  if (separations != nullptr) {
    require_finite_rows("separations", separations, 3, count, kComponents.data());
    separations_ = {vectors(separations), count};
  }
}

Pairs::Pairs(std::size_t bodies, std::size_t others, const char* what, const unsigned* pairs,
             std::size_t count) {
  if (pairs == nullptr && count > std::min(bodies, others)) {
    const Limit limit = bodies < others ? Limit{bodies, "bodies"} : Limit{others, what};
    refuse_value("count", static_cast<double>(count),
                 "without pairs must be at most " + tables::to_text(limit.count) +
                     ", the number of " + limit.what);
  }
  take(pairs, count, 0);
  require_indices(list_, {bodies, "bodies"}, {others, what});
}

Vec3 Pairs::separation(const tangency_bodies& bodies, std::size_t k) const noexcept {
  if (separated()) return separations_[k];
  const auto [a, b] = list_[k];
  return bodies.matrix(b).ellipsoid().centre() - bodies.matrix(a).ellipsoid().centre();
}

void Pairs::take(const unsigned* pairs, std::size_t count, std::size_t first_b) {
  if (pairs != nullptr) {
    list_ = {reinterpret_cast<const IndexedPair*>(pairs), count};
    return;
  }
  own_.reserve(count);
  for (std::size_t k = 0; k < count; ++k) own_.push_back(indexed_pair(k, first_b + k));
  list_ = own_;
}

Accuracy accuracy_of(const tangency_accuracy* accuracy) {
  if (accuracy == nullptr) return {};
  const tangency_accuracy given = known(accuracy, "accuracy");
  if (!(given.of_size >= 0.0)) refuse_value("accuracy.of_size", given.of_size, "must be >= 0");
  if (!(given.length >= 0.0)) refuse_value("accuracy.length", given.length, "must be >= 0");
  const Accuracy every_pair{given.of_size, given.length, given.normals != 0};
  if (given.has_cutoff == 0) return every_pair;
  // Else a caller that says no cutoff would have 0, which is one.
  if (accuracy->size < sizeof given)
    refuse("accuracy.has_cutoff", "must be 0 where accuracy.size ends before cutoff");
  if (!(given.cutoff >= 0.0)) refuse_value("accuracy.cutoff", given.cutoff, "must be >= 0");
  return every_pair.up_to(given.cutoff);
}

GapColumns gap_columns(const tangency_contact_columns& columns, std::size_t count) {
  return {.gap = numbers(columns.gap, count),
          .gap_error = numbers(columns.gap_error, count),
          .normal = vectors(columns.normal, count),
          .arm_a = vectors(columns.arm_a, count),
          .arm_b = vectors(columns.arm_b, count),
          .status = values<GapStatus>(columns.status, count),
          .tier = values<GapTier>(columns.tier, count),
          .point = vectors(columns.point, count)};
}

}  // namespace tangency::inline v0::c
