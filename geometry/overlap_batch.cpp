// SPDX-License-Identifier: MIT
#include <tangency/geometry/overlap_batch.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <tangency/geometry/batch/float_lanes.hpp>
#include <tangency/geometry/batch/gap_lanes.hpp>
#include <tangency/geometry/batch/pair_task.hpp>
#include <tangency/geometry/batch/parts.hpp>
#include <tangency/geometry/numbers/contract.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>

namespace tangency::inline v0 {
namespace {

using detail::kBlock;
using detail::PairTask;

// How often it is asked anew whether a first step is worth its time: pairs near each other in a
// list are alike. Chosen.
constexpr std::size_t kBlocksOfAHint = 16;

/// Eight answers of one byte each, 1 or 0, from the lowest bits.
std::uint64_t spread(std::uint64_t bits) {
  const std::uint64_t one_a_byte = (bits & 0xff) * 0x0101010101010101 & 0x8040201008040201;
  return (one_a_byte + 0x7f7f7f7f7f7f7f7f) >> 7 & 0x0101010101010101;
}

/// The answers of a block to yes or no, bit by bit.
template <class Answer>
void write(std::uint64_t meet, std::size_t count, Answer* to) {
  std::size_t i = 0;
  if constexpr (sizeof(Answer) == 1 && std::endian::native == std::endian::little) {
    for (; i + 8 <= count; i += 8) {
      const std::uint64_t eight = spread(meet >> i);
      std::memcpy(to + i, &eight, sizeof eight);
    }
  }
  for (; i < count; ++i) to[i] = Answer((meet >> i & 1) != 0);
}

/// Pairs that float leaves open, for the lanes in double as soon as they are a block; what those
/// leave open is asked as doubtful(i).
template <class Answer, class Doubtful>
class LeftOpen {
 public:
  LeftOpen(const PairTask& task, Answer* answers, const Doubtful& doubtful)
      : task_(task), answers_(answers), doubtful_(doubtful) {}

  void add(std::size_t i) {
    index_[count_] = i;
    pairs_[count_] = task_.pairs[i];
    if (task_.separations != nullptr) separations_[count_] = task_.separations[i];
    if (++count_ == kBlock) answer();
  }

  void answer() {
    if (count_ == 0) return;
    std::fill(pairs_ + count_, pairs_ + kBlock, pairs_[0]);
    std::fill(separations_ + count_, separations_ + kBlock, separations_[0]);
    detail::LaneBlock block{};
    block.bodies_a = block.bodies_b = task_.lanes;
    block.pairs = pairs_;
    block.count = static_cast<int>(count_);
    block.separations = task_.separations != nullptr ? separations_[0].data() : nullptr;
    const detail::LaneOverlaps lanes = detail::overlap_lanes(block);
    for (std::size_t k = 0; k < count_; ++k) {
      const bool decided = (lanes.decided >> k & 1) != 0;
      answers_[index_[k]] =
          decided ? Answer((lanes.meet >> k & 1) != 0) : Answer(doubtful_(index_[k]));
    }
    count_ = 0;
  }

 private:
  const PairTask& task_;
  Answer* answers_;
  const Doubtful& doubtful_;
  std::size_t count_ = 0;
  std::size_t index_[kBlock];
  IndexedPair pairs_[kBlock];
  Vec3 separations_[kBlock];
};

/// Pairs begin to end: what float proves, what double does of the others, and doubtful(i).
template <class Answer, class Doubtful>
void run_here(const PairTask& task, Answer* answers, const Doubtful& doubtful, std::size_t begin,
              std::size_t end) {
  detail::Workspace work;
  std::size_t blocks = 0;
  LeftOpen<Answer, Doubtful> left(task, answers, doubtful);
  for (std::size_t first = begin; first < end; first += kBlock) {
    const std::size_t count = std::min(kBlock, end - first);
#ifndef NDEBUG  // 7 % of the quickest call
    task.require_indices(first, count);
#endif
    gather(task, first, count, work, nullptr);
    const bool asking = blocks++ % kBlocksOfAHint == 0;
    if (asking) work.block.yes_no_steps = 0;
    const detail::LaneOverlaps lanes = detail::float_overlap_lanes(work.block);
    if (asking) work.block.yes_no_steps = lanes.mostly_open ? 1 : 0;
    write(lanes.meet, count, answers + first);
    std::uint64_t open = ~lanes.decided;
    if (count < kBlock) open &= (std::uint64_t{1} << count) - 1;
    for (; open != 0; open &= open - 1)
      left.add(first + static_cast<std::size_t>(std::countr_zero(open)));
  }
  left.answer();
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
