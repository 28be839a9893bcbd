// SPDX-License-Identifier: GPL-3.0-or-later
// `tangency-verify grade` on tools that are good, bad, and worse: each is reported for what it is.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

#include <tangency/geometry/tables/descriptor.hpp>
#include <tangency/tests/grade/report.hpp>
#include <tangency/verify/answers/tool_run.hpp>

namespace tangency::testing {
namespace {

TEST(GradeCommand, TheKernelPasses) {
  const Report report =
      grade_tool(kKernel, "near", {"--max-wrong", "0", "--max-gap-error", "1e-15"});
  EXPECT_EQ(report.run.status, 0) << report.run.out;
  EXPECT_EQ(report.run.err, "");
  EXPECT_EQ(report.value("near/all/pairs"), 360);
  EXPECT_EQ(report.value("near/all/broken bounds"), 0);
  EXPECT_LT(report.value("near/all/gap error, largest"), 1e-15);
  EXPECT_GT(report.value("near/all/gap error, largest"), 0);
}

/// The last line of standard output.
std::string last_line(const Report& report) {
  const std::string& out = report.run.out;
  const std::size_t end = out.rfind('\n', out.size() - 2);
  return out.substr(end == out.npos ? 0 : end + 1);
}

// Nothing else is wrong with this tool: no threshold was passed, and no answer is missing.
TEST(GradeCommand, AWrongRelationFailsByDefaultAndTheLastLineIsTheVerdict) {
  const std::string one_wrong = changed(
      "NR == 1 { print $1, $2; next } NR == 9 { $2 = \"separate\" == $2 ? \"overlap\" : "
      "\"separate\" } "
      "{ print $1, $2 }");
  const Report one = grade_tool(one_wrong, "near");
  EXPECT_EQ(one.run.status, 1);
  EXPECT_TRUE(one.says("FAILED 1 wrong answers are more than 0; the first: near row 7 ("))
      << one.run.out;
  EXPECT_EQ(last_line(one),
            "FAILED: 360 rows in 1 corpus: 1 wrong, 0 missing, 0 faulty lines or cells\n");
  const Report allowed = grade_tool(one_wrong, "near", {"--max-wrong", "1"});
  EXPECT_EQ(allowed.run.status, 0) << allowed.run.out;
  EXPECT_EQ(last_line(allowed),
            "passed: 360 rows in 1 corpus: 1 wrong (1 allowed), 0 missing, 0 faulty lines or "
            "cells\n");
}

TEST(GradeCommand, TheVerdictHasTheTotalsOverTheCorpora) {
  const Report right = grade({"--tool", kKernel, "--corpus", "near", "deep"});
  EXPECT_EQ(right.run.status, 0);
  EXPECT_EQ(last_line(right).find("passed: 720 rows in 2 corpora: 0 wrong, 0 missing, 0 bounds "
                                  "broken, 0 normals reversed, 0 faulty lines or cells, largest "
                                  "gap error / L "),
            0U)
      << last_line(right);
  const Report wrong = grade({"--tool", TANGENCY_SPHERE_TOOL, "--corpus", "near", "deep"});
  EXPECT_EQ(wrong.run.status, 1);
  const double sum =
      wrong.value("near/all/wrong relations") + wrong.value("deep/all/wrong relations");
  EXPECT_EQ(last_line(wrong).find("FAILED: 720 rows in 2 corpora: " +
                                  std::to_string(static_cast<int>(sum)) + " wrong, 0 missing, "),
            0U)
      << last_line(wrong);
  // What is not answered is not asked for by default, and said.
  const Report gaps = grade_tool(changed("{ print $1, $3 }"), "near");
  EXPECT_EQ(gaps.run.status, 0);
  EXPECT_EQ(last_line(gaps).find("passed: 360 rows in 1 corpus: relations not answered, 0 missing"),
            0U)
      << last_line(gaps);
}

TEST(GradeCommand, BoundingSpheresAreWrongAndFarOff) {
  const Report report = grade_tool(TANGENCY_SPHERE_TOOL, "classes");
  EXPECT_EQ(report.run.status, 1);
  EXPECT_TRUE(report.says("wrong answers are more than 0; the first: classes row"));
  EXPECT_EQ(report.value("classes/all/missing answers"), 0);
  EXPECT_GT(report.value("classes/all/wrong relations"), 100);
  EXPECT_GT(report.value("classes/all/gap error, largest"), 0.01);
  const Report on_spheres = grade_tool(TANGENCY_SPHERE_TOOL, "symmetric");
  EXPECT_LT(on_spheres.value("symmetric/spheres/gap error, largest"), 1e-15);
}

TEST(GradeCommand, AToleranceOfAMillionthShowsBelowIt) {
  const Report report =
      grade_tool(changed("NR > 1 && $3 * $3 < 1e-12 { $2 = \"external_touch\"; $3 = 0 } { print }"),
                 "near", {"--max-wrong", "0"});
  EXPECT_EQ(report.run.status, 1);
  EXPECT_EQ(report.value("near/gap 1e-03/wrong relations"), 0);
  EXPECT_EQ(report.value("near/gap 1e-05/wrong relations"), 0);
  EXPECT_EQ(report.value("near/gap 1e-08/wrong relations"), 24);
  EXPECT_EQ(report.value("near/gap 1e-17/wrong relations"), 24);
  EXPECT_EQ(report.value("near/gap 1e-03/gap error, largest") < 1e-15, true);
  EXPECT_GT(report.value("near/gap 1e-08/gap error, largest"), 1e-11);
  EXPECT_GT(report.value("near/all/broken bounds"), 200);  // it kept the kernel's gap_error
}

TEST(GradeCommand, AnExchangedNormalIsReversedAndTwoOff) {
  const std::string tool = changed("NR > 1 { $4 = -$4; $5 = -$5; $6 = -$6 } { print }");
  const Report report = grade_tool(tool, "classes", {"--max-normal-error", "1e-5"});
  EXPECT_EQ(report.run.status, 1);
  EXPECT_EQ(report.value("classes/all/reversed normals"), 450);
  EXPECT_TRUE(
      report.says("FAILED classes: 450 normals that point away from every true one, the "
                  "first in row 0 ("))
      << report.run.out;
  EXPECT_NEAR(report.value("classes/all/normal error, median"), 2, 1e-4);
  EXPECT_LT(report.value("classes/all/gap error, largest"), 1e-15);
  EXPECT_TRUE(report.says("FAILED classes: normal error 2 in row "));
}

TEST(GradeCommand, OneReversedNormalFailsWithoutAThreshold) {
  const std::string turned = "NR == 9 { $4 = -$4; $5 = -$5; $6 = -$6 } ";
  const Report report = grade_tool(changed(turned + "{ print }"), "near");
  EXPECT_EQ(report.run.status, 1);
  EXPECT_TRUE(
      report.says("near: 1 normals that point away from every true one, the first in row 7"));
  EXPECT_EQ(report.value("near/gap 1e-03/reversed normals"), 1);
  EXPECT_EQ(report.value("near/all/reversed normals"), 1);
  EXPECT_EQ(grade_tool(kKernel, "near").value("near/all/reversed normals"), 0);
}

// At once or after long: it stands still until it is killed.
TEST(GradeCommand, AHangingToolIsKilledAndEveryCorpusGraded) {
  const TemporaryFolder folder;
  const Report report = grade({"--tool", "cat " + make_pipe(folder.path("never")), "--corpus",
                               "near", "--corpus", "deep", "--time-limit", "0.01"});
  EXPECT_EQ(report.run.status, 1);
  EXPECT_TRUE(report.says("near: the tool had not ended after 0.01 s"));
  EXPECT_TRUE(
      report.says("FAILED the tool had not ended after 0.01 s without an answer, in near, deep\n"));
  EXPECT_EQ(report.value("near/all/missing answers"), 360);
  EXPECT_EQ(report.value("deep/all/missing answers"), 360);
}

// Its time is up once it says so itself, which it does after its answers.
TEST(ToolRun, KeepsWhatWasPrintedBeforeTheTimeWasUp) {
  const TemporaryFolder folder;
  const std::string up = make_pipe(folder.path("up")), never = make_pipe(folder.path("never"));
  const tables::Descriptor deadline(::open(up.c_str(), O_RDWR | O_CLOEXEC));
  const verify::ToolRun run = verify::run_tool(
      "printf 'row,overlaps\\n3,1\\n'; echo slow >&2; echo > " + up + "; cat " + never, "x\n1\n",
      {7, 1000, deadline.get()});
  EXPECT_FALSE(run.sound);
  EXPECT_EQ(run.ending, "had not ended after 7 s");
  EXPECT_EQ(run.last_words, "slow");
  EXPECT_EQ(run.output, "row,overlaps\n3,1\n");
}

TEST(GradeCommand, ADyingToolIsNamedAndItsAnswersAreGraded) {
  const Report report = grade_tool(kKernel + " | head -n 21; echo out of luck >&2; kill -SEGV $$",
                                   "near", {"--max-wrong", "0"});
  EXPECT_EQ(report.run.status, 1);
  EXPECT_TRUE(report.says("was ended by signal 11")) << report.run.out;
  EXPECT_TRUE(report.says("its last words: out of luck"));
  EXPECT_EQ(report.value("near/all/missing answers"), 340);
  EXPECT_EQ(report.value("near/gap 1e-03/missing answers"), 4);
  EXPECT_TRUE(report.says("missing answers, the first is row 20"));
  EXPECT_EQ(grade_tool("no-such-tool-anywhere", "near").value("near/all/missing answers"), 360);
}

TEST(GradeCommand, RubbishWithoutEndIsCutOff) {
  const Report report = grade_tool("yes '%^&*'", "near");
  EXPECT_EQ(report.run.status, 1);
  EXPECT_TRUE(report.says("near: the tool printed more than 1540096 bytes"));
  EXPECT_EQ(report.value("near/all/missing answers"), 360);
  EXPECT_TRUE(report.says("row: this column is missing"));
}

/// A command that says through a pipe, held open as long as it and what it started live, that a
/// child of it stands still; then it does `last`.
std::string with_a_child(const TemporaryFolder& folder, const std::string& last) {
  return "exec 3> " + make_pipe(folder.path("alive")) + "; cat " + make_pipe(folder.path("never")) +
         " & echo here >&3; " + last;
}

TEST(GradeCommand, WhatAnEndedToolLeavesBehindIsEnded) {
  const TemporaryFolder folder;
  Process process({"grade", "--corpus", "near", "--tool", with_a_child(folder, "true")});
  const int alive = process.meet_at(folder.path("alive"), O_RDONLY);
  const Finished run = process.wait();
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.out.find("near: the tool ended with status 0"), run.out.npos) << run.out;
  EXPECT_EQ(read_to_end(alive), "here\n");  // to the end: nobody holds it
}

TEST(GradeCommand, AShellsWordThatItsProgramWasKilledIsASignal) {
  const Report report = grade_tool(kKernel + "; sh -c 'kill -SEGV $$'; exit $?", "near");
  EXPECT_EQ(report.run.status, 1);
  EXPECT_TRUE(report.says("near: the tool was ended by signal 11")) << report.run.out;
  EXPECT_EQ(report.value("near/all/missing answers"), 0);
  for (const char* status : {"3", "128", "255"}) {
    EXPECT_EQ(grade_tool(kKernel + "; exit " + status, "near").run.status, 0) << status;
  }
}

TEST(GradeCommand, AnInterruptEndsTheToolAndAllThatItStarted) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const TemporaryFolder folder;
    const std::string tool = with_a_child(folder, "wait");
    const auto before = folder.names();
    Process process(
        {"grade", "--corpus", "near", "--json", folder.path("grade.json"), "--tool", tool});
    const int alive = process.meet_at(folder.path("alive"), O_RDONLY);
    std::string said(5, ' ');
    EXPECT_EQ(::read(alive, said.data(), said.size()), 5) << "here and a line's end";
    process.send(signal);
    EXPECT_EQ(process.wait().signal, signal);
    EXPECT_EQ(read_to_end(alive), "");  // once the kernel has done what it was told
    EXPECT_EQ(folder.names(), before);
  }
}

