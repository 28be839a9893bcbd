// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <tangency/geometry/bindings/c/ask.hpp>
#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/gap_batch.hpp>

namespace tangency::inline v0::c {
namespace {

/// The numbers of contact_bounds() need whole answers: columns for what was not asked for.
struct Whole {
  Whole(tangency_contact_columns& columns, std::size_t count) {
    if (!columns.normal_bound && !columns.arm_a_bound && !columns.arm_b_bound) return;
    const auto give = [&](double*& column, std::size_t width) {
      if (column == nullptr) column = numbers.emplace_back(width * count).data();
    };
    give(columns.gap, 1);
    give(columns.gap_error, 1);
    give(columns.normal, 3);
    give(columns.arm_a, 3);
    give(columns.arm_b, 3);
    if (columns.status == nullptr) columns.status = values.emplace_back(count).data();
    if (columns.tier == nullptr) columns.tier = values.emplace_back(count).data();
    wanted = true;
  }

  std::vector<std::vector<double>> numbers;
  std::vector<std::vector<int>> values;
  bool wanted = false;
};

void put_bounds(const tangency_contact_columns& to, std::size_t k, const ContactBounds& bounds) {
  put(to.normal_bound, k, bounds.normal);
  put(to.arm_a_bound, k, bounds.arm_a);
  put(to.arm_b_bound, k, bounds.arm_b);
}

Gap gap_at(const tangency_contact_columns& from, std::size_t k) {
  return {from.gap[k],
          vectors(from.normal)[k],
          vectors(from.arm_a)[k],
          vectors(from.arm_b)[k],
          from.gap_error[k],
          static_cast<GapStatus>(from.status[k]),
          static_cast<GapTier>(from.tier[k])};
}

void bound(const tangency_bodies& bodies, const Pairs& pairs, const tangency_contact_columns& to,
           int threads) {
  const std::vector<Ellipsoid>& all = bodies.prepared().ellipsoids;
  each(pairs.size(), threads, [&](std::size_t k) {
    const Ellipsoid &a = all[pairs[k].a], &b = all[pairs[k].b];
    const Gap gap = gap_at(to, k);
    put_bounds(to, k,
               pairs.separated() ? contact_bounds(a, b, pairs.separation(k), gap)
                                 : contact_bounds(a, b, gap));
  });
}

void contacts_of_matrices(const tangency_bodies& bodies, const Pairs& pairs,
                          const tangency_contact_columns& to, int threads) {
  each_pair<Separations::of_all>(
      bodies, pairs, threads,
      [](const auto& a, const auto& b, const auto&... separation) {
        return signed_gap(a, b, separation...);
      },
      [&](std::size_t k, const Gap& gap) { put_contact(to, k, gap, pairs.separation(bodies, k)); });
}

/// Normals that follow_gaps() starts from: 0, or of moderate length.
void require_normals(const double* normals, std::size_t count) {
  // Squares of components within [2^-100, 2^100] neither overflow nor underflow. Chosen.
  constexpr double kLeast = 0x1p-100, kMost = 0x1p100;
  for (std::size_t k = 0; k < count; ++k) {
    const double largest = vectors(normals)[k].cwiseAbs().maxCoeff();
    const bool finite = vectors(normals)[k].allFinite();
    if (!finite || (largest != 0.0 && !(largest >= kLeast && largest <= kMost))) {
      refuse_row("previous_normals", k, "largest component",
                 finite ? largest : std::numeric_limits<double>::quiet_NaN(),
                 "must be 0, or within [2^-100, 2^100]");
    }
  }
}

/// Of bodies by matrices.
void require_no_cutoff(const Accuracy& accuracy) {
  if (accuracy.cutoff < std::numeric_limits<double>::infinity())
    refuse("accuracy.has_cutoff", "must be 0 for bodies by matrices");
}

void ask_contacts(const tangency_bodies& bodies, const Pairs& pairs, const double* previous,
                  const tangency_accuracy* accuracy, tangency_contact_columns to, int threads) {
  const Accuracy wanted = accuracy_of(accuracy);
  const std::size_t count = pairs.size();
  if (bodies.by_matrices()) {
    if (previous != nullptr) refuse("previous_normals", "must be NULL for bodies by matrices");
    require_no_cutoff(wanted);
    if (to.normal_bound || to.arm_a_bound || to.arm_b_bound) {
      refuse("answers",
             "normal_bound, arm_a_bound and arm_b_bound are not known of bodies by "
             "matrices");
    }
    return contacts_of_matrices(bodies, pairs, to, threads);
  }
  const Whole whole(to, count);
  const GapColumns columns = gap_columns(to, count);
  if (previous == nullptr) {
    signed_gaps(bodies.moving(), pairs.list(), columns, wanted, threads);
  } else {
    require_normals(previous, count);
    follow_gaps(bodies.moving(), pairs.list(), {vectors(previous), count}, columns, wanted,
                threads);
  }
  if (whole.wanted) bound(bodies, pairs, to, threads);
}

/// Pairs of rows, some hundred at a time: what a block takes fits into the second-level cache.
class RowBlock {
 public:
  static constexpr std::size_t kPairs = 256;

