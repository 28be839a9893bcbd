// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/tests/tool/help_examples.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include <tangency/tests/tool/process.hpp>

namespace tangency::testing {
namespace {

struct Step {
  std::vector<std::string> words;  ///< behind the `$`
  std::string below;
};

std::vector<Step> steps_of(const std::string& help) {
  std::vector<Step> steps;
  std::istringstream lines(help);
  std::string line;
  while (std::getline(lines, line)) {
    const std::size_t start = line.find_first_not_of(' ');
    const std::string text = start == std::string::npos ? "" : line.substr(start);
    if (text.starts_with("$ ")) {
      std::istringstream words(text.substr(2));
      steps.emplace_back();
      for (std::string word; words >> word;) steps.back().words.push_back(word);
    } else if (!steps.empty() && !text.empty()) {
      steps.back().below += text + '\n';
    }
  }
  return steps;
}

}  // namespace

void expect_help_examples(const std::string& subcommand) {
  const Finished help = run_tool({subcommand, "--help"});
  ASSERT_EQ(help.status, 0);
  const TemporaryFolder folder;
  int answered = 0;
  for (const Step& step : steps_of(help.out)) {
    ASSERT_GE(step.words.size(), 2U);
    if (step.words[0] == "cat") {
      folder.write(step.words[1], step.below);
      continue;
    }
    ASSERT_EQ(step.words[0], "tangency");
    std::vector<std::string> arguments(step.words.begin() + 1, step.words.end());
    arguments.back() = folder.path(arguments.back());
    EXPECT_EQ(run_tool(arguments).out, step.below) << subcommand;
    ++answered;
  }
  EXPECT_GE(answered, 1) << subcommand;
}

}  // namespace tangency::testing