TEST(GradeCommand, SilenceIsAllMissing) {
  const Report report = grade_tool("cat > /dev/null", "near");
  EXPECT_EQ(report.run.status, 1);
  EXPECT_EQ(report.value("near/all/missing answers"), 360);
  EXPECT_TRUE(report.says("a header line that names the columns is missing"));
}

TEST(GradeCommand, RubbishAmongAnswersIsNamedByRowAndTheRestGraded) {
  const Report report = grade_tool(
      changed("NR == 3 { $3 = \"nan\" } NR == 4 { $2 = \"touching\" } NR == 5 { $5 = \"0.1.2\" } "
              "NR == 6 { $1 = 360 } NR == 7 { $1 = \"six\" } NR == 8 { $1 = -1 } "
              "NR == 9 { print \"x,y\"; next } NR == 10 { $6 = \"\" } { print }"),
      "near", {"--max-wrong", "0"});
  EXPECT_EQ(report.run.status, 1);
  for (const char* text :
       {"row 1, line 3: gap = nan: a number must be finite",
        "row 2, line 4: relation = touching: this is not a relation",
        "row 3, line 5: ny = 0.1.2: a cell must hold a number",
        "line 6: row = 360: the corpus has the rows 0 to 359",
        "line 7: row = six: a cell must hold a number", "line 8: row = -1: the corpus has",
        "line 9: 2 cells: a row must have as many cells as the header"}) {
    EXPECT_TRUE(report.says(text)) << text << '\n' << report.run.out;
  }
  EXPECT_EQ(report.value("near/faulty lines or cells"), 7);
  EXPECT_EQ(report.value("near/all/missing answers"), 8);
  EXPECT_EQ(report.value("near/all/wrong relations"), 0);
}

