// SPDX-License-Identifier: GPL-3.0-or-later
/// `tangency contact` from outside: columns, refusals, statuses, help.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ostream>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/other_gaps.hpp>
#include <tangency/geometry/trace_contact.hpp>
#include <tangency/tests/tool/help_examples.hpp>
#include <tangency/tests/tool/process.hpp>

namespace tangency::testing {
namespace {

using Names = std::vector<std::string>;

const std::string kNoTurnHeader = "a.x,a.y,a.z,a.r1,a.r2,a.r3,b.x,b.y,b.z,b.r1,b.r2,b.r3\n";
const std::string kHeader =
    "a.x,a.y,a.z,a.r1,a.r2,a.r3,a.qw,a.qx,a.qy,a.qz,b.x,b.y,b.z,b.r1,b.r2,b.r3,b.qw,b.qx,b.qy,b."
    "qz\n";
const std::string kOutHeader =
    "row,relation,gap,nx,ny,nz,pa.x,pa.y,pa.z,pb.x,pb.y,pb.z,gap_error,status,inner\n";
const std::string kPair = "0,0,0,1,1,1,3.5,0,0,2,1,1\n";  // of kNoTurnHeader
const std::string kInvalidCells = ",,,,,,,,,,,,,invalid,\n";

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',') {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// What the tool says about kPair: 0.5 apart, with the last digits of this machine's batch.
std::string answer_of_the_pair() {
  const Ellipsoid a({0, 0, 0}, {1, 1, 1}), b({3.5, 0, 0}, {2, 1, 1});
  Gap gap;
  signed_gaps({&a, 1}, {&b, 1}, {&gap, 1}, Accuracy::certified());
  EXPECT_LE(std::abs(gap.gap - 0.5), gap.gap_error);
  const Vec3 vectors[] = {gap.normal, a.centre() + gap.arm_a, b.centre() + gap.arm_b};
  std::string answer = kOutHeader + "0,separate";
  const auto add = [&](double number) {
    std::array<char, 32> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    answer += "," + std::string(digits.data(), end);
  };
  add(gap.gap);
  for (const Vec3& vector : vectors) {
    for (const double component : vector) add(component);
  }
  add(gap.gap_error);
  return answer + ",ok,\n";
}

TEST(ContactCommand, AnswersWithTheDocumentedColumns) {
  const TemporaryFolder folder;
  const std::string pairs = folder.write("pairs.csv", kNoTurnHeader + kPair);
  const Finished run = run_tool({"contact", pairs});
  EXPECT_EQ(run.out, answer_of_the_pair());
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(run.status, 0);
}

TEST(ContactCommand, HeaderAloneIsAnEmptyTable) {
  const Finished run = run_tool({"contact"}, kHeader);
  EXPECT_EQ(run.out, kOutHeader);
  EXPECT_EQ(run.status, 0);
}

TEST(ContactCommand, ReadsStandardInputForADashAndForNoFile) {
  const std::string pairs = kNoTurnHeader + kPair;
  const std::string answers = answer_of_the_pair();
  for (const auto& arguments : {Names{"contact"}, Names{"contact", "-"}}) {
    EXPECT_EQ(run_tool(arguments, pairs).out, answers);
    const Finished refused = run_tool(arguments, pairs + "1\n");
    EXPECT_EQ(refused.err,
              "<stdin>:3: 1 cell: a row must have as many cells as the header has columns, 12\n");
    EXPECT_EQ(refused.status, 2);
  }
}

TEST(ContactCommand, SpellingOfTheTableDoesNotMatter) {
  const std::string plain = kHeader + "0,0,0,1,2,3,1,0,0,0,4,0.5,0,2,1,1,0.5,0.5,0.5,0.5\n" +
                            "0,0,0,1,2,3,0,1,0,0,5,0.5,0,2,1,1,1,2,3,4\n";
  const std::string answers = run_tool({"contact"}, plain).out;
  ASSERT_EQ(lines_of(answers).size(), 3U);
  const std::string spelled =
      "\xEF\xBB\xBF# two pairs\r\n"
      "b.qw , b.qx,b.qy,b.qz,note,b.r1,b.r2,b.r3,b.x,b.y,b.z,"
      "a.qw,a.qx,a.qy,a.qz,a.r1,a.r2,a.r3,a.x,a.y,a.z\r\n"
      "\r\n"
      "0x1p-1, 0x.8p0,0.5,5e-1,,2,1,1,4,0x1p-1,0,1,0,0,0,1,2,3,0,0,0\r\n"
      "# between\r\n"
      "0x1p0,0x2,0x3p0,0x1p+2,inf,+2,1.0,1,0x5p0,5E-1,-0,0,1,0,0,0x1p0,\t2 ,3,0,0,0";
  EXPECT_EQ(run_tool({"contact"}, spelled).out, answers);
}

TEST(ContactCommand, MissingOrientationIsTheIdentity) {
  const std::string answers =
      run_tool({"contact"}, kHeader + "0,0,0,1,2,3,1,0,0,0,4,5,6,3,2,1,1,2,3,4\n").out;
  EXPECT_EQ(run_tool({"contact"},
                     "a.x,a.y,a.z,a.r1,a.r2,a.r3,b.x,b.y,b.z,b.r1,b.r2,b.r3,b.qw,b.qx,"
                     "b.qy,b.qz\n0,0,0,1,2,3,4,5,6,3,2,1,1,2,3,4\n")
                .out,
            answers);
}

/// The next double of a line of answers.
double number(const std::string& cell) { return std::strtod(cell.c_str(), nullptr); }

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

TEST(ContactCommand, NumbersAreThoseOfTheLibrarysBatchBitForBit) {
  std::mt19937_64 source(7);
  std::uniform_real_distribution<double> place(-3, 3);
  std::uniform_real_distribution<double> axis(0.3, 2);
  std::string text = kHeader;
  std::vector<Ellipsoid> bodies_a, bodies_b;
  for (int i = 0; i < 300; ++i) {
    std::array<double, 20> v{};
    for (std::size_t k = 0; k < v.size(); ++k)
      v[k] = k % 10 >= 3 && k % 10 < 6 ? axis(source) : place(source);
    std::array<char, 40> cell;
    for (std::size_t k = 0; k < v.size(); ++k) {
      std::snprintf(cell.data(), cell.size(), k % 2 == 0 ? "%.17g" : "%a", v[k]);
      text += cell.data() + std::string(k + 1 < v.size() ? "," : "\n");
    }
    bodies_a.emplace_back(Vec3(v[0], v[1], v[2]), Vec3(v[3], v[4], v[5]),
                          Eigen::Quaterniond(v[6], v[7], v[8], v[9]));
    bodies_b.emplace_back(Vec3(v[10], v[11], v[12]), Vec3(v[13], v[14], v[15]),
                          Eigen::Quaterniond(v[16], v[17], v[18], v[19]));
  }
  std::vector<Gap> gaps(bodies_a.size());
  signed_gaps(bodies_a, bodies_b, gaps, Accuracy::certified());
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    points.push_back(bodies_a[i].centre() + gaps[i].arm_a);
    points.push_back(bodies_b[i].centre() + gaps[i].arm_b);
  }
  const std::vector<std::string> lines = lines_of(run_tool({"contact"}, text).out);
  ASSERT_EQ(lines.size(), gaps.size() + 1);
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const std::vector<std::string> cells = cells_of(lines[i + 1]);
    ASSERT_EQ(cells.size(), 15U) << lines[i + 1];
    EXPECT_EQ(cells[0], std::to_string(i));
    EXPECT_EQ(cells[13], gaps[i].status == GapStatus::ok ? "ok" : "local");
    EXPECT_EQ(bits(number(cells[2])), bits(gaps[i].gap));
    EXPECT_EQ(bits(number(cells[12])), bits(gaps[i].gap_error));
    for (int k = 0; k < 3; ++k) {
      const auto column = static_cast<std::size_t>(k);
      EXPECT_EQ(bits(number(cells[3 + column])), bits(gaps[i].normal[k]));
      EXPECT_EQ(bits(number(cells[6 + column])), bits(points[2 * i][k]));
      EXPECT_EQ(bits(number(cells[9 + column])), bits(points[2 * i + 1][k]));
    }
  }
}

