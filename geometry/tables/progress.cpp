// SPDX-License-Identifier: MIT
#include <tangency/geometry/tables/progress.hpp>

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace tangency::tool {
namespace {

// Chosen: smaller files are done before anyone has read the line.
constexpr std::uint64_t kSmallestFile = 4'000'000;
// Chosen: slow enough to be read, and to cost nothing.
constexpr std::chrono::milliseconds kInterval{200};

}  // namespace

Progress::Progress(std::string input, std::optional<std::uint64_t> total_bytes, bool welcome)
    : input_(std::move(input)),
      total_bytes_(static_cast<double>(total_bytes.value_or(0))),
      enabled_(welcome && total_bytes.value_or(0) > kSmallestFile && ::isatty(STDERR_FILENO) == 1) {
}

Progress::~Progress() { clear(); }

void Progress::update(std::uint64_t bytes) {
  if (!enabled_ || bytes == 0) return;
  const Clock::time_point now = Clock::now();
  if (last_shown_ && now - *last_shown_ < kInterval) return;
  last_shown_ = now;
  const double done = static_cast<double>(bytes) / total_bytes_;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  std::fprintf(stderr, "\r\033[K%s: %.0f %%, %.0f s left", input_.c_str(), 100 * done,
               seconds * (1 - done) / done);
  std::fflush(stderr);
  shown_ = true;
}

void Progress::clear() noexcept {
  if (!std::exchange(shown_, false)) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
}

}  // namespace tangency::tool