TEST(GradeCommand, ALineBeyondAllLinesEndsTheReading) {
  const Report report = grade_tool(
      "printf 'row,overlaps\\n0,1\\n5,0\\n'; head -c 1400000 /dev/zero | tr '\\0' 1; printf "
      "'\\n6,1\\n'",
      "near");
  EXPECT_TRUE(report.says("\n  line 4: a line must be shorter than")) << report.run.out;
  EXPECT_TRUE(report.says("; what follows is not read\n"));
  EXPECT_EQ(report.value("near/all/missing answers"), 358);
}

TEST(GradeCommand, APartOfANormalIsAFault) {
  const Report report = grade_tool(changed("{ print $1, $2, $4, $5 }"), "near");
  EXPECT_EQ(report.run.status, 1);
  EXPECT_TRUE(report.says("the header names a part of a normal")) << report.run.out;
  EXPECT_EQ(report.value("near/faulty lines or cells"), 1);
}

TEST(GradeCommand, SkippedRowsAreCountedAndTheFirstNamed) {
  const Report report = grade_tool(changed("NR == 1 || $1 % 10 != 7"), "near");
  EXPECT_EQ(report.run.status, 1);
  EXPECT_EQ(report.value("near/all/missing answers"), 36);
  EXPECT_TRUE(report.says("near: 36 missing answers, the first is row 7"));
  EXPECT_EQ(report.value("near/faulty lines or cells"), 0);
}