struct BadRow {
  std::string name;
  std::string row;
  std::string message;  // after "pairs.csv:4: "
};

void PrintTo(const BadRow& bad, std::ostream* out) { *out << bad.name; }

const std::string kGoodRow = "0,0,0,1,2,3,1,0,0,0,9,0,0,3,2,1,1,2,3,4\n";

class BadRows : public ::testing::TestWithParam<BadRow> {};

TEST_P(BadRows, EndTheRunWithOneLineAndLeaveTheOutputFile) {
  const TemporaryFolder folder;
  folder.write("pairs.csv", kHeader + kGoodRow + "#\n" + GetParam().row + "\n" + kGoodRow);
  folder.write("answers.csv", "old");
  const Process::Place here{.folder = folder.path("")};
  const std::string message = "pairs.csv:4: " + GetParam().message + "\n";

  const Finished to_output = run_tool({"contact", "pairs.csv"}, "", here);
  EXPECT_EQ(to_output.status, 2);
  EXPECT_EQ(to_output.err, message);
  EXPECT_EQ(lines_of(to_output.out).size(), 2U);
  EXPECT_EQ(to_output.out.back(), '\n');

  for (const char* place : {"answers.csv", "new.csv"}) {
    const Finished to_file = run_tool({"contact", "--out", place, "pairs.csv"}, "", here);
    EXPECT_EQ(to_file.status, 2);
    EXPECT_EQ(to_file.out, "");
    EXPECT_EQ(to_file.err, message);
  }
  EXPECT_EQ(folder.names(), (Names{"answers.csv", "pairs.csv"}));
  EXPECT_EQ(read_file(folder.path("answers.csv")), "old");
}

