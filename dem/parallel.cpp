// SPDX-License-Identifier: MIT
#include <tangency/dem/parallel.hpp>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <memory>
#include <optional>

namespace tangency::inline v0::dem {
namespace {

/// The threads of this library's loops. TBB's limit for the process is raised where they are more
/// than it would allow, and else left to the program.
struct Team {
  int size;
  std::optional<tbb::global_control> control;
  tbb::task_arena arena;

  explicit Team(int count) : size(count), arena(count) {
    if (count > tbb::info::default_concurrency())
      control.emplace(tbb::global_control::max_allowed_parallelism,
                      static_cast<std::size_t>(count));
  }
};

std::unique_ptr<Team>& team() {
  static std::unique_ptr<Team> one = std::make_unique<Team>(tbb::info::default_concurrency());
  return one;
}

}  // namespace

void set_threads(int count) {
  const int wanted = count > 0 ? count : tbb::info::default_concurrency();
  if (team()->size != wanted) team() = std::make_unique<Team>(wanted);
}

int threads() { return team()->size; }

void share_range(std::size_t count, void (*call)(const void*, std::size_t, std::size_t),
                 const void* what) {
  Team& all = *team();
  if (all.size == 1) return call(what, 0, count);
  const std::size_t share =
      (count + static_cast<std::size_t>(all.size) - 1) / static_cast<std::size_t>(all.size);
  all.arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, share),
        [&](const tbb::blocked_range<std::size_t>& range) {
          call(what, range.begin(), range.end());
        },
        tbb::static_partitioner());
  });
}

}  // namespace tangency::inline v0::dem
