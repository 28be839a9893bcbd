// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/progress.hpp>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace tangency::dem {
namespace {

constexpr int kBarWidth = 30;  // characters: leaves room for the note on 100 columns
constexpr std::chrono::milliseconds kBarInterval{100};
constexpr std::chrono::milliseconds kLineInterval{5000};

std::string time_left(double seconds) {
  std::ostringstream text;
  if (seconds < 90.0)
    text << std::ceil(seconds) << " s left";
  else if (seconds < 5400.0)
    text << std::ceil(seconds / 60.0) << " min left";
  else
    text << std::fixed << std::setprecision(1) << seconds / 3600.0 << " h left";
  return text.str();
}

}  // namespace

Progress::Progress(bool quiet) : quiet_(quiet), on_terminal_(isatty(STDERR_FILENO) != 0) {}

bool Progress::is_due() const {
  return !quiet_ && (first_fraction_ < 0.0 ||
                     Clock::now() - last_ >= (on_terminal_ ? kBarInterval : kLineInterval));
}

void Progress::show(double fraction, const std::string& note, double most_left) {
  if (quiet_) return;
  last_ = Clock::now();
  if (first_fraction_ < 0.0) first_fraction_ = fraction;
  const double spent = std::chrono::duration<double>(last_ - start_).count();
  const double done = fraction - first_fraction_;
  const std::string left =
      done > 0.0 && fraction < 1.0
          ? ", about " + time_left(std::min(most_left, spent * (1.0 - fraction) / done))
          : std::string();
  if (on_terminal_) {
    const auto filled = static_cast<std::size_t>(std::clamp(fraction, 0.0, 1.0) * kBarWidth);
    std::cerr << "\r[" << std::string(filled, '#') << std::string(kBarWidth - filled, ' ') << "] "
              << note << left << "\x1b[K" << std::flush;
    bar_is_open_ = true;
  } else {
    std::cerr << std::lround(100.0 * fraction) << " %: " << note << left << std::endl;
  }
}

void Progress::finish() {
  if (bar_is_open_) std::cerr << std::endl;
  bar_is_open_ = false;
}

}  // namespace tangency::dem
