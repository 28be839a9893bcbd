// SPDX-License-Identifier: GPL-3.0-or-later
// `tangency-verify show` and `inputs`: one row as a user needs it, and what a tool reads.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numbers>
#include <regex>
#include <string>
#include <tuple>
#include <vector>

#include <tangency/tests/grade/report.hpp>

namespace tangency::testing {
namespace {

std::string shown(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "show");
  const Finished run = run_tool(arguments);
  EXPECT_EQ(run.status, 0) << run.err;
  return run.out;
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != text.npos;
}

TEST(ShowCommand, ARowHasItsPlaceItsNumbersAndItsTruth) {
  const std::string text = shown({"near", "7"});
  EXPECT_TRUE(text.starts_with("near row 7: family gap 1e-03, near.csv:12\n")) << text;
  EXPECT_TRUE(holds(text, "  a.r2         1.2296837024125316       0x1.3acc8d1649389p+0\n"));
  EXPECT_TRUE(holds(text, "  gap          9.999999999997726066238177296078307837658e-04\n"));
  for (const char* code : {"csv", "cpp", "c", "python", "lammps"}) {
    EXPECT_TRUE(holds(text, "\n--- " + std::string(code) + '\n')) << code;
  }
  EXPECT_FALSE(holds(text, "answered"));
}

TEST(ShowCommand, SaysWhatIsWrongWithAnAnswerAndHowFarItIsOff) {
  const std::string wrong = shown({"near", "7", "--tool", TANGENCY_SPHERE_TOOL});
  EXPECT_TRUE(holds(wrong, "\nwrong\n  wrong-answer: relation = overlap, true is separate\n"))
      << wrong;
  EXPECT_TRUE(std::regex_search(wrong, std::regex("\nerrors\n  gap = -.*: off by 0\\.[0-9]+ L\n")));
  const std::string right = shown({"near", "7", "--tool", kKernel});
  EXPECT_TRUE(holds(right, "\nanswered\n  relation     separate\n")) << right;
  EXPECT_TRUE(holds(right, "\nnothing of it is wrong\n"));
  const std::string dead = shown({"near", "7", "--tool", "echo no licence >&2; exit 3"});
  EXPECT_TRUE(holds(dead, "the tool ended with status 3; its last words: no licence\n"));
  EXPECT_TRUE(holds(dead, "no answer\nwrong\n  missing-answer: no answer\n")) << dead;
}

TEST(ShowCommand, ReadsAnswersFromAFile) {
  const TemporaryFolder folder;
  const std::string file = folder.write("answers.csv", "row,overlaps\n7,1\n8,0\nx\n7,0\n");
  const std::string text = shown({"near", "7", "--answers", file});
  EXPECT_TRUE(holds(text, "answered\n  overlaps     1\nanswered\n  overlaps     0\n")) << text;
  EXPECT_TRUE(holds(text, "wrong-answer: overlaps = 1, true is 0\n"));
}

TEST(ShowCommand, EveryTrueNormalIsShown) {
  const TemporaryFolder folder;
  folder.write("ties.csv", "a.x\n0\n");
  folder.write("ties.truth.csv",
               "row,family,relation,inner,size,gap,normals,nx,ny,nz,ax,ay,az\n"
               "0,two,overlap,,4,-1,point,1,0,0,,,\n0,two,overlap,,4,-1,point,-1,0,0,,,\n");
  const std::string text = shown({"ties", "0", "--corpora", folder.path("")});
  EXPECT_TRUE(holds(text, "  nx           1\n")) << text;
  EXPECT_TRUE(holds(text, "and\n  nx           -1\n"));
  EXPECT_FALSE(holds(text, "--- cpp"));  // these are no ellipsoids
}

/// Numbers of the attribute in every element that has it.
std::vector<double> numbers(const std::string& svg, const std::string& attribute) {
  std::vector<double> found;
  const std::regex pattern(" " + attribute + "=\"([-+.e0-9]+)\"");
  for (std::sregex_iterator at(svg.begin(), svg.end(), pattern), end; at != end; ++at) {
    found.push_back(std::stod((*at)[1]));
  }
  return found;
}

/// Is the dot at the end of the outline of its body along x, to the right (side 1) or to the left?
/// @param which  of the bodies: 0 or 1
void expect_dot_at_the_end(const std::string& svg, std::size_t which, double side) {
  static const std::regex pattern(
      "rx=\"(\\S+)\" ry=\"(\\S+)\" transform=\"translate\\((\\S+) (\\S+)\\) rotate\\((\\S+)\\)\"");
  std::sregex_iterator at(svg.begin(), svg.end(), pattern);
  ASSERT_NE(at, std::sregex_iterator());
  if (which == 1) ++at;
  ASSERT_NE(at, std::sregex_iterator());
  const auto number = [&](std::size_t k) { return std::stod((*at)[k]); };
  const double angle = number(5) * std::numbers::pi / 180;
  const double u = number(1) * std::cos(angle), v = number(2) * std::sin(angle);
  const double half = std::hypot(u, v);
  const double rise = (number(1) * std::sin(angle) * u - number(2) * std::cos(angle) * v) / half;
  EXPECT_NEAR(numbers(svg, "cx")[which], number(3) + side * half, 1e-5) << svg;
  EXPECT_NEAR(numbers(svg, "cy")[which], number(4) + side * rise, 1e-5) << svg;
}

// Its unit is the longest length of the pair, of which the gap is the distance of the two dots.
// The third pair is oblique, turned by 40 and -100 degrees about z.
TEST(ShowCommand, ThePictureShowsTheTrueGapAlongTheNormal) {
  const TemporaryFolder folder;
  const std::string file = folder.path("pair.svg");
  const auto half = [](double r, double s, double degrees) {  // along x
    const double angle = degrees * std::numbers::pi / 180;
    return std::hypot(r * std::cos(angle), s * std::sin(angle));
  };
  const double oblique = 7 - half(3, 1, 40) - half(2, 1, -100);
  for (const auto& [row, gap, longest] :
       {std::tuple("0", -4.0, 6.0), std::tuple("1", 2.0, 5.0), std::tuple("2", oblique, 7.0)}) {
    folder.write("own.csv",
                 "a.x,a.y,a.z,a.r1,a.r2,a.r3,a.qw,a.qx,a.qy,a.qz,"
                 "b.x,b.y,b.z,b.r1,b.r2,b.r3,b.qw,b.qx,b.qy,b.qz\n"
                 "0,0,0,1,6,1,1,0,0,0,0,3,0,1,1,1,1,0,0,0\n"
                 "0,0,0,2,1,1,1,0,0,0,5,0,0,1,1,1,1,0,0,0\n"
                 "0,0,0,3,1,1,0.9396926207859084,0,0,0.3420201433256687,"
                 "7,2,0,2,1,1,0.6427876096865394,0,0,-0.766044443118978\n");
    folder.write("own.truth.csv",
                 "row,family,relation,inner,size,gap,normals,nx,ny,nz,ax,ay,az\n"
                 "0,f,b_in_a,,10,-4,point,0,1,0,,,\n1,f,separate,,8,2,point,1,0,0,,,\n"
                 "2,f,separate,,12,3,point,1,0,0,,,\n");
    shown({"own", row, "--corpora", folder.path(""), "--svg", file});
    const std::string svg = read_file(file);
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
    EXPECT_FALSE(holds(svg, "nan") || holds(svg, "inf")) << svg;
    const std::vector<double> dots = numbers(svg, "cx");
    ASSERT_EQ(dots.size(), 4U) << svg;
    EXPECT_NEAR(dots[1] - dots[0], gap / longest, 1e-5) << svg;
    expect_dot_at_the_end(svg, 0, 1);
    expect_dot_at_the_end(svg, 1, -1);
    EXPECT_EQ(numbers(svg, "rx").size(), 4U);
  }
}

TEST(ShowCommand, EveryPairOfEllipsoidsAndEllipsesHasAPictureOfFiniteNumbers) {
  const TemporaryFolder folder;
  const std::string file = folder.path("pair.svg");
  for (const char* corpus : {"touching", "extreme", "nested", "symmetric", "ellipses"}) {
    for (int row = 3; row < 350; row += 43) {
      shown({corpus, std::to_string(row), "--as", "csv", "--svg", file});
      const std::string svg = read_file(file);
      EXPECT_TRUE(svg.ends_with("</svg>\n")) << corpus << ' ' << row;
      EXPECT_FALSE(holds(svg, "nan") || holds(svg, "inf")) << corpus << ' ' << row << '\n' << svg;
    }
  }
}

TEST(ShowCommand, TheLammpsBoxHoldsBothBodiesAndShapesAreDiameters) {
  const std::string text = shown({"near", "7", "--as", "lammps"});
  EXPECT_TRUE(holds(text, "\n2 atoms\n2 ellipsoids\n1 atom types\n")) << text;
  EXPECT_TRUE(holds(text, "\n1 2 2.459367404825063 3.496603651563799 0.08099756292576066 "));
  std::smatch box;
  ASSERT_TRUE(std::regex_search(text, box, std::regex("\n(\\S+) (\\S+) xlo xhi\n")));
  EXPECT_LT(std::stod(box[1]), -3.741856581534068 - 2.5294489561026454);
  EXPECT_GT(std::stod(box[2]), -0.9766655287279431 + 1.7483018257818994);
}

TEST(ShowCommand, EveryKindIsShownWithItsAnswerAndSaysWhatItHasNot) {
  for (const auto& [corpus, call, truth] :
       {std::tuple("points", "point", "  gap          2.41"), std::tuple("walls", "wall", "a_in_b"),
        std::tuple("rays", "ray", "  t1 "), std::tuple("times", "time", "  earliest "),
        std::tuple("matrices", "contact", "  m.size ")}) {
    const std::string text =
        shown({corpus, "3", "--tool", TANGENCY_CONTACT " " + std::string(call)});
    EXPECT_TRUE(holds(text, truth)) << text;
    EXPECT_TRUE(holds(text, "\nanswered\n")) << text;
    EXPECT_TRUE(holds(text, "\nnothing of it is wrong\n")) << text;
    EXPECT_TRUE(holds(text, "\nThere is no other code: ")) << text;
    EXPECT_FALSE(holds(text, "--- cpp")) << text;
  }
  EXPECT_TRUE(holds(shown({"float32", "3", "--tool", kKernel}), "--- cpp"));
}

// Both are asked for a pair from either side: 3 is the first body of it, 13 the second.
TEST(ShowCommand, ABodyOfAListHasThePairsThatItIsIn) {
  const std::string tool = TANGENCY_CONTACT " neighbours --periodic 80,16,8";
  for (const char* body : {"3", "13"}) {
    const std::string text = shown({"neighbours-periodic", body, "--tool", tool});
    EXPECT_TRUE(holds(text, "\ntrue\n  i 3 j 13 ix 0 iy 0 iz 0 relation overlap\n")) << text;
    EXPECT_TRUE(holds(text, "\nanswered\n  i 3 j 13 ix 0 iy 0 iz 0\n")) << text;
    EXPECT_TRUE(holds(text, "\nThis is one body of a list; ")) << text;
  }
  const std::string less = shown({"neighbours-periodic", "3", "--tool", "echo i,j,ix,iy,iz"});
  EXPECT_TRUE(holds(less,
                    "\nanswered\n  no pair with this body\nwrong\n"
                    "  missing-answer: no j ix iy iz = 13 0 0 0\n"))
      << less;
}

TEST(ShowCommand, RefusesWhatItCannotShow) {
  const TemporaryFolder folder;
  const auto refusal = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "show");
    const Finished run = run_tool(arguments);
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.out, "");
    return run.err;
  };
  EXPECT_EQ(refusal({"near", "360"}), "near.csv: there is no row 360 here; there are 0 to 359\n");
  EXPECT_TRUE(holds(refusal({"near", "-1"}), "-1 is not a whole number from 0"));
  EXPECT_TRUE(holds(refusal({"nowhere", "1"}), "there is no corpus nowhere here"));
  EXPECT_TRUE(holds(refusal({"near", "1", "--as", "cobol"}), "cobol"));
  EXPECT_TRUE(holds(refusal({"quadrics", "1", "--as", "cpp"}), "has no code but csv"));
  EXPECT_TRUE(holds(refusal({"quadrics", "1", "--svg", folder.path("x.svg")}), "has no picture"));
  EXPECT_TRUE(holds(refusal({"times", "1", "--as", "cpp"}), "has no code but csv"));
  EXPECT_TRUE(holds(refusal({"times", "1", "--svg", folder.path("x.svg")}), "has no picture"));
  EXPECT_TRUE(holds(refusal({"near", "1", "--tool", "true", "--answers", "x"}), "exclude"));
  EXPECT_TRUE(holds(refusal({"near", "1", "--svg", "/none/x.svg"}), "/none/x.svg: "));
  EXPECT_EQ(folder.names(), std::vector<std::string>{});
}

TEST(InputsCommand, AreToTheByteWhatAToolReads) {
  const TemporaryFolder folder;
  for (const char* corpus : {"near", "ellipses", "quadrics"}) {
    const std::string read = folder.path("read.csv");
    grade_tool("cat > " + read, corpus);
    const Finished run = run_tool({"inputs", corpus});
    EXPECT_EQ(run.status, 0);
    EXPECT_FALSE(run.out.empty());
    EXPECT_EQ(run.out, read_file(read)) << corpus;
  }
  EXPECT_EQ(run_tool({"inputs", "nowhere"}).status, 2);
}

}  // namespace
}  // namespace tangency::testing