TEST(GradeCommand, OfARowAnsweredTwiceTheFirstCountsAndTheSecondIsNamed) {
  const Report report = grade_tool(changed("{ print } $1 == 4 { $2 = \"equal\"; $3 = 7; print }"),
                                   "near", {"--max-wrong", "0"});
  EXPECT_EQ(report.run.status, 1);
  EXPECT_TRUE(report.says("line 7: row = 4: this row is answered again"));
  EXPECT_EQ(report.value("near/all/wrong relations"), 0);
  EXPECT_EQ(report.value("near/all/missing answers"), 0);
  EXPECT_EQ(report.value("near/faulty lines or cells"), 1);
}

TEST(GradeCommand, OverlapsOnAnExternalTouchIsCountedApart) {
  const Report report = grade_tool(changed("NR == 1 { print \"row,overlaps\"; next } "
                                           "{ print $1, ($2 == \"separate\" ? 0 : 1) }"),
                                   "touching", {"--max-wrong", "0"});
  EXPECT_EQ(report.run.status, 0) << report.run.out;
  EXPECT_EQ(report.value("touching/integer_touch_outside/overlaps on an external touch"), 90);
  EXPECT_EQ(report.value("touching/all/wrong relations"), 0);
  const Report never =
      grade_tool(changed("NR == 1 { print \"row,overlaps\"; next } { print $1, 0 }"), "touching",
                 {"--max-wrong", "0"});
  EXPECT_EQ(never.run.status, 1);
  EXPECT_EQ(never.value("touching/all/overlaps on an external touch"), 0);
}

TEST(GradeCommand, AClaimedBoundThatIsTooSmallIsBroken) {
  const Report report = grade_tool(
      changed("NR == 1 { print $1, $3, $13; next } { print $1, $3 + 1e-9, $13 }"), "classes");
  EXPECT_EQ(report.run.status, 1);
  EXPECT_EQ(report.value("classes/all/broken bounds"), 450);
  EXPECT_TRUE(report.says("450 errors above the claimed gap_error, the first in row 0"));
}

