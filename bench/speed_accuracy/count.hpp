// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Instructions by row, counted by callgrind: the program starts valgrind on itself, and that
/// second run does nothing but answer each row's pairs once with the counter on.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace tangency::speed_accuracy {

/// Was <valgrind/callgrind.h> there when this was built?
bool can_count();

/// In the first run: instructions of every count_row() of the second, which is this program with
/// `arguments`.
/// @throws std::runtime_error  valgrind cannot be started, or the second run failed
std::map<std::string, double> count_by_valgrind(const std::vector<std::string>& arguments);

void start_counting();
void stop_counting(const std::string& row);

/// In the second run: run() with the counter on, under the name `row`. A few instructions of the
/// call itself are counted, too.
template <class Run>
void count_row(const std::string& row, const Run& run) {
  run();  // what is only done once is not counted
  start_counting();
  run();
  stop_counting(row);
}

}  // namespace tangency::speed_accuracy
