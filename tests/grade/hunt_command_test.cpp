// SPDX-License-Identifier: GPL-3.0-or-later
// `tangency-verify hunt` on tools with one fault: it is found, made simple, and written down.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <tangency/tests/grade/report.hpp>

namespace tangency::testing {
namespace {

std::string faulty(const std::string& fault) { return TANGENCY_FAULTY_TOOL " " + fault; }

Finished hunt(const std::string& tool, std::vector<std::string> more) {
  more.insert(more.begin(), {"hunt", "--tool", tool, "--seed", "20261201"});
  return run_tool(more);
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(HuntCommand, FindsNothingInTheKernel) {
  const Finished run = hunt(kKernel, {"--answers", "250"});
  EXPECT_EQ(run.status, 0) << run.out;
  EXPECT_EQ(run.out, "passed: 250 answers: no fault found\n");
}

// Gaps of 1e-9 are as good as none in every corpus but `near`.
TEST(HuntCommand, WritesWhatItFindsAsACorpusThatTheToolFails) {
  const TemporaryFolder folder;
  const std::string tool = faulty("tolerance");
  const Finished run =
      hunt(tool, {"--from", "classes", "--answers", "300", "--out", folder.path("")});
  EXPECT_EQ(run.status, 1) << run.out << run.err;
  EXPECT_TRUE(has(run.out, "overlaps 1 where separate")) << run.out;
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"hunt.csv", "hunt.truth.csv"}));
  const Report of_tool = grade({"--tool", tool, "--corpora", folder.path(""), "--corpus", "hunt"});
  EXPECT_EQ(of_tool.run.status, 1);
  EXPECT_EQ(of_tool.value("hunt/all/wrong relations"), of_tool.value("hunt/all/pairs"));
  const Report of_kernel =
      grade({"--tool", kKernel, "--corpora", folder.path(""), "--corpus", "hunt"});
  EXPECT_EQ(of_kernel.run.status, 0) << of_kernel.run.out;
}

// Gaps of 1e-9 are nothing to the first, and it says so; the second says it too, and has other
// faults.
TEST(HuntCommand, WhatAToolDoesNotClaimIsNoFault) {
  const std::vector<std::string> asked{"--from", "classes", "--answers", "300"};
  std::vector<std::string> honest = asked;
  honest.insert(honest.end(), {"--not-claimed", "near,touching,extreme"});
  EXPECT_EQ(hunt(faulty("tolerance"), asked).status, 1);
  const Finished run = hunt(faulty("tolerance"), honest);
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_TRUE(run.out.starts_with("not claimed: ")) << run.out;
  const Finished other = hunt(faulty("equal-axes"), {"--from", "symmetric", "--answers", "160",
                                                     "--not-claimed", "near,touching,extreme"});
  EXPECT_EQ(other.status, 1) << other.out << other.err;
}

TEST(HuntCommand, GoesOnFromItsStateAsIfThereHadBeenNoBreak) {
  const TemporaryFolder folder;
  const std::string tool = faulty("equal-axes"), state = folder.path("state.json");
  const Finished whole = hunt(tool, {"--from", "symmetric", "--answers", "60"});
  hunt(tool, {"--from", "symmetric", "--answers", "30", "--state", state});
  const Finished resumed = hunt(tool, {"--from", "symmetric", "--answers", "60", "--state", state});
  EXPECT_EQ(whole.status, 1) << whole.out;
  EXPECT_EQ(resumed.out, whole.out);
  const Finished other = hunt(tool, {"--from", "deep", "--answers", "60", "--state", state});
  EXPECT_EQ(other.status, 2);
  EXPECT_TRUE(has(other.err, "state.json: this is the state of another hunt: ")) << other.err;
  EXPECT_TRUE(has(other.err, "--from symmetric")) << other.err;
}

TEST(HuntCommand, FindsBoundsThatAreClaimedTooSmall) {
  const Finished run =
      hunt(faulty("bound"), {"--goal", "certificate", "--from", "extreme", "--answers", "200"});
  EXPECT_EQ(run.status, 1) << run.out;
  EXPECT_TRUE(has(run.out, "fault bound broken: ")) << run.out;
}

TEST(HuntCommand, APairThatEndsTheToolIsFoundAmongOthers) {
  const Finished run = hunt(faulty("far"), {"--from", "extreme", "--answers", "30"});
  EXPECT_EQ(run.status, 1) << run.out;
  EXPECT_TRUE(has(run.out, "finding 1: no answer (")) << run.out;
  EXPECT_TRUE(has(run.out, "the tool was ended by signal 9")) << run.out;
  EXPECT_TRUE(has(run.out, "1 kinds of faults")) << run.out;
}

TEST(HuntCommand, AnInterruptEndsTheSearchAndShowsWhatWasFound) {
  const TemporaryFolder folder;
  const std::string count = folder.path("count"), hang = make_pipe(folder.path("hang"));
  make_pipe(folder.path("here"));
  // The third batch stands still once it has told of itself.
  const std::string tool = "n=$(cat " + count + " 2> /dev/null || echo 0); echo $((n + 1)) > " +
                           count + "; " + faulty("equal-axes") +
                           "; if [ $n = 2 ]; then echo here > " + folder.path("here") + "; cat " +
                           hang + "; fi";
  Process process({"hunt", "--tool", tool, "--from", "symmetric", "--seed", "20261201"});
  const int here = process.meet_at(folder.path("here"), O_RDONLY);
  EXPECT_EQ(read_to_end(here), "here\n");
  process.send(SIGINT);
  const Finished run = process.wait();
  EXPECT_EQ(run.status, 1) << run.out << run.err;
  EXPECT_TRUE(has(run.out, "\n  not made simple: the hunt had to end\n")) << run.out;
  EXPECT_TRUE(has(run.out, "\ninterrupted\nFAILED: 48 answers: ")) << run.out;
  EXPECT_EQ(read_file(count), "3\n") << "batches";
}