TEST(GradeCommand, AThresholdAsksForTheColumn) {
  const std::string tool = changed("{ print $1, $2 }");
  EXPECT_EQ(grade_tool(tool, "classes", {"--max-wrong", "0"}).run.status, 0);
  for (const char* threshold : {"--max-gap-error", "--max-normal-error"}) {
    const Report report = grade_tool(tool, "classes", {threshold, "1"});
    EXPECT_EQ(report.run.status, 1);
    EXPECT_EQ(report.value("classes/all/missing answers"), 450);
  }
}

TEST(GradeCommand, EveryNormalThatReachesTheGapIsRight) {
  const TemporaryFolder folder;
  const std::string columns =
      "row,family,relation,inner,size,gap,normals,nx,ny,nz,ax,ay,az,pw.gap,pw.nx,pw.ny,pw.nz,mp."
      "gap\n";
  folder.write("ties.csv", "a.x\n0\n0\n0\n");
  folder.write("ties.truth.csv", columns +
                                     "0,two,overlap,,4,-1,point,1,0,0,,,,,,,,\n"
                                     "0,two,overlap,,4,-1,point,-1,0,0,,,,,,,,\n"
                                     "1,circle,overlap,,4,-1,circle,0.6,0,0.8,0,0,1,,,,,\n"
                                     "2,all,equal,,4,-2,all,,,,,,,,,,,\n");
  const auto error = [&](const std::string& rows, const std::string& family) {
    const std::string answers = folder.write("answers.csv", "row,nx,ny,nz\n" + rows);
    const Report report =
        grade({"--answers", answers, "--corpus", "ties", "--corpora", folder.path("")});
    EXPECT_EQ(report.run.status, 0) << report.run.out << report.run.err;
    return report.value("ties/" + family + "/normal error, largest");
  };
  const std::string right = "2,0.48,0.64,0.6\n1,-0.36,-0.48,0.8\n0,-1,0,0\n";
  EXPECT_EQ(error(right, "two"), 0);
  EXPECT_LT(error(right, "circle"), 1e-15);
  EXPECT_LT(error(right, "all"), 1e-15);
  const std::string off = "0,0,1,0\n1,0.8,0,0.6\n2,0,0,1.0005\n";
  EXPECT_NEAR(error(off, "two"), 1.41421356, 1e-8);
  EXPECT_NEAR(error(off, "circle"), 0.28284271, 1e-8);
  EXPECT_NEAR(error(off, "all"), 5e-4, 1e-12);  // of the length alone
  const auto reversed = [&](const std::string& rows, const std::string& family) {
    const std::string answers = folder.write("answers.csv", "row,nx,ny,nz\n" + rows);
    return grade({"--answers", answers, "--corpus", "ties", "--corpora", folder.path("")})
        .value("ties/" + family + "/reversed normals");
  };
  EXPECT_EQ(reversed(off, "all"), 0);
  EXPECT_EQ(reversed("0,1,0,0\n1,0.8192,0,-0.5735\n2,0,0,-1\n", "circle"), 0);
  EXPECT_EQ(reversed("0,1,0,0\n1,0.7809,0,-0.6247\n2,0,0,-1\n", "circle"), 1);
  EXPECT_EQ(reversed("0,0.1,0,0\n1,0,0,-1\n2,0,0,-1\n", "two"), 0);
}

TEST(GradeCommand, GradesByTheDefinitionThatIsAskedFor) {
  const std::string tool = kKernel + " --method perram-wertheim";
  const std::vector<std::string> limit{"--max-gap-error", "1e-15"};
  std::vector<std::string> right = limit;
  right.insert(right.end(), {"--definition", "perram-wertheim"});
  EXPECT_EQ(grade_tool(tool, "deep", right).run.status, 0);
  EXPECT_EQ(grade_tool(tool, "deep", limit).run.status, 1);
}

TEST(GradeCommand, TheLineOfCentresIsADefinitionWithoutNormals) {
  const Report report = grade_tool(kKernel, "symmetric", {"--definition", "centre-line"});
  EXPECT_LT(report.value("symmetric/spheres/gap error, largest"), 1e-15);
  EXPECT_GT(report.value("symmetric/all/gap error, largest"), 1e-3);
  EXPECT_FALSE(report.says("reversed"));
  EXPECT_EQ(report.value("symmetric/all/missing answers"), 0);
}

