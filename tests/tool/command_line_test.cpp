// SPDX-License-Identifier: GPL-3.0-or-later
// The command line and the frame of main() from inside: what a program is told, what it refuses,
// and what becomes of what it prints. The commands' own tests hold their texts.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iostream>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <tangency/geometry/tables/command_line.hpp>

namespace tangency::testing {
namespace {

using tables::Command;
using tables::Program;

struct Ended {
  int status;
  std::string err;
};

Ended run(Program& program, std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "prog");
  ::testing::internal::CaptureStderr();
  const int status = program.run(static_cast<int>(arguments.size()), arguments.data());
  return {status, ::testing::internal::GetCapturedStderr()};
}

TEST(CommandLine, ReadsEveryKindOfValue) {
  Program program("prog", "A program");
  double real = 0.5;
  std::optional<double> maybe, left_out;
  int integer = 0;
  unsigned natural = 0;
  long wide = 0;
  std::uint64_t seed = 0;
  std::string word, place;
  std::vector<std::string> words;
  bool flag = false, other_flag = false;
  program.option("--real", real);
  program.option("--maybe", maybe);
  program.option("--left-out", left_out);
  program.option("--integer", integer);
  program.option("--natural", natural);
  program.option("--wide", wide);
  program.option("--seed", seed);
  program.option("--word", word);
  program.option("--words", words);
  program.option("FILE", place);
  program.flag("--flag", flag);
  program.flag("--other-flag", other_flag);
  program.runs([] { return 7; });
  const Ended ended =
      run(program, {"--real", "1e-3", "--maybe", "2", "--integer", "-3", "--natural=4", "--wide",
                    "-5", "--seed", "18446744073709551615", "--word", "", "--words", "a", "--words",
                    "b", "--flag", "file"});
  EXPECT_EQ(ended.status, 7) << ended.err;
  EXPECT_EQ(real, 1e-3);
  EXPECT_EQ(maybe, 2.0);
  EXPECT_EQ(left_out, std::nullopt);
  EXPECT_EQ(integer, -3);
  EXPECT_EQ(natural, 4U);
  EXPECT_EQ(wide, -5);
  EXPECT_EQ(seed, UINT64_MAX);
  EXPECT_EQ(words, (std::vector<std::string>{"a", "b"}));
  EXPECT_TRUE(flag);
  EXPECT_FALSE(other_flag);
  EXPECT_EQ(place, "file");
}

// geometry/tables/command_line.hpp (1)
TEST(CommandLine, EveryRefusalIsOneLineThatNamesTheOption) {
  const auto refusal = [](std::vector<const char*> arguments) {
    Program program("prog", "A program");
    int count = 1;
    std::string word = "half", file = "-";
    program.option("--count", count).between(1, 9);
    program.option("--word", word).one_of({"half", "full"});
    program.option("--file", file).not_empty().check([](const std::string& text) {
      return text == "bad" ? "bad is bad" : std::string();
    });
    program.runs([] { return 0; });
    const Ended ended = run(program, std::move(arguments));
    EXPECT_EQ(ended.status, 2);
    return ended.err;
  };
  const std::string end = " (`prog --help` says what is allowed)\n";
  EXPECT_EQ(refusal({"--count", "0"}), "prog: --count: Value 0 not in range 1 to 9" + end);
  EXPECT_EQ(refusal({"--count", "10"}), "prog: --count: Value 10 not in range 1 to 9" + end);
  EXPECT_EQ(refusal({"--word", "third"}), "prog: --word: third not in {half,full}" + end);
  EXPECT_EQ(refusal({"--file", ""}), "prog: --file: a file name is empty" + end);
  EXPECT_EQ(refusal({"--file", "bad"}), "prog: --file: bad is bad" + end);
  EXPECT_EQ(refusal({"stray"}), "prog: The following argument was not expected: stray" + end);
}

TEST(CommandLine, OnlyTheChosenSubcommandRuns) {
  Program program("prog", "A program");
  std::string ran;
  for (const char* name : {"first", "second"}) {
    program.subcommand(name, "One").runs([&ran, name] {
      ran += name;
      return 3;
    });
  }
  EXPECT_EQ(run(program, {"second"}).status, 3);
  EXPECT_EQ(ran, "second");
}

TEST(CommandLine, AnOptionTellsWhetherItWasGiven) {
  for (const bool given : {false, true}) {
    Program program("prog", "A program");
    int value = 5;
    const tables::Option option = program.option("--value", value);
    program.runs([&] { return option.given() ? 1 : 0; });
    const std::vector<const char*> all{"--value", "5"};
    EXPECT_EQ(run(program, given ? all : std::vector<const char*>()).status, given ? 1 : 0);
  }
}

// geometry/tables/command_line.hpp (1)
TEST(CommandLine, WhatTheBodyThrowsIsARefusalWithTheNameOfTheProgram) {
  const auto refusal = [](const std::function<int()>& body) {
    Program program("prog", "A program");
    program.subcommand("sub", "One").runs(body);
    const Ended ended = run(program, {"sub"});
    EXPECT_EQ(ended.status, 2);
    return ended.err;
  };
  EXPECT_EQ(refusal([]() -> int { throw tables::UsageError("--out is required"); }),
            "prog sub: --out is required (`prog sub --help` says what is allowed)\n");
  EXPECT_EQ(refusal([]() -> int { throw std::runtime_error("pairs.csv:1: no"); }),
            "pairs.csv:1: no\n");
  EXPECT_EQ(refusal([]() -> int { throw std::bad_alloc(); }), "prog: out of memory\n");
  EXPECT_EQ(refusal([]() -> int {
              throw std::filesystem::filesystem_error(
                  "cannot rename", std::make_error_code(std::errc::no_space_on_device));
            }),
            "prog: filesystem error: cannot rename: No space left on device\n");
}

std::string described_as(const char* form) {
  Program program("prog-a", "prog-a: does a thing.\nMore of it.", "1.2");
  std::string word, hidden, file, out, number;
  Command& make = program.subcommand("make", "Makes: it");
  make.option("--level", word, "How [much]").one_of({"half", "full"});
  make.option("--out", out, "Output").type_name("FILE");
  make.option("--most", number, "How many").type_name("N");
  make.option("--secret", hidden, "Nobody's").hidden();
  make.option("FILE", file, "Input");
  make.footer(".a line\n'that a request'\nbegins \\ like");
  program.subcommand("mend", "Mends it");
  ::testing::internal::CaptureStdout();
  EXPECT_EQ(run(program, {"--describe", form}).status, 0);
  return ::testing::internal::GetCapturedStdout();
}

// geometry/tables/command_text.hpp (1)
TEST(CommandText, ManualPageNamesWhatTheHelpNames) {
  const std::string page = described_as("man");
  for (const char* line :
       {".TH PROG-A 1 \"\" \"prog-a 1.2\" \"User Commands\"\n", "prog\\-a \\- does a thing\n",
        ".SH \"PROG-A MAKE\"\nMakes: it\n", "\\fB\\-\\-level\\fR \\fIhalf|full\\fR\nHow [much]\n",
        "\\fBFILE\\fR\nInput\n", "\n\\&.a line\n\\&\\(aqthat a request\\(aq\nbegins \\e like\n",
        ".SH \"PROG-A MEND\"\nMends it\n"}) {
    EXPECT_NE(page.find(line), std::string::npos) << line << page;
  }
  EXPECT_EQ(page.find("secret"), std::string::npos);
}

// geometry/tables/command_text.hpp (1)
TEST(CommandText, CompletionsNameWhatTheHelpNames) {
  const std::string bash = described_as("bash"), zsh = described_as("zsh");
  for (const char* line : {"'make --level') words='half full' ;;\n",
                           "'make') words='-h --help --level --out --most' ;;\n",
                           "words='make mend' ;;\n", "complete -o default -F _prog_a prog-a\n"}) {
    EXPECT_NE(bash.find(line), std::string::npos) << line << bash;
  }
  for (const char* line :
       {"#compdef prog-a\n", "'make:Makes\\: it'\n",
        "'--level[How \\[much\\]]:half|full:(half full)'", "'--out[Output]:FILE:_files'",
        "'--most[How many]:N: '", "'*:FILE:_files'"}) {
    EXPECT_NE(zsh.find(line), std::string::npos) << line << zsh;
  }
  EXPECT_EQ((bash + zsh).find("secret"), std::string::npos);
}

TEST(CommandText, AFormThatIsNoneIsNamedWithThoseThatAre) {
  const std::string see = " (`prog --help` says what is allowed)\n";
  for (const auto& [arguments, message] :
       std::vector<std::pair<std::vector<const char*>, std::string>>{
           {{"--describe"}, "prog: --describe: man, bash or zsh is missing" + see},
           {{"--describe", "x"}, "prog: --describe: x is none of man, bash and zsh" + see}}) {
    Program program("prog", "A program", "1.2");
    program.subcommand("make", "Makes");
    const Ended ended = run(program, arguments);
    EXPECT_EQ(ended.status, 2);
    EXPECT_EQ(ended.err, message);
  }
}

/// A program that prints through stdio and std::cout, and lets neither know of an error.
int print_to(int standard_output, const char* argument = nullptr) {
  ::dup2(standard_output, STDOUT_FILENO);
  Program program("prog", "A program");
  program.runs([] {
    std::printf("a line\n");
    std::cout << "another\n";
    return 0;
  });
  const std::array<const char*, 2> arguments{"prog", argument};
  return program.run(argument == nullptr ? 1 : 2, arguments.data());
}

// geometry/tables/command_line.hpp (2)
TEST(CommandLineDeathTest, WhatWasPrintedToAFullDiskIsARefusal) {
  for (const char* argument : {static_cast<const char*>(nullptr), "--help"}) {
    EXPECT_EXIT(std::_Exit(print_to(::open("/dev/full", O_WRONLY | O_CLOEXEC), argument)),
                ::testing::ExitedWithCode(2),
                "^<stdout>: cannot be written: No space left on device");
  }
}

// geometry/tables/command_line.hpp (3)
TEST(CommandLineDeathTest, WhatWasPrintedToAReaderThatHasGoneEndsTheProgramLikeSigpipe) {
  const auto print_to_nobody = [] {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) std::_Exit(99);
    ::close(ends[0]);
    return print_to(ends[1]);
  };
  EXPECT_EXIT(std::_Exit(print_to_nobody()), ::testing::KilledBySignal(SIGPIPE), "^$");
}

}  // namespace
}  // namespace tangency::testing
