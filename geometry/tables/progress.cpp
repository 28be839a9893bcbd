// SPDX-License-Identifier: MIT
#include <tangency/geometry/tables/progress.hpp>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <utility>

#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::tables {
namespace {

constexpr int kBarWidth = 30;  // characters: leaves room for the note on 100 columns
// Chosen: slow enough to be read, and to cost nothing.
constexpr std::chrono::milliseconds kBarInterval{100};
constexpr std::chrono::milliseconds kLineInterval{5000};

std::string time_left(double seconds) {
  if (seconds < 90.0) return rounded_text(std::ceil(seconds), 6) + " s left";
  if (seconds < 5400.0) return rounded_text(std::ceil(seconds / 60.0), 6) + " min left";
  return formatted("%.1f h left", seconds / 3600.0);
}

}  // namespace

Progress::Progress(Shown shown, std::optional<double> start)
    : on_terminal_(::isatty(STDERR_FILENO) != 0),
      enabled_(shown == Shown::everywhere || (shown == Shown::on_terminal && on_terminal_)),
      first_fraction_(start) {}

bool Progress::is_due() const {
  return enabled_ &&
         (!last_ || Clock::now() - *last_ >= (on_terminal_ ? kBarInterval : kLineInterval));
}

void Progress::show(double fraction, const std::string& note, double most_left) {
  if (!enabled_) return;
  last_ = Clock::now();
  if (!first_fraction_) first_fraction_ = fraction;
  const double spent = std::chrono::duration<double>(*last_ - start_).count();
  const double done = fraction - *first_fraction_;
  std::string line = note;
  if (done > 0.0 && fraction < 1.0) {
    line += ", about " + time_left(std::min(most_left, spent * (1.0 - fraction) / done));
  }
  if (on_terminal_) {
    const auto filled = static_cast<std::size_t>(std::clamp(fraction, 0.0, 1.0) * kBarWidth);
    line = "\r[" + std::string(filled, '#') + std::string(kBarWidth - filled, ' ') + "] " + line +
           "\x1b[K";
    bar_is_open_ = true;
  } else {
    line = to_text(std::lround(100.0 * fraction)) + " %: " + line + '\n';
  }
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
}

void Progress::clear() noexcept {
  if (!std::exchange(bar_is_open_, false)) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
}

void Progress::finish() {
  if (!std::exchange(bar_is_open_, false)) return;
  std::fputs("\n", stderr);
  std::fflush(stderr);
}

}  // namespace tangency::inline v0::tables