TEST(GradeCommand, NormalsOfEllipsesAreScored) {
  const std::string tool = TANGENCY_CONTACT " ellipse";
  const Report report = grade_tool(tool, "ellipses", {"--max-normal-error", "1e-6"});
  EXPECT_EQ(report.run.status, 0) << report.run.out;
  EXPECT_LT(report.value("ellipses/circles/normal error, largest"), 1e-15);
  const Report turned = grade_tool(
      tool + " | awk -F, -v OFS=, 'NR > 1 { $6 = -$6; $7 = -$7 } { print }'", "ellipses");
  EXPECT_EQ(turned.run.status, 1);
  EXPECT_EQ(turned.value("ellipses/near touch/reversed normals"), 60);
  EXPECT_EQ(turned.value("ellipses/concentric/reversed normals"), 0);  // either way is right
}

TEST(GradeCommand, AToolReadsInputsAndNeitherCommentsNorTruth) {
  const Report report = grade_tool("cat >&2", "near");
  EXPECT_TRUE(report.says("its last words: ")) << report.run.out;
  const Report first = grade_tool("head -n 1 >&2", "near");
  EXPECT_TRUE(
      first.says("its last words: a.x,a.y,a.z,a.r1,a.r2,a.r3,a.qw,a.qx,a.qy,a.qz,b.x,b.y,b.z,"
                 "b.r1,b.r2,b.r3,b.qw,b.qx,b.qy,b.qz\n"))
      << first.run.out;
}

TEST(GradeCommand, ThePageStandsAlone) {
  const TemporaryFolder folder;
  const Report report =
      grade_tool(kKernel + " # <b>", "near", {"--html", folder.path("page.html")});
  const std::string page = read_file(folder.path("page.html"));
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_NE(page.find("gap 1e-17"), std::string::npos);
  for (const char* foreign : {"http", "src=", "href=", "<script", "<b>"}) {
    EXPECT_EQ(page.find(foreign), std::string::npos) << foreign;
  }
  EXPECT_TRUE(page.ends_with("</html>\n"));
}

TEST(GradeCommand, RefusesWhatItCannotGrade) {
  const auto refusal = [](const std::vector<std::string>& arguments) {
    const Report report = grade(arguments);
    EXPECT_EQ(report.run.status, 2);
    EXPECT_TRUE(report.values.is_null());
    EXPECT_EQ(report.run.err.find('\n'), report.run.err.size() - 1) << report.run.err;
    return report.run.err;
  };
  EXPECT_NE(refusal({"--tool", "true", "--corpus", "none"}).find("there is no corpus none here"),
            std::string::npos);
  EXPECT_NE(refusal({"--tool", "true", "--answers", "x"}).find("--answers or --tool"),
            std::string::npos);
  EXPECT_NE(refusal({"--answers", "x"}).find("--corpus"), std::string::npos);
  EXPECT_NE(
      refusal({"--answers", "/none/x.csv", "--corpus", "near"}).find("/none/x.csv: cannot be read"),
      std::string::npos);
  EXPECT_NE(refusal({"--tool", "true", "--definition", "chord"})
                .find("--definition: chord not in {common-normal,perram-wertheim"),
            std::string::npos);
  for (const auto& [option, values, allowed] :
       std::vector<std::tuple<std::string, std::vector<std::string>, std::string>>{
           {"--max-wrong", {"-1", "010", "1.5", "99999999999999999999"}, "a whole number from 0"},
           {"--max-gap-error", {"-1", "nan", "inf", "abc", "1e999"}, "a finite number >= 0"},
           {"--max-normal-error", {"nan"}, "a finite number >= 0"},
           {"--baseline-slack", {"nan", "-0.1"}, "a finite number >= 0"},
           {"--time-limit", {"nan", "0", "inf"}, "a finite number > 0"}}) {
    for (const std::string& value : values) {
      EXPECT_NE(refusal({"--tool", "true", option, value})
                    .find(option + ": " + value + " is not " + allowed),
                std::string::npos);
    }
  }
  for (const char* option : {"--baseline", "--corpora", "--html"}) {
    EXPECT_NE(refusal({"--tool", "true", option, ""}).find(option), std::string::npos);
  }
  EXPECT_NE(refusal({"--tool", "true", "--corpus", "near", "deep", "near"})
                .find("near is named more than once"),
            std::string::npos);
  EXPECT_NE(
      refusal({"--answers", "/", "--corpus", "near"}).find("/: cannot be read: Is a directory"),
      std::string::npos);
  const TemporaryFolder folder;
  folder.write("bad.truth.csv", "row,family,type\n1,f,plane\n");
  EXPECT_NE(refusal({"--tool", "true", "--corpus", "bad", "--corpora", folder.path("")})
                .find("bad.truth.csv:2: row = 1: rows must be numbered from 0 in order"),
            std::string::npos);
}

