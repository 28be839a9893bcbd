// SPDX-License-Identifier: GPL-3.0-or-later
/// `tangency contact --view ROW`: the page has the numbers of the table, digit by digit, for each
/// method; it is whole; and a row that is not there, or refused, leaves nothing.
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <tangency/tests/tool/process.hpp>

namespace tangency::testing {
namespace {

/// Apart, a little in each other, one in the other, equal, an exact touch, and a pair whose
/// numbers are beyond the range of a double for some methods.
const std::string kTable =
    "a.x,a.y,a.z,a.r1,a.r2,a.r3,a.qw,a.qx,a.qy,a.qz,b.x,b.y,b.z,b.r1,b.r2,b.r3,b.qw,b.qx,b.qy,b."
    "qz\n"
    "0,0,0,2,0.5,0.5,0.9,0.1,0.3,0.2,4.9,0.4,0.9,1.2,1.2,0.3,0.8,0.4,-0.3,0.1\n"
    "0,0,0,1.3,1.1,1,1,0,0,0,2,0.1,0.1,1.2,1,0.9,0.9,0.2,0.1,0.1\n"
    "0.1,0,0,0.3,0.2,0.2,1,0,0,0,0,0,0,2,1,1.5,1,0,0,0\n"
    "1,2,3,3,2,1,1,0,0,0,1,2,3,3,2,1,1,0,0,0\n"
    "0,0,0,1,1,1,1,0,0,0,3,0,0,2,1,1,1,0,0,0\n"
    "0,0,0,0x1p1000,1,1,1,0,0,0,0x1.8p1001,0,0,0x1p1000,1,1,1,0,0,0\n";
constexpr std::size_t kRows = 6;
const std::vector<std::string> kMethods{"common-normal", "perram-wertheim", "midpoint-potential",
                                        "trace"};

std::vector<std::string> parts_of(const std::string& text, char end) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == end)
      parts.emplace_back();
    else
      parts.back().push_back(c);
  }
  return parts;
}

/// "gap":-0.5 of a method, as it stands in the page's data: without quotes.
std::string value_of(const std::string& page, const std::string& method, const std::string& name) {
  const std::size_t data = page.find("id=\"pair\"");
  std::size_t at = page.find("\"" + method + "\":{", data);
  EXPECT_NE(at, page.npos) << method;
  const std::size_t end = page.find('}', at);
  const std::string mark = "\"" + name + "\":";
  at = page.find(mark, at);
  EXPECT_LT(at, end) << method << " " << name;
  at += mark.size();
  std::string value = page.substr(at, page.find_first_of(",}", at) - at);
  if (value == "null") return "";
  if (value.front() == '"') value = value.substr(1, value.size() - 2);
  return value;
}

TEST(ContactView, HasTheNumbersOfTheTableOfEachMethod) {
  const TemporaryFolder folder;
  const std::string table = folder.write("pairs.csv", kTable);
  std::vector<std::string> pages;
  for (std::size_t row = 0; row < kRows; ++row) {
    const std::string out = folder.path("page.html");
    const Finished view = run_tool({"contact", "--view", std::to_string(row), "--out", out, table});
    EXPECT_EQ(view.out + view.err, "");
    pages.push_back(read_file(out));
  }
  std::size_t compared = 0;
  for (const std::string& method : kMethods) {
    std::vector<std::string> command{"contact", "--method", method};
    if (method == "common-normal")
      command.insert(command.end(), {"--columns", "mu,curvature_min,curvature_max"});
    command.push_back(table);
    const auto lines = parts_of(run_tool(command).out, '\n');
    ASSERT_EQ(lines.size(), kRows + 2) << method;
    const auto names = parts_of(lines[0], ',');
    for (std::size_t row = 0; row < kRows; ++row) {
      const auto cells = parts_of(lines[row + 1], ',');
      for (std::size_t k = 1; k < names.size(); ++k, ++compared)
        EXPECT_EQ(value_of(pages[row], method, names[k]), cells[k])
            << method << " " << names[k] << " of row " << row;
    }
  }
  EXPECT_EQ(compared, kRows * (4 * 14 + 3));
}

