// SPDX-License-Identifier: GPL-3.0-or-later
/// The row loop from outside: threads, pipes, signals, failing output, progress. `contact` stands
/// for every subcommand.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <tangency/tests/tool/process.hpp>

namespace tangency::testing {
namespace {

using Names = std::vector<std::string>;

const std::string kHeader = "a.x,a.y,a.z,a.r1,a.r2,a.r3,b.x,b.y,b.z,b.r1,b.r2,b.r3\n";

/// Rows of about 80 bytes; every `bad_every`th has an impossible semi-axis.
std::string rows(std::size_t count, std::size_t bad_every = 0) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    const bool bad = bad_every > 0 && i % bad_every == bad_every - 1;
    text += "0,0,0,1,0x1.8p+0,1,3." + std::to_string(i % 1009) + ",0.25,0x1.fffffffffffffp-3,2,1," +
            (bad ? "0" : "1.0000000000000002") + "\n";
  }
  return text;
}

std::size_t count_lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

Finished run_with_threads(unsigned threads, Names arguments, const std::string& input = "") {
  arguments.insert(arguments.begin(), {"contact", "--threads", std::to_string(threads)});
  return run_tool(arguments, input);
}

// geometry/tables/row_stream.hpp (1)
TEST(RowStream, EveryNumberOfThreadsWritesTheSameBytes) {
  const TemporaryFolder folder;
  const std::string text = kHeader + rows(30'000);  // about ten blocks
  const std::string path = folder.write("pairs.csv", text);
  const Finished one = run_with_threads(1, {path});
  EXPECT_EQ(count_lines(one.out), 30'001U);
  EXPECT_EQ(one.status, 0);
  for (const unsigned threads : {2U, 3U, 8U}) {
    EXPECT_EQ(run_with_threads(threads, {path}).out == one.out, true) << threads;
    EXPECT_EQ(run_with_threads(threads, {}, text).out == one.out, true) << threads << ", a pipe";
  }
}

// geometry/tables/row_stream.hpp (2)
TEST(RowStream, EveryNumberOfThreadsRefusesTheSameRow) {
  const TemporaryFolder folder;
  const std::string path = folder.write("pairs.csv", kHeader + rows(30'000, 20'000) + rows(9, 1));
  const Finished one = run_with_threads(1, {path});
  EXPECT_EQ(one.status, 2);
  EXPECT_EQ(one.err, path + ":20001: b.r3 = 0: a semi-axis must be finite and > 0\n");
  EXPECT_EQ(count_lines(one.out), 20'000U);  // the header and rows 0 to 19998
  for (const unsigned threads : {2U, 3U, 8U}) {
    const Finished more = run_with_threads(threads, {path});
    EXPECT_EQ(more.status, 2);
    EXPECT_EQ(more.err, one.err);
    EXPECT_EQ(more.out == one.out, true) << threads;
  }
}

TEST(RowStream, EveryNumberOfThreadsKeepsGoingTheSameWay) {
  struct Case {
    std::size_t bad_every;
    std::size_t messages;
  };
  for (const Case& tried : {Case{4'000, 7}, Case{100, 11}}) {
    const TemporaryFolder folder;
    const std::string path = folder.write("pairs.csv", kHeader + rows(30'000, tried.bad_every));
    const Finished one = run_with_threads(1, {"--keep-going", path});
    EXPECT_EQ(one.status, 1);
    EXPECT_EQ(count_lines(one.out), 30'001U);
    EXPECT_EQ(count_lines(one.err), tried.messages) << one.err;
    for (const unsigned threads : {2U, 3U, 8U}) {
      const Finished more = run_with_threads(threads, {"--keep-going", path});
      EXPECT_EQ(more.err, one.err);
      EXPECT_EQ(more.out == one.out, true) << threads;
    }
  }
}

TEST(RowStream, LineThatIsTooLongIsRefusedAfterTheRowsBeforeIt) {
  const Finished run = run_with_threads(
      2, {}, kHeader + rows(5'000) + std::string((1 << 20) + (1 << 18), '1') + "\n");
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err, "<stdin>:5002: a line must be shorter than 1048576 bytes\n");
  EXPECT_EQ(count_lines(run.out), 5'001U);
}

TEST(RowStream, AnswersARowBeforeTheNextOneComes) {
  Process tool({"contact", "--threads", "2"});
  tool.write_input(kHeader);
  EXPECT_TRUE(tool.read_output_line().starts_with("row,"));
  for (int i = 0; i < 3; ++i) {
    tool.write_input(rows(1));
    EXPECT_TRUE(tool.read_output_line().starts_with(std::to_string(i) + ","));
  }
  tool.close_input();
  EXPECT_EQ(tool.wait().status, 0);
}

TEST(RowStream, RefusalDoesNotWaitForTheEndOfAPipe) {
  for (const char* threads : {"1", "2", "5"}) {
    Process tool({"contact", "--threads", threads});
    // Enough rows that another thread waits for more when the last one is refused.
    tool.write_input(kHeader + rows(600, 600));
    const Finished run = tool.wait();  // the input stays open
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.err, "<stdin>:601: b.r3 = 0: a semi-axis must be finite and > 0\n");
  }
}

TEST(RowStream, MemoryDoesNotGrowWithTheFile) {
  const TemporaryFolder folder;
  const auto peak = [&](const char* name, std::size_t times) {
    const std::string some = rows(10'000);
    std::ofstream file(folder.path(name), std::ios::binary);
    file << kHeader;
    for (std::size_t i = 0; i < times; ++i) file << some;
    file.close();
    const Process::Place nowhere{.standard_output = "/dev/null"};
    const Finished run = run_tool({"contact", "--threads", "2", folder.path(name)}, "", nowhere);
    EXPECT_EQ(run.status, 0);
    return run.peak_bytes;
  };
  const std::size_t small = peak("small.csv", 2), large = peak("large.csv", 60);
  std::printf("peak memory: %zu kB for 1.6 MB, %zu kB for 48 MB\n", small / 1000, large / 1000);
  EXPECT_LT(large, small + 4'000'000);
  EXPECT_LT(large, 100'000'000U);
}

TEST(RowStream, OutputFileHoldsWhatStandardOutputWould) {
  const TemporaryFolder folder;
  const std::string path = folder.write("pairs.csv", kHeader + rows(5'000));
  const std::string answers = folder.path("answers.csv");
  const Finished run = run_tool({"contact", path, "--out", answers});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(read_file(answers) == run_tool({"contact", path}).out, true);
  EXPECT_EQ(folder.names(), (Names{"answers.csv", "pairs.csv"}));
}

TEST(RowStream, InputMayBeReplacedByItsOwnAnswers) {
  const TemporaryFolder folder;
  const std::string path = folder.write("pairs.csv", kHeader + rows(10'000));
  const std::string answers = run_tool({"contact", path}).out;
  EXPECT_EQ(run_tool({"contact", path, "--out", path}).status, 0);
  EXPECT_EQ(read_file(path) == answers, true);
}

TEST(RowStream, SignalRemovesTheUnfinishedFile) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const TemporaryFolder folder;
    folder.write("answers.csv", "old");
    const FolderWatch watch(folder.path(""));
    Process tool({"contact", "--threads", "2", "--out", folder.path("answers.csv")});
    tool.write_input(kHeader + rows(100));
    watch.wait();
    EXPECT_EQ(folder.names().size(), 2U);
    tool.send(signal);
    EXPECT_EQ(tool.wait().signal, signal);
    EXPECT_EQ(folder.names(), Names{"answers.csv"});
    EXPECT_EQ(read_file(folder.path("answers.csv")), "old");
  }
}

TEST(RowStream, FullDiskIsAnError) {
  for (const Names& arguments : {Names{"contact"}, Names{"--help"}, Names{"--version"}}) {
    const Finished run = run_tool(arguments, kHeader + rows(10), {.standard_output = "/dev/full"});
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.err, "<stdout>: cannot be written: No space left on device\n");
  }
}

TEST(RowStream, ReaderThatHasGoneEndsItWithoutAWord) {
  const std::string quadrics = "A,B,C,D,E,F,G,H,J,K\n1,1,1,0,0,0,0,0,0,-1\n";
  const std::string ellipses =
      "a.x,a.y,a.r1,a.r2,a.angle,b.x,b.y,b.r1,b.r2,b.angle\n"
      "0,0,2,1,0,1,1,1,1,0\n";
  for (const auto& [subcommand, input] :
       {std::pair<std::string, std::string>{"contact", kHeader + rows(600)},
        {"overlap", kHeader + rows(600)},
        {"classify", quadrics},
        {"ellipse", ellipses},
        {"--help", ""},
        {"--version", ""}}) {
    const Finished run = run_tool({subcommand}, input, {.reader_has_gone = true});
    EXPECT_EQ(run.signal, SIGPIPE) << subcommand;
    EXPECT_EQ(run.err, "") << subcommand;
  }
}

TEST(RowStream, NamesAMistypedSubcommandAndTheNearest) {
  const std::string end = " (`tangency --help` says what is allowed)\n";
  for (const auto& [word, message] :
       {std::pair<std::string, std::string>{"contcat", "the nearest is contact"},
        {"overlpas", "the nearest is overlap"},
        {"clasify", "the nearest is classify"},
        {"elipse", "the nearest is ellipse"},
        {"xyzzy",
         "contact, overlap, classify, ellipse, point, ellipse-point, wall, ray, time and "
         "neighbours are"}}) {
    const Finished run = run_tool({word, "pairs.csv"});
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.err, "tangency: " + word + " is no subcommand; " + message + end);
  }
}

TEST(RowStream, TerminalSeesTheProgressOfALargeFileOnly) {
  const TemporaryFolder folder;
  const std::string large = folder.write("large.csv", kHeader + rows(60'000));
  const std::string small = folder.write("small.csv", kHeader + rows(10));
  const Process::Place terminal{.folder = folder.path(""), .error_is_terminal = true};
  const Names to_file{"contact", "--threads", "1", "--out", "answers.csv"};

  const auto shown = [&](const char* input, const Process::Place& place) {
    Names arguments = to_file;
    arguments.emplace_back(input);
    const Finished run = run_tool(arguments, "", place);
    EXPECT_EQ(run.status, 0);
    return run.err;
  };
  const std::string progress = shown("large.csv", terminal);
  EXPECT_NE(progress.find("large.csv: "), std::string::npos) << progress;
  EXPECT_NE(progress.find(" s left"), std::string::npos) << progress;
  EXPECT_TRUE(progress.ends_with("\r\033[K"));
  EXPECT_EQ(shown("small.csv", terminal), "");
  EXPECT_EQ(shown("large.csv", {.folder = folder.path("")}), "");
}

}  // namespace
}  // namespace tangency::testing