TEST(GradeCommand, RefusesTruthThatIsNone) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& truth, const std::string& inputs = "x\n1\n") {
    folder.write("own.csv", inputs);
    folder.write("own.truth.csv", truth);
    const Report report =
        grade({"--tool", "true", "--corpus", "own", "--corpora", folder.path("")});
    EXPECT_EQ(report.run.status, 2);
    return report.run.err;
  };
  const std::string types = "row,family,type\n0,f,";
  EXPECT_NE(refusal(types + "plain\n").find("own.truth.csv:2: type = plain: this is not a type"),
            std::string::npos);
  EXPECT_NE(
      refusal(types + "plane\n", "x\n1\n2\n").find("own.csv: 2 rows: the truth beside it is of 1"),
      std::string::npos);
  const std::string pairs =
      "row,family,relation,size,gap,normals,nx,ny,nz,ax,ay,az\n0,f,separate,4,1,point,";
  EXPECT_NE(
      refusal(pairs + "0,0,0,,,\n").find("own.truth.csv:2: nx = 0: the vector that begins here"),
      std::string::npos);
  for (const char* second :
       {"0,f,overlap,4,1,point,0,1,0,,,\n", "0,f,separate,4,2,point,0,1,0,,,\n"}) {
    EXPECT_NE(refusal(pairs + "1,0,0,,,\n" + second).find("own.truth.csv:3: "), std::string::npos);
  }
}

TEST(GradeCommand, AnOutputThatCannotBeWrittenIsRefusedBeforeTheToolIsStarted) {
  const TemporaryFolder folder;
  const Finished run =
      run_tool({"grade", "--tool", "touch " + folder.path("started"), "--corpus", "near", "--html",
                folder.path("page.html"), "--json", "/none/grade.json"});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("/none/grade.json: "), std::string::npos);
  EXPECT_EQ(folder.names(), std::vector<std::string>{});
}

TEST(GradeCommand, AReaderThatHasGoneEndsItWithoutAWordAndLeavesNothing) {
  const TemporaryFolder folder;
  Process::Place gone;
  gone.reader_has_gone = true;
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--help"},
        {"generate", "--list"},
        {"grade", "--tool", kKernel, "--corpus", "near", "--json", folder.path("grade.json")}}) {
    const Finished run = run_tool(arguments, "", gone);
    EXPECT_EQ(run.signal, SIGPIPE) << arguments[0];
    EXPECT_EQ(run.err, "") << arguments[0];
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{});
}

TEST(GradeCommand, NamesAMistypedSubcommandAndTheNearest) {
  const std::string end = " (`tangency-verify --help` says what is allowed)\n";
  EXPECT_EQ(run_tool({"garde", "--tool", "true"}).err,
            "tangency-verify: garde is no subcommand; the nearest is grade" + end);
  EXPECT_EQ(
      run_tool({"fly"}).err,
      "tangency-verify: fly is no subcommand; generate, hunt, grade, show and inputs are" + end);
}

TEST(GenerateCommand, NamesEveryCorpusAndRefusesOthers) {
  const Finished list = run_tool({"generate", "--list"});
  EXPECT_EQ(list.status, 0);
  for (const char* name : {"classes ", "near ", "touching ", "symmetric ", "nested ", "extreme ",
                           "deep ", "ellipses ", "quadrics "}) {
    EXPECT_NE(list.out.find(name), std::string::npos) << name;
  }
  const Finished none = run_tool({"generate", "none", "--out", "x"});
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("none is not a corpus"), std::string::npos);
  EXPECT_EQ(run_tool({"generate", "near"}).status, 2);
  EXPECT_EQ(run_tool({"generate"}).status, 2);
}

}  // namespace
}  // namespace tangency::testing