  /// @throws Refused
  void take(const Rows& a, const Rows& b, std::size_t first, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
      take_row(a, first + k, &rows_[10 * k]);
      take_row(b, first + k, &rows_[10 * (count + k)]);
    }
    const Rows rows{"rows", rows_.data(), TANGENCY_NUMBER_DOUBLE, 2 * count, 10 * sizeof(double)};
    bodies_.assign(rows.column<VectorColumn>(3),
                   {QuaternionColumn(rows.column<NumberColumn<4>>(6), QuaternionOrder::wxyz),
                    rows.column<VectorColumn>()});
    if (pairs_.size() == count) return;
    pairs_.clear();
    for (std::size_t k = 0; k < count; ++k) pairs_.push_back(indexed_pair(k, count + k));
  }

  const MovingBodies& bodies() const noexcept { return bodies_; }
  PairList list() const noexcept { return {pairs_}; }

 private:
  static void take_row(const Rows& rows, std::size_t k, double* to) {
    rows.column<NumberColumn<10>>().read(k, to);
    if (const auto fault = Ellipsoid::find_fault({to[0], to[1], to[2]}, {to[3], to[4], to[5]},
                                                 Quaternion(to[6], to[7], to[8], to[9]))) {
      refuse_row(rows.argument, k, fault->field, fault->value, fault->rule);
    }
  }

  std::array<double, 20 * kPairs> rows_;
  std::vector<IndexedPair> pairs_;
  MovingBodies bodies_;
};

/// The same columns from row `first` on.
tangency_contact_columns from_row(tangency_contact_columns columns, std::size_t first) {
  const auto advance = [&](auto*& column, std::size_t width) {
    if (column != nullptr) column += width * first;
  };
  advance(columns.gap, 1);
  advance(columns.gap_error, 1);
  advance(columns.normal, 3);
  advance(columns.arm_a, 3);
  advance(columns.arm_b, 3);
  advance(columns.status, 1);
  advance(columns.tier, 1);
  advance(columns.point, 3);
  return columns;
}

void ask_rows(const Rows& a, const Rows& b, const Accuracy& accuracy,
              const tangency_contact_columns& to, int threads) {
  if (to.normal_bound || to.arm_a_bound || to.arm_b_bound) {
    refuse("answers", "normal_bound, arm_a_bound and arm_b_bound are of tangency_contacts()");
  }
  detail::in_ranges(a.count, threads, RowBlock::kPairs, [&](std::size_t first, std::size_t last) {
    thread_local RowBlock block;  // a single pair allocates nothing after the first call
    for (std::size_t k = first; k < last; k += RowBlock::kPairs) {
      const std::size_t count = std::min(RowBlock::kPairs, last - k);
      block.take(a, b, k, count);
      signed_gaps(block.bodies(), block.list(), gap_columns(from_row(to, k), count), accuracy);
    }
  });
}

/// The first row that is refused, whichever thread came upon one first.
void refuse_first_row(const Rows& a, const Rows& b) {
  for (std::size_t k = 0; k < a.count; ++k) {
    for (const Rows* rows : {&a, &b}) {
      const auto* const row =
          static_cast<const char*>(rows->first) + static_cast<std::ptrdiff_t>(k) * rows->stride;
      std::array<double, 10> p;
      std::memcpy(p.data(), row, sizeof p);
      if (const auto fault = Ellipsoid::find_fault({p[0], p[1], p[2]}, {p[3], p[4], p[5]},
                                                   Quaternion(p[6], p[7], p[8], p[9]))) {
        refuse_row(rows->argument, k, fault->field, fault->value, fault->rule);
      }
    }
  }
}

}  // namespace
}  // namespace tangency::inline v0::c