TEST(ContactView, ShowsAPersonTheSameNumbers) {
  const TemporaryFolder folder;
  const std::string table = folder.write("pairs.csv", kTable);
  const std::string out = folder.path("page.html");
  ASSERT_EQ(run_tool({"contact", "--view", "1", "--out", out, table}).status, 0);
  const std::string page = read_file(out);
  for (const std::string& method : kMethods) {
    const std::string gap = value_of(page, method, "gap");
    EXPECT_FALSE(gap.empty()) << method;
    const std::size_t row = page.find("<tr data-method=\"" + method + "\">");
    ASSERT_NE(row, page.npos);
    EXPECT_LT(page.find("title=\"" + gap + "\"", row), page.find("</tr>", row)) << method;
  }
  EXPECT_NE(page.find("<code id=\"relation\">overlap</code>"), page.npos);
  EXPECT_EQ(page.find("http"), page.npos) << "needs no network";
  EXPECT_EQ(page.find(" src="), page.npos) << "and no other file";
}

TEST(ContactView, TakesBodiesInAnyFormAndReadsNoRowBehindItsOwn) {
  const TemporaryFolder folder;
  const std::string table = folder.write(
      "pairs.csv",
      "a.x,a.y,a.z,a.m.xx,a.m.yy,a.m.zz,a.m.xy,a.m.yz,a.m.zx,b.x,b.y,b.z,b.r1,b.r2,b.r3\n"
      "0,0,0,4,1,1,0,0,0,5,0,0,2,1,1\n"
      "0,0,0,-4,1,1,0,0,0,5,0,0,2,1,1\n");
  const std::string out = folder.path("page.html");
  ASSERT_EQ(run_tool({"contact", "--view", "0", "--out", out, table}).status, 0);
  EXPECT_EQ(value_of(read_file(out), "common-normal", "gap"), "1");
}

TEST(ContactView, OfARowThatIsNotThereOrRefusedSaysSoAndLeavesNothing) {
  const TemporaryFolder folder;
  const std::string table = folder.write("pairs.csv", kTable);
  const std::string empty = folder.write("empty.csv", parts_of(kTable, '\n')[0] + "\n");
  const std::string bad = folder.write("bad.csv",
                                       "a.x,a.y,a.z,a.r1,a.r2,a.r3,b.x,b.y,b.z,b.r1,b.r2,b.r3\n"
                                       "0,0,0,1,-1,1,3,0,0,1,1,1\n");
  const std::string out = folder.path("page.html");
  const auto refused = [&](const std::vector<std::string>& further) {
    std::vector<std::string> command{"contact", "--out", out};
    command.insert(command.end(), further.begin(), further.end());
    const Finished view = run_tool(command);
    EXPECT_EQ(view.status, 2);
    EXPECT_EQ(view.out, "");
    EXPECT_FALSE(std::filesystem::exists(out));
    return view.err;
  };
  EXPECT_EQ(refused({"--view", "6", table}),
            table + ": --view = 6: a row of the table, from 0 to 5\n");
  EXPECT_EQ(refused({"--view", "0", empty}), empty + ": --view = 0: the table has no row\n");
  EXPECT_EQ(refused({"--view", "0", bad}),
            bad + ":2: a.r2 = -1: a semi-axis must be finite and > 0\n");
  for (const auto& [option, value] :
       std::vector<std::pair<std::string, std::string>>{{"--method", "trace"}, {"--columns", "mu"}})
    EXPECT_NE(refused({"--view", "0", option, value, table}).find("--view"), std::string::npos);
  EXPECT_NE(refused({"--view", "0", "--keep-going", table}).find("--view"), std::string::npos);
  EXPECT_NE(refused({"--view", "-1", table}).find("--view"), std::string::npos);
}

}  // namespace
}  // namespace tangency::testing
