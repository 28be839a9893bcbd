// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/bench/speed_accuracy/count.hpp>

#include <filesystem>
#include <fstream>
#include <string_view>
#include <utility>

#include <tangency/bench/speed_accuracy/programs.hpp>

#if __has_include(<valgrind/callgrind.h>)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#include <valgrind/callgrind.h>
#define TANGENCY_CALLGRIND 1
#else
#define TANGENCY_CALLGRIND 0
#endif

namespace tangency::speed_accuracy {

bool can_count() { return TANGENCY_CALLGRIND != 0; }

void start_counting() {
#if TANGENCY_CALLGRIND
  CALLGRIND_TOGGLE_COLLECT;
#endif
}

void stop_counting([[maybe_unused]] const std::string& row) {
#if TANGENCY_CALLGRIND
  CALLGRIND_TOGGLE_COLLECT;
  CALLGRIND_DUMP_STATS_AT(row.c_str());
#endif
}

namespace {

namespace fs = std::filesystem;

/// Name and total of one of callgrind's files. The name is empty where no row was dumped.
std::pair<std::string, double> read_dump(const fs::path& path) {
  constexpr std::string_view kName = "desc: Trigger: Client Request: ", kTotal = "totals: ";
  std::ifstream file(path);
  std::pair<std::string, double> dump;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(kName)) dump.first = line.substr(kName.size());
    if (line.starts_with(kTotal)) dump.second = std::stod(line.substr(kTotal.size()));
  }
  return dump;
}

}  // namespace

std::map<std::string, double> count_by_valgrind(const std::vector<std::string>& arguments) {
  const TemporaryFolder folder;
  std::string command = "valgrind -q --tool=callgrind --collect-atstart=no --callgrind-out-file=" +
                        shell_word((folder.path() / "out").string()) + " " +
                        shell_word(fs::read_symlink("/proc/self/exe").string());
  for (const std::string& argument : arguments) command += " " + shell_word(argument);
  output_of(command);
  std::map<std::string, double> counts;
  for (const auto& file : fs::directory_iterator(folder.path())) {
    const auto [name, total] = read_dump(file.path());
    if (!name.empty()) counts[name] = total;
  }
  return counts;
}

}  // namespace tangency::speed_accuracy