using namespace tangency;     // NOLINT(google-build-using-namespace): this file is the border
using namespace tangency::c;  // NOLINT(google-build-using-namespace)

extern "C" {

int tangency_contacts(const tangency_bodies* bodies, const unsigned* pairs, size_t count,
                      const double* separations, const double* previous_normals,
                      const tangency_accuracy* accuracy, const tangency_contact_columns* answers,
                      int threads) {
  return guarded([&] {
    const tangency_contact_columns to = known(answers, "answers");
    const Pairs list(required(bodies), pairs, count, separations);
    ask_contacts(*bodies, list, previous_normals, accuracy, to, threads);
  });
}

int tangency_contacts_of_rows(const double* a, ptrdiff_t a_stride, const double* b,
                              ptrdiff_t b_stride, size_t count, const tangency_accuracy* accuracy,
                              const tangency_contact_columns* answers, int threads) {
  return guarded([&] {
    const tangency_contact_columns to = known(answers, "answers");
    const Rows of_a{"a", a, TANGENCY_NUMBER_DOUBLE, count, a_stride};
    const Rows of_b{"b", b, TANGENCY_NUMBER_DOUBLE, count, b_stride};
    try {
      ask_rows(of_a, of_b, accuracy_of(accuracy), to, threads);
    } catch (const Refused& refused) {
      if (refused.code() == TANGENCY_BAD_ROW && threads > 1) refuse_first_row(of_a, of_b);
      throw;
    }
  });
}

int tangency_bounded_gaps(const tangency_bodies* bodies, const unsigned* pairs, size_t count,
                          const double* separations, const tangency_accuracy* accuracy,
                          const tangency_bounded_columns* answers, int threads) {
  return guarded([&] {
    const tangency_bounded_columns to = known(answers, "answers");
    const Pairs list(required(bodies), pairs, count, separations);
    const Accuracy wanted = accuracy_of(accuracy);
    if (bodies->by_matrices()) {
      require_no_cutoff(wanted);
      return each_pair<Separations::of_all>(
          *bodies, list, threads, [](const auto&... pair) { return bounded_gap(pair...); },
          [&](std::size_t k, const BoundedGap& gap) {
            put_contact(to, k, gap, list.separation(*bodies, k));
            put(to.above, k, gap.above);
          });
    }
    tangency_contact_columns columns{};
    columns.gap = to.gap;
    columns.gap_error = to.gap_error;
    columns.normal = to.normal;
    columns.arm_a = to.arm_a;
    columns.arm_b = to.arm_b;
    columns.status = to.status;
    columns.tier = to.tier;
    columns.point = to.point;
    bounded_gaps(bodies->moving(), list.list(),
                 {gap_columns(columns, count), numbers(to.above, count)}, wanted, threads);
  });
}

}  // extern "C"