TEST_P(BadRows, AreInvalidWhenToldToKeepGoing) {
  const TemporaryFolder folder;
  folder.write("pairs.csv", kHeader + kGoodRow + "#\n" + GetParam().row + "\n" + kGoodRow);
  const Finished run =
      run_tool({"contact", "--keep-going", "pairs.csv"}, "", {.folder = folder.path("")});
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.err, "pairs.csv:4: " + GetParam().message + "\n");
  const std::string good_answer =
      run_tool({"contact"}, kHeader + kGoodRow).out.substr(kOutHeader.size() + 1);
  EXPECT_EQ(run.out, kOutHeader + "0" + good_answer + "1" + kInvalidCells + "2" + good_answer);
}

const std::string kAxisRule = ": a semi-axis must be finite and > 0";
const std::string kTurnRule = ": an orientation must be finite and not all 0";

INSTANTIATE_TEST_SUITE_P(
    ContactCommand, BadRows,
    ::testing::ValuesIn(std::vector<BadRow>{
        {"NegativeAxis", "0,0,0,1,-1,3,1,0,0,0,9,0,0,3,2,1,1,2,3,4", "a.r2 = -1" + kAxisRule},
        {"ZeroAxis", "0,0,0,1,2,3,1,0,0,0,9,0,0,3,2,0x0p0,1,2,3,4", "b.r3 = 0x0p0" + kAxisRule},
        {"ZeroOrientation", "0,0,0,1,2,3,0,0,-0,0,9,0,0,3,2,1,1,2,3,4", "a.qw = 0" + kTurnRule},
        {"Nan", "0,0,0,1,2,3,1,0,0,0,9,NaN,0,3,2,1,1,2,3,4", "b.y = NaN: a number must be finite"},
        {"Infinity", "0,0,-inf,1,2,3,1,0,0,0,9,0,0,3,2,1,1,2,3,4",
         "a.z = -inf: a number must be finite"},
        {"EmptyCell", "0,0,0,1,2,3,1,0,0,0,9,0,0,3,2,1,1,2,,4",
         "b.qy = (empty): a cell must hold a number, in decimal or as a hex float"},
        {"NoNumber", "0,0,0,1,2,3,1,0,0,0,9,0,0,3,2,1,1,2,3,4m",
         "b.qz = 4m: a cell must hold a number, in decimal or as a hex float"},
        {"OutOfRange", "1e999,0,0,1,2,3,1,0,0,0,9,0,0,3,2,1,1,2,3,4",
         "a.x = 1e999: a number must be 0 or between 4.9e-324 and 1.8e308 in size, the range of a "
         "double"},
        {"ShortRow", "0,0,0,1,2,3,1,0,0,0,9,0,0,3,2,1,1,2,3",
         "19 cells: a row must have as many cells as the header has columns, 20"},
        {"LongRow", "0,0,0,1,2,3,1,0,0,0,9,0,0,3,2,1,1,2,3,4,",
         "21 cells: a row must have as many cells as the header has columns, 20"}}),
    [](const auto& tested) { return tested.param.name; });

