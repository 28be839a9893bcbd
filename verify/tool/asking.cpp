// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/tool/asking.hpp>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <tangency/geometry/tables/csv.hpp>

namespace tangency::inline v0::verify {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& file, const std::string& rule) {
  throw tables::Error({.file = file, .rule = rule});
}

constexpr std::array<std::pair<std::string_view, Definition>, 4> kDefinitions{
    {{"common-normal", Definition::common_normal},
     {"perram-wertheim", Definition::perram_wertheim},
     {"midpoint-potential", Definition::midpoint_potential},
     {"centre-line", Definition::centre_line}}};

std::vector<std::string> definition_names() {
  std::vector<std::string> names;
  for (const auto& [name, definition] : kDefinitions) names.emplace_back(name);
  return names;
}

}  // namespace

Definition definition_named(std::string_view name) {
  return std::ranges::find(kDefinitions, name, &std::pair<std::string_view, Definition>::first)
      ->second;
}

void add_corpora_option(tables::Command& command, std::string& folder) {
  command
      .option("--corpora", folder,
              "Folder of NAME.csv and NAME.truth.csv (default: those in this program)")
      .not_empty()
      .type_name("DIR");
}

CorpusSource corpus_source(const std::string& folder) {
  return folder.empty() ? CorpusSource() : CorpusSource(folder);
}

void add_definition_option(tables::Command& command, std::string& name) {
  command
      .option(
          "--definition", name,
          "What gap and normal mean (default: common-normal); centre-line: how far B moves along "
          "the line of centres until both touch, and normals are not graded")
      .one_of(definition_names());
}

void require_readable(const std::string& path) {
  if (path == "-") return;
  std::error_code none;
  const int problem = ::access(path.c_str(), R_OK) != 0           ? errno
                      : std::filesystem::is_directory(path, none) ? EISDIR
                                                                  : 0;
  if (problem != 0) refuse(path, "cannot be read: " + std::generic_category().message(problem));
}

InputLines input_lines(const CorpusTable& inputs, std::size_t rows) {
  InputLines found{inputs.file, {}};
  tables::Reader reader(inputs.named());
  tables::for_each_row(reader,
                       [&](const tables::RowCursor& row) { found.lines.push_back(row.line()); });
  if (found.lines.size() != rows) {
    refuse(inputs.file, std::to_string(found.lines.size()) + " rows: the truth beside it is of " +
                            std::to_string(rows));
  }
  return found;
}

ToolRun asked(const std::string& command, const CorpusTable& inputs, std::size_t rows,
              double seconds) {
  // Chosen: ten times the longest answer `tangency contact` can give, and a screen of messages.
  const std::size_t most_bytes = (std::size_t{1} << 16) + 4096 * rows;
  return run_tool(command, inputs.text, {seconds, most_bytes});
}

}  // namespace tangency::inline v0::verify
