// SPDX-License-Identifier: MIT
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <tangency/geometry/bindings/c/ask.hpp>
#include <tangency/geometry/bounded_gap.hpp>
#include <tangency/geometry/overlap_batch.hpp>
#include <tangency/geometry/relation.hpp>

namespace tangency::inline v0::c {
namespace {

constexpr auto kRelation = [](const auto& a, const auto& b, const auto&... separation) {
  return relation(a, b, separation...);
};

bool interiors_meet(Relation relation) {
  return relation != Relation::separate && relation != Relation::external_touch;
}

void require_answers(const unsigned char* answers, std::size_t count) {
  if (answers == nullptr && count > 0) refuse("answers", "must not be NULL");
}

}  // namespace
}  // namespace tangency::inline v0::c

using namespace tangency;     // NOLINT(google-build-using-namespace): this file is the border
using namespace tangency::c;  // NOLINT(google-build-using-namespace)

extern "C" {

int tangency_relations(const tangency_bodies* bodies, const unsigned* pairs, size_t count,
                       const double* separations, const tangency_relation_columns* answers,
                       int threads) {
  return guarded([&] {
    const tangency_relation_columns to = known(answers, "answers");
    const Pairs list(required(bodies), pairs, count, separations);
    each_pair<Separations::of_all>(*bodies, list, threads, kRelation,
                                   [&](std::size_t k, const RelationAnswer& answer) {
                                     put(to.relation, k, answer.relation);
                                     put(to.inner, k, answer.inner);
                                     put(to.tier, k, answer.tier);
                                   });
  });
}

int tangency_overlaps(const tangency_bodies* bodies, const unsigned* pairs, size_t count,
                      const double* separations, unsigned char* answers, int threads) {
  return guarded([&] {
    const Pairs list(required(bodies), pairs, count, separations);
    require_answers(answers, count);
    if (!bodies->by_matrices()) {
      return overlaps(bodies->prepared().array, list.list(), std::span(answers, count), threads);
    }
    each_pair<Separations::of_all>(*bodies, list, threads, kRelation,
                                   [&](std::size_t k, const RelationAnswer& answer) {
                                     answers[k] = interiors_meet(answer.relation) ? 1 : 0;
                                   });
  });
}

int tangency_overlaps_by_filter(const tangency_bodies* bodies, const unsigned* pairs, size_t count,
                                const double* separations, unsigned char* answers, int threads) {
  return guarded([&] {
    const Pairs list(required(bodies), pairs, count, separations);
    require_answers(answers, count);
    if (bodies->by_matrices()) {
      return each_pair<Separations::of_all>(
          *bodies, list, threads, [](const auto&... pair) { return bounded_gap(pair...); },
          [&](std::size_t k, const BoundedGap& found) {
            answers[k] = found.gap > found.gap_error ? 0 : found.gap < -found.above ? 1 : 2;
          });
    }
    std::vector<std::optional<bool>> found(count);
    overlaps_by_filter(bodies->prepared().array, list.list(), found, threads);
    for (std::size_t k = 0; k < count; ++k) {
      answers[k] = !found[k] ? 2 : *found[k] ? 1 : 0;
    }
  });
}

}  // extern "C"