TEST(ContactCommand, BadHeaderIsAlwaysRefused) {
  const std::string body_b = "b.x,b.y,b.z,b.r1,b.r2,b.r3";
  const std::vector<std::pair<std::string, std::string>> cases{
      {"a.x,a.y,a.z,a.r1,a.r3," + body_b,
       "<stdin>:1: body a without a.r2: a body given by semi-axes has the columns x, y, z, r1, r2 "
       "and r3\n"},
      {"a.x,a.y,a.z,a.r1,a.r2,a.r3",
       "<stdin>:1: body b without b.x, b.y, b.z, b.r1, b.r2, b.r3: a body given by semi-axes has "
       "the columns x, y, z, r1, r2 and r3\n"},
      {"a.x,a.y,a.z,a.r1,a.r2,a.r3,b.qw,b.qy," + body_b,
       "<stdin>:1: body b without b.qx, b.qz: the columns qw, qx, qy and qz come all "
       "or not at all\n"},
      {"a.x,a.y,a.z,a.r1,a.r2,a.r3,a.y," + body_b,
       "<stdin>:1: a.y: a column must be named only once\n"}};
  for (const auto& [names, message] : cases) {
    for (const auto& arguments : {Names{"contact"}, Names{"contact", "--keep-going"}}) {
      const Finished run = run_tool(arguments, names + "\n");
      EXPECT_EQ(run.err, message);
      EXPECT_EQ(run.out, "");
      EXPECT_EQ(run.status, 2);
    }
  }
}

TEST(ContactCommand, NamesTheFirstTenInvalidRowsAndCountsThemAll) {
  std::string text = kNoTurnHeader;
  for (int i = 0; i < 25; ++i) text += "0,0,0,1,1,1,3,0,0,1,1,0\n";
  const Finished run = run_tool({"contact", "--keep-going"}, text);
  const std::vector<std::string> messages = lines_of(run.err);
  ASSERT_EQ(messages.size(), 11U);
  EXPECT_EQ(messages[9], "<stdin>:11: b.r3 = 0" + kAxisRule);
  EXPECT_EQ(messages[10], "<stdin>: 25 invalid rows, of which the first 10 are named above");
}

TEST(ContactCommand, AnswerBeyondTheRangeOfADoubleIsNotApplicable) {
  const Finished run =
      run_tool({"contact"}, kNoTurnHeader + "-1.7e308,0,0,1,1,1,1.7e308,0,0,1,1,1\n");
  EXPECT_EQ(run.out, kOutHeader + "0,separate,,,,,,,,,,,,not_applicable,\n");
  EXPECT_EQ(run.status, 1);
}

// Once a failed assertion, or `inf` in the table: the gap was in range, its error was not.
TEST(ContactCommand, GapErrorBeyondTheRangeOfADoubleIsNotApplicable) {
  // A disc that no normal in doubles is across, so that its width is left of the error: the gap is
  // 7e307 and every point within the range, the error 4.7e308.
  const std::string a = "0,0,-1e308,1.7e308,1e-306,1.7e308,0,1e-71,0,1";
  const std::string b = "0,0,1.7e308,1,1,1e308,1,1e-159,0,1";
  const Finished run = run_tool({"contact"}, kHeader + a + "," + b + "\n");
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_EQ(run.out, kOutHeader + "0,separate,,,,,,,,,,,,not_applicable,\n");
}

TEST(ContactCommand, RefusesABadCommandLineWithOneLine) {
  const std::string see = " (`tangency contact --help` says what is allowed)\n";
  const std::vector<std::pair<Names, std::string>> cases{
      {{"contact", "--method", "guess"},
       "tangency contact: --method: guess not in "
       "{common-normal,perram-wertheim,midpoint-potential,trace}" +
           see},
      {{"contact", "--threads", "0"},
       "tangency contact: --threads: Value 0 not in range 1 to 1024" + see},
      {{"contact", "--threads", "two"},
       "tangency contact: --threads: Value two not in range 1 to 1024" + see},
      {{"contact", "--out", ""}, "tangency contact: --out: a file name is empty" + see},
      {{"contact", "one", "two"},
       "tangency contact: The following argument was not expected: two" + see},
      {{}, "tangency: A subcommand is required (`tangency --help` says what is allowed)\n"},
      {{"contact", "/nonexistent.csv"},
       "/nonexistent.csv: cannot be read: No such file or directory\n"},
      {{"contact", "/"}, "/: cannot be read: Is a directory\n"}};
  for (const auto& [arguments, message] : cases) {
    const Finished run = run_tool(arguments, kHeader + kGoodRow);
    EXPECT_EQ(run.err, message);
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run.status, 2);
  }
}

