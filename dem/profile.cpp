// SPDX-License-Identifier: MIT
#include <tangency/dem/profile.hpp>

#include <sys/resource.h>

#include <algorithm>

#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

constexpr std::array<const char*, kPhases> kNames{"motion", "bodies", "list",   "gaps",
                                                  "law",    "sums",   "control"};

double over(double x, double count) { return count > 0.0 ? x / count : 0.0; }

double a_cycle(std::int64_t count, const Profile& profile) {
  return over(static_cast<double>(count), static_cast<double>(profile.cycles));
}

std::string line_of(const char* name, double seconds, double all, double pairs) {
  return tables::formatted("%-12s", name) + tables::formatted("%12.3f", seconds) +
         tables::formatted("%9.1f", 100.0 * over(seconds, all)) +
         tables::formatted("%16.2f", 1e9 * over(seconds, pairs)) + "\n";
}

std::string count_line(const char* name, double count) {
  return tables::formatted("%-28s", name) + tables::formatted("%14.1f", count) + "\n";
}

}  // namespace

const char* name_of(Phase phase) { return kNames[static_cast<std::size_t>(phase)]; }

std::int64_t peak_memory() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return std::int64_t{usage.ru_maxrss} * 1024;  // Linux counts in KiB
}

std::vector<ProfileEntry> entries_of(const Profile& profile) {
  std::vector<ProfileEntry> entries;
  for (std::size_t k = 0; k < kPhases; ++k)
    if (profile.seconds[k] > 0.0)
      entries.emplace_back(std::string(kNames[k]) + "_seconds", profile.seconds[k]);
  entries.emplace_back("cycles", profile.cycles);
  entries.emplace_back("list_builds", profile.list_builds);
  const auto add = [&](const char* name, std::int64_t count) {
    if (count > 0) entries.emplace_back(name, a_cycle(count, profile));
  };
  add("listed_pairs_a_cycle", profile.listed_pairs);
  add("touching_pairs_a_cycle", profile.touching_pairs);
  add("slow_pairs_a_cycle", profile.slow_pairs);
  add("unanswered_contacts_a_cycle", profile.unanswered_contacts);
  entries.emplace_back("peak_memory_bytes", peak_memory());
  return entries;
}

std::string table_of(const Profile& profile, double cycle_seconds) {
  std::string text = "phase            seconds  percent  ns a listed pair\n";
  const auto pairs = static_cast<double>(profile.listed_pairs);
  double rest = cycle_seconds;
  for (std::size_t k = 0; k < kPhases; ++k) {
    rest -= profile.seconds[k];
    if (profile.seconds[k] > 0.0)
      text += line_of(kNames[k], profile.seconds[k], cycle_seconds, pairs);
  }
  text += line_of("other", std::max(rest, 0.0), cycle_seconds, pairs);
  text += line_of("all", cycle_seconds, cycle_seconds, pairs);
  text += count_line("cycles", static_cast<double>(profile.cycles));
  text += count_line("list builds", static_cast<double>(profile.list_builds));
  const auto pair_line = [&](const char* name, std::int64_t count) {
    if (count > 0) text += count_line(name, a_cycle(count, profile));
  };
  pair_line("listed pairs a cycle", profile.listed_pairs);
  pair_line("touching pairs a cycle", profile.touching_pairs);
  pair_line("slow pairs a cycle", profile.slow_pairs);
  pair_line("unanswered contacts a cycle", profile.unanswered_contacts);
  return text + count_line("peak memory, MB", 1e-6 * static_cast<double>(peak_memory()));
}

}  // namespace tangency::inline v0::dem
