// SPDX-License-Identifier: GPL-3.0-or-later
// bench_speed_accuracy as a user runs it, on few pairs.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <tangency/bench/pairs.hpp>
#include <tangency/bench/speed_accuracy/count.hpp>
#include <tangency/bench/speed_accuracy/methods.hpp>
#include <tangency/bench/timing.hpp>
#include <tangency/geometry/tables/csv.hpp>
#include <tangency/tests/tool/process.hpp>

namespace tangency::testing {
namespace {

using TableRow = std::map<std::string, std::string>;  // cell by column

std::vector<TableRow> read_table(const std::string& path) {
  tables::Reader reader(path);
  std::vector<TableRow> rows;
  for_each_row(reader, [&](const tables::RowCursor& row) {
    TableRow cells;
    for (std::size_t c = 0; c < reader.header().size(); ++c) {
      const auto column = static_cast<tables::Column>(c);
      cells[reader.header().name(column)] = std::string(row.text(column));
    }
    rows.push_back(std::move(cells));
  });
  return rows;
}

bool starts_with_any(const std::string& text, const std::vector<std::string>& starts) {
  return std::any_of(starts.begin(), starts.end(),
                     [&](const std::string& start) { return text.starts_with(start); });
}

/// Is a cell of this column promised to a row of this method?
bool is_promised(const std::string& column, const TableRow& row) {
  const std::string& method = row.at("method");
  const bool batch = row.at("level") != "single";
  if (column == "option")
    return method == "signed_gaps" || method == "follow_gaps" || method == "gap_lanes";
  if (column == "steps") return method == "gap_lanes" || method == "start alone";
  if (starts_with_any(column, {"gap_error", "normal_error", "point_error"}))
    return method != "overlaps";
  if (column == "proven_largest")
    return method != "overlaps" &&
           starts_with_any(method, {"signed_gap", "follow_gap", "gap_lanes"});
  if (column == "local_error_largest") return row.at("local") != "0";
  if (column.starts_with("left")) return method == "signed_gaps" || method == "follow_gaps";
  if (column == "instructions") return !batch;  // and at the levels that valgrind knows
  return true;
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;  // such a program does not run under valgrind
#else
constexpr bool kSanitized = false;
#endif

bool counts() {
  return !kSanitized && speed_accuracy::can_count() && access("/usr/bin/valgrind", X_OK) == 0;
}

TEST(SpeedAccuracyRun, AQuickRunFillsEveryColumnWhereItIsPromised) {
  const TemporaryFolder folder;
  const std::string csv = folder.path("all.csv"), json = folder.path("all.json"),
                    ahead = folder.path("ahead.csv"), picture = folder.path("all.svg");
  std::vector<std::string> arguments = {"--quick", "--families", "class2",    "any overlap",
                                        "--csv",   csv,          "--json",    json,
                                        "--ahead", ahead,        "--picture", picture};
  if (counts()) arguments.push_back("--count");
  const Finished run = run_tool(arguments);
  ASSERT_EQ(run.status, 0) << run.err;

  const std::vector<TableRow> rows = read_table(csv);
  const std::size_t levels = bench::best_levels().size();
  EXPECT_EQ(rows.size(), 2 * (12 + 25 * levels));
  for (const TableRow& row : rows) {
    for (const auto& [column, cell] : row) {
      if (column == "instructions" && !counts()) continue;
      if (is_promised(column, row)) {
        EXPECT_NE(cell, "") << column << " of " << row.at("method") << ' ' << row.at("option");
      }
    }
    if (!row.at("left").empty()) {
      EXPECT_LE(std::stoul(row.at("left_deep")), std::stoul(row.at("left")));
    }
    EXPECT_GT(std::stod(row.at("ns")), 0);
    EXPECT_EQ(row.at("pairs"), "40");
    if (row.at("definition") == "common normal" && row.at("method") != "start alone") {
      EXPECT_EQ(row.at("wrong"), "0");
    }
  }

  const auto objects = nlohmann::json::parse(read_file(json));
  ASSERT_EQ(objects.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(objects[i].size(), rows[i].size());
    for (const auto& [column, cell] : rows[i])
      EXPECT_EQ(objects[i].at(column).is_null(), cell.empty()) << column;
    EXPECT_EQ(objects[i].at("ns").get<double>(), std::stod(rows[i].at("ns")));
  }

  const std::vector<TableRow> shares = read_table(ahead);
  EXPECT_EQ(shares.size(), 2 * 7 * (1 + 2 * levels));
  for (const TableRow& row : shares) {
    for (const auto& [column, cell] : row) EXPECT_NE(cell, "") << column;
  }
  EXPECT_NE(read_file(picture).find("</svg>"), std::string::npos);
}

TEST(SpeedAccuracyRun, TheLanesLeaveFewContactsOfSlenderBodies) {
  // Of 1000. At aspect 100 one in seven overlaps deeper than rho.
  const std::map<std::string, std::size_t> most = {{"10", 50}, {"30", 150}, {"100", 200}};
  std::size_t families = 0;
  for (const std::string& family : bench::family_names()) {
    if (!family.starts_with("contacts of ")) continue;
    ++families;
    const auto pairs = bench::drawn_pairs(family, 1000);
    const std::string aspect = family.substr(family.rfind(' ') + 1);
    for (const auto& method : speed_accuracy::methods_on(*pairs, bench::best_levels())) {
      if (!method.left || method.option != "standard") continue;
      bench::force_level(method.level);
      EXPECT_LE(method.left().size(), most.at(aspect)) << family << ' ' << method.name;
      bench::force_level(0);
    }
  }
  EXPECT_EQ(families, 6U);
}

TEST(SpeedAccuracyRun, BadOptionsAreRefusedInOneLine) {
  for (const auto& [option, value] :
       {std::pair("--families", "no such family"), {"--pairs", "0"}, {"--rounds", "x"}}) {
    const Finished run = run_tool({option, value});
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_NE(run.err.find(option), std::string::npos) << run.err;
  }
}

TEST(SpeedAccuracyRun, HelpNamesFamiliesAndColumns) {
  const Finished run = run_tool({"--help"});
  EXPECT_EQ(run.status, 0);
  for (const char* name : {"needles of aspect 1e8", "normal_error_largest", "--count"})
    EXPECT_NE(run.out.find(name), std::string::npos) << name;
}

}  // namespace
}  // namespace tangency::testing