TEST(ContactCommand, MethodCanBeNamed) {
  const std::string pairs = kHeader + kGoodRow;
  EXPECT_EQ(run_tool({"contact", "--method", "common-normal"}, pairs).out,
            run_tool({"contact"}, pairs).out);
}

struct OtherMethod {
  std::string name;
  OtherGap (*find)(const Ellipsoid&, const Ellipsoid&) noexcept;
};
const std::array<OtherMethod, 2> kOtherMethods{
    {{"perram-wertheim", perram_wertheim_gap}, {"midpoint-potential", midpoint_potential_gap}}};

TEST(ContactCommand, OtherMethodsGiveTheNumbersOfTheLibraryAndTheirErrors) {
  const Ellipsoid a({0, 0, 0}, {1, 2, 3}), b({3.5, 1, 2}, {3, 2, 1}, {1, 2, 3, 4});
  const std::string text = kHeader + "0,0,0,1,2,3,1,0,0,0,3.5,1,2,3,2,1,1,2,3,4\n";
  const std::vector<std::string> usual = cells_of(lines_of(run_tool({"contact"}, text).out)[1]);
  for (const OtherMethod& method : kOtherMethods) {
    const Finished run = run_tool({"contact", "--method", method.name}, text);
    EXPECT_EQ(run.status, 0);
    const OtherGap expected = method.find(a, b);
    const Vec3 points[] = {expected.normal, a.centre() + expected.arm_a,
                           b.centre() + expected.arm_b};
    const std::vector<std::string> cells = cells_of(lines_of(run.out).at(1));
    ASSERT_EQ(cells.size(), 15U);
    EXPECT_EQ(cells[1], usual[1]);
    EXPECT_EQ(bits(number(cells[2])), bits(expected.gap));
    for (std::size_t k = 0; k < 9; ++k) {
      EXPECT_EQ(bits(number(cells[3 + k])), bits(points[k / 3][static_cast<int>(k % 3)]));
    }
    EXPECT_EQ(bits(number(cells[12])), bits(expected.gap_error));
    EXPECT_EQ(cells[13], "ok");
  }
}

TEST(ContactCommand, OtherMethodsSayNoErrorOfTheGapWhereABodyIsGivenByAMatrix) {
  const std::string header =
      "a.x,a.y,a.z,a.m.xx,a.m.yy,a.m.zz,a.m.xy,a.m.yz,a.m.zx,b.x,b.y,b.z,b.r1,b.r2,b.r3\n";
  for (const OtherMethod& method : kOtherMethods) {
    // The semi-axes of the second are doubles: it is the body by semi-axes.
    const std::string rows = header + "0,0,0,2,1,1,0,0,0,4,0,0,1,1,1\n" +  //
                             "0,0,0,4,1,1,0,0,0,4,0,0,1,1,1\n";
    const std::vector<std::string> lines =
        lines_of(run_tool({"contact", "--method", method.name}, rows).out);
    EXPECT_EQ(cells_of(lines.at(1)).at(12), "");
    EXPECT_NE(cells_of(lines.at(2)).at(12), "");
  }
}

TEST(ContactCommand, OtherMethodsAreNotApplicableToCoincidingCentresButTheRelationIsExact) {
  for (const OtherMethod& method : kOtherMethods) {
    const Finished run = run_tool({"contact", "--method", method.name},
                                  kNoTurnHeader + "0,0,0,1,1,1,0,0,0,2,3,4\n" +  //
                                      "0,0,0,1,1,1,0,0,0,1,1,2\n");
    EXPECT_EQ(run.out, kOutHeader + "0,a_in_b,,,,,,,,,,,,not_applicable,\n" +
                           "1,internal_touch,,,,,,,,,,,,not_applicable,a\n");
    EXPECT_EQ(run.status, 1);
  }
}