TEST(HuntCommand, AnInterruptEndsTheMakingSimpleToo) {
  const TemporaryFolder folder;
  const std::string hang = make_pipe(folder.path("hang"));
  make_pipe(folder.path("here"));
  // One pair is asked of again where it is made simple: no batch of the search is so short.
  const std::string tool = "t=$(cat); if [ $(echo \"$t\" | wc -l) = 2 ]; then echo here > " +
                           folder.path("here") + "; cat " + hang + "; fi; echo \"$t\" | " +
                           faulty("equal-axes");
  Process process(
      {"hunt", "--tool", tool, "--from", "symmetric", "--seed", "20261201", "--answers", "48"});
  const int here = process.meet_at(folder.path("here"), O_RDONLY);
  EXPECT_EQ(read_to_end(here), "here\n");
  process.send(SIGTERM);
  const Finished run = process.wait();
  EXPECT_EQ(run.status, 1) << run.out << run.err;
  EXPECT_TRUE(has(run.out, "\n  not made simple: the hunt had to end\n")) << run.out;
  EXPECT_TRUE(has(run.out, "\ninterrupted\nFAILED: 48 answers: ")) << run.out;
}

// The tool never ends: what ends it is the hunt's own time.
TEST(HuntCommand, ABatchThatRunsIsEndedWithTheSecondsAndNothingPasses) {
  const TemporaryFolder folder;
  const Finished run = hunt("cat " + make_pipe(folder.path("hang")), {"--seconds", "0.05"});
  EXPECT_EQ(run.status, 2) << run.out;
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(has(run.err, "--seconds: no batch of the tool ended within 0.05 s")) << run.err;
}

TEST(HuntCommand, AToolThatAnswersNothingIsRefusedWithItsLastWords) {
  const TemporaryFolder folder;
  const Finished missing = hunt("./no-such-tool", {"--out", folder.path("found")});
  EXPECT_EQ(missing.status, 2) << missing.out;
  EXPECT_EQ(missing.out, "");
  EXPECT_TRUE(has(missing.err,
                  "--tool: none of the first 16 pairs is answered: the tool ended with status 127 "
                  "without an answer: what it printed: "))
      << missing.err;
  EXPECT_TRUE(has(missing.err, "not found")) << missing.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path("found/hunt.csv")));
  const Finished silent = hunt("true", {});
  EXPECT_EQ(silent.status, 2) << silent.out;
  EXPECT_TRUE(has(silent.err, "the tool ended with status 0 without an answer")) << silent.err;
  const Finished dead = hunt("kill -9 $$", {});
  EXPECT_EQ(dead.status, 2) << dead.out;
  EXPECT_TRUE(has(dead.err, "the tool was ended by signal 9")) << dead.err;
}

TEST(HuntCommand, ACellThatCannotBeReadIsAFault) {
  const Finished run =
      hunt(kKernel + " | sed s/,separate,/,apart,/", {"--from", "near", "--answers", "16"});
  EXPECT_EQ(run.status, 1) << run.out << run.err;
  EXPECT_TRUE(has(run.out, "unreadable cell")) << run.out;
}

TEST(HuntCommand, RefusesWhatItCannotHuntFor) {
  const Finished no_column = hunt(faulty("tolerance"), {"--goal", "normal", "--answers", "16"});
  EXPECT_EQ(no_column.status, 2);
  EXPECT_TRUE(has(no_column.err, "--tool: its answers have no column nx, ny, nz")) << no_column.err;
  EXPECT_EQ(hunt(kKernel, {"--goal", "speed"}).status, 2);
  for (const char* answers : {"0", "-1", "1.5"}) {
    EXPECT_EQ(hunt(kKernel, {"--answers", answers}).status, 2) << answers;
  }
  EXPECT_EQ(run_tool({"hunt", "--tool", kKernel, "--answers", "16", "--seed", "-1"}).status, 2);
  for (const char* name : {"ellipses", "nope"}) {
    const Finished from = hunt(kKernel, {"--from", name});
    EXPECT_EQ(from.status, 2);
    EXPECT_TRUE(has(from.err, "--from: there is no corpus of pairs " + std::string(name) +
                                  " here; there are: classes deep "))
        << from.err;
  }
  for (const auto& [features, said] :
       {std::pair("tie", "tie is not a feature; these are: touching near nested deep ties extreme"),
        std::pair("near,ties", "ties is no feature of a hunt"),
        std::pair("", "a list of features is empty"),
        std::pair("touching,near,nested,deep", "none of 1 answers is left to judge")}) {
    const Finished none =
        hunt(kKernel, {"--from", "near", "--answers", "1", "--not-claimed", features});
    EXPECT_EQ(none.status, 2) << features;
    EXPECT_TRUE(has(none.err, "--not-claimed: " + std::string(said))) << none.err;
  }
  const TemporaryFolder folder;
  const Finished rubbish = hunt(kKernel, {"--state", folder.write("state.json", "[1]")});
  EXPECT_EQ(rubbish.status, 2);
  EXPECT_TRUE(has(rubbish.err, "state.json: this is no state of a hunt")) << rubbish.err;
  for (const std::string& state : {std::string("/dev/zero"), folder.path("")}) {
    const Finished no_file = hunt(kKernel, {"--state", state});
    EXPECT_EQ(no_file.status, 2);
    EXPECT_TRUE(has(no_file.err, state + ": a state must be a regular file")) << no_file.err;
  }
}

}  // namespace
}  // namespace tangency::testing
