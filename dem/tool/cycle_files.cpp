// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/cycle_files.hpp>

#include <algorithm>
#include <charconv>
#include <string>
#include <system_error>
#include <vector>

#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/whole_file.hpp>

namespace tangency::inline v0::dem {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (entry.is_regular_file(none)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::optional<std::int64_t> cycle_of_contact_table(const fs::path& file) {
  if (file.extension() != ".csv") return std::nullopt;
  const std::string name = file.stem().string();
  std::int64_t cycle = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), cycle);
  if (error != std::errc() || end != name.data() + name.size() || cycle < 0) return std::nullopt;
  return cycle;
}

std::optional<std::int64_t> cycle_of_kept_state(const fs::path& file) {
  return file.extension() == ".state" ? cycle_of_state(file) : std::nullopt;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw WriteError(folder, error.value());
}

std::optional<fs::path> first_file(const fs::path& folder, CycleOf& cycle_of) {
  for (const fs::path& file : files_in(folder))
    if (cycle_of(file)) return file;
  return std::nullopt;
}

void remove_later_files(const fs::path& folder, std::int64_t last_cycle, CycleOf& cycle_of) {
  for (const fs::path& file : files_in(folder)) {
    const auto cycle = cycle_of(file);
    if (cycle && *cycle > last_cycle) fs::remove(file);
  }
  std::error_code error;  // it may not be there, or hold other files
  if (fs::is_directory(folder, error) && fs::is_empty(folder, error)) fs::remove(folder, error);
}

}  // namespace tangency::inline v0::dem