TEST(ContactCommand, MidpointPotentialIsNotApplicableWhereItsLineMissesABody) {
  // A far disc across the direction to the other: the normal tilts, and the line with it.
  const std::string far = kNoTurnHeader + "0,0,0,10,10,1,100,0,30,1,1,1\n";
  const Finished run = run_tool({"contact", "--method", "midpoint-potential"}, far);
  EXPECT_EQ(run.out, kOutHeader + "0,separate,,,,,,,,,,,,not_applicable,\n");
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run_tool({"contact", "--method", "perram-wertheim"}, far).status, 0);
}

TEST(ContactCommand, TraceGivesTheNumbersOfTheLibraryAndNoErrorOfTheGap) {
  const Ellipsoid a({0, 0, 0}, {1, 2, 3}), b({2, 0.5, 1}, {3, 2, 1}, {1, 2, 3, 4});
  const std::string text = kHeader + "0,0,0,1,2,3,1,0,0,0,2,0.5,1,3,2,1,1,2,3,4\n";
  const Finished run = run_tool({"contact", "--method", "trace"}, text);
  EXPECT_EQ(run.status, 0);
  const TraceContact expected = trace_contact(a, b);
  ASSERT_EQ(expected.status, TraceStatus::ok);
  const Vec3 points[] = {expected.normal, expected.arm_a, b.centre() + expected.arm_b};
  const std::vector<std::string> cells = cells_of(lines_of(run.out).at(1));
  ASSERT_EQ(cells.size(), 15U);
  EXPECT_EQ(cells[1], "overlap");
  EXPECT_EQ(bits(number(cells[2])), bits(expected.gap));
  for (std::size_t k = 0; k < 9; ++k) {
    EXPECT_EQ(bits(number(cells[3 + k])), bits(points[k / 3][static_cast<int>(k % 3)]));
  }
  EXPECT_EQ(cells[12], "");
  EXPECT_EQ(cells[13], "ok");
}

TEST(ContactCommand, TraceIsNotApplicableUnlessTheRelationIsOverlap) {
  // Apart, touching, touching from within, nested, equal, and crossed about one centre.
  const Finished run = run_tool({"contact", "--method", "trace"}, kNoTurnHeader +
                                                                      "0,0,0,1,1,1,3,0,0,1,1,1\n"
                                                                      "0,0,0,1,1,1,2,0,0,1,1,1\n"
                                                                      "0,0,0,1,1,1,0,0,0,1,1,2\n"
                                                                      "0,0,0,1,1,1,0,0,0,2,3,4\n"
                                                                      "0,0,0,1,1,1,0,0,0,1,1,1\n"
                                                                      "0,0,0,1,1,3,0,0,0,3,1,1\n");
  const std::string empty = ",,,,,,,,,,,,not_applicable,";
  EXPECT_EQ(run.out, kOutHeader + "0,separate" + empty + "\n1,external_touch" + empty +
                         "\n2,internal_touch" + empty + "a\n3,a_in_b" + empty + "\n4,equal" +
                         empty + "\n5,overlap" + empty + "\n");
  EXPECT_EQ(run.status, 1);
}

TEST(ContactCommand, HelpSaysWhatTheFilesMeanAndWhatIsEmpty) {
  const Finished run = run_tool({"contact", "--help"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  std::vector<std::string> wanted{"a.qw a.qx a.qy a.qz",
                                  "relation         separate, external_touch, overlap",
                                  "gap_error        proven",
                                  "perram-wertheim  at the best s",
                                  "midpoint-potential\n",
                                  "inner            a or b, the body inside",
                                  "trace            the published scheme",
                                  "Exit status: 0 ",
                                  "--keep-going",
                                  "--threads",
                                  "--out"};
  for (const std::string& column : cells_of(kOutHeader.substr(0, kOutHeader.size() - 1))) {
    wanted.push_back(column.substr(0, column.find('.')));
  }
  for (const char* status :
       {"ok  ", "local  ", "not_applicable  ", "not_converged  ", "invalid  "}) {
    wanted.push_back(status);
  }
  for (const std::string& text : wanted) {
    EXPECT_NE(run.out.find(text), std::string::npos) << text;
  }
}

TEST(ContactCommand, HelpExamplesAreTrue) { expect_help_examples("contact"); }

TEST(Program, TellsItsVersion) {
  const Finished run = run_tool({"--version"});
  EXPECT_EQ(run.out, "tangency " TANGENCY_VERSION "\n");
  EXPECT_EQ(run.status, 0);
}

}  // namespace
}  // namespace tangency::testing
