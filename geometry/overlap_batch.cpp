// SPDX-License-Identifier: MIT
#include <tangency/geometry/overlap_batch.hpp>

#include <algorithm>
#include <cstddef>

#include <tangency/geometry/batch/gap_lanes.hpp>
#include <tangency/geometry/batch/pair_task.hpp>
#include <tangency/geometry/batch/parts.hpp>
#include <tangency/geometry/numbers/contract.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>

namespace tangency::inline v0 {
namespace {

using detail::kBlock;
using detail::PairTask;

/// What a lane proves, and doubtful(i) for the other pairs, of pairs begin to end.
template <class Answer, class Doubtful>
void run_here(const PairTask& task, Answer* answers, const Doubtful& doubtful, std::size_t begin,
              std::size_t end) {
  detail::Workspace work;
  for (std::size_t first = begin; first < end; first += kBlock) {
    const std::size_t count = std::min(kBlock, end - first);
#ifndef NDEBUG  // 7 % of the quickest call
    task.require_indices(first, count);
#endif
    gather(task, first, count, work);
    const detail::LaneOverlaps lanes = detail::overlap_lanes(work.block);
    Answer* const to = answers + first;  // a copy: bytes are written, which could be anything
    for (std::size_t i = 0; i < count; ++i) {
      const bool decided = (lanes.decided >> i & 1) != 0;
      to[i] = decided ? Answer((lanes.meet >> i & 1) != 0) : Answer(doubtful(first + i));
    }
  }
}

template <class Answer, class Doubtful>
void run(const PairTask& task, std::span<Answer> answers, int threads, const Doubtful& doubtful) {
  contract::require_length(task.call, "answers", answers.size(), task.count);
  detail::in_ranges(task.count, threads, kBlock, [&](std::size_t first, std::size_t last) {
    in_default_environment([&] { run_here(task, answers.data(), doubtful, first, last); });
  });
}

}  // namespace

void overlaps(const BodyArray& bodies, const PairList& list, std::span<bool> answers,
              int threads) noexcept {
  const PairTask task("overlaps", bodies, list);
  run(task, answers, threads, [&](std::size_t i) { return task.overlaps(i); });
}

void overlaps(const BodyArray& bodies, const PairList& list, std::span<std::uint8_t> answers,
              int threads) noexcept {
  const PairTask task("overlaps", bodies, list);
  run(task, answers, threads, [&](std::size_t i) { return task.overlaps(i); });
}

void overlaps_by_filter(const BodyArray& bodies, const PairList& list,
                        std::span<std::optional<bool>> answers, int threads) noexcept {
  const PairTask task("overlaps_by_filter", bodies, list);
  run(task, answers, threads, [&](std::size_t i) { return task.overlaps_by_filter(i); });
}

}  // namespace tangency::inline v0
