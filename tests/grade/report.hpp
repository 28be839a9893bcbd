// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Runs `tangency-verify grade` and reads what it says.
#pragma once

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <vector>

#include <tangency/tests/tool/process.hpp>

namespace tangency::testing {

inline const std::string kKernel = TANGENCY_CONTACT " contact";

/// What `grade` said, and the values of its JSON by name.
struct Report {
  Finished run;
  nlohmann::json values;

  double value(const std::string& name) const {
    for (const auto& entry : values) {
      if (entry.at("name") == name) return entry.at("value").get<double>();
    }
    ADD_FAILURE() << "no value " << name << " in\n" << run.out << run.err;
    return -1;
  }
  bool says(const std::string& text) const { return run.out.find(text) != std::string::npos; }
};

inline Report grade(std::vector<std::string> arguments) {
  const TemporaryFolder folder;
  const std::string json = folder.path("grade.json");
  arguments.insert(arguments.begin(), "grade");
  arguments.insert(arguments.end(), {"--json", json});
  Report report{run_tool(arguments), {}};
  const std::string text = read_file(json);
  if (!text.empty()) report.values = nlohmann::json::parse(text);
  return report;
}

inline Report grade_tool(const std::string& command, const std::string& corpus,
                         std::vector<std::string> more = {}) {
  more.insert(more.end(), {"--tool", command, "--corpus", corpus});
  return grade(std::move(more));
}

/// The kernel's answers, changed by an awk program. Columns: 1 row, 2 relation, 3 gap, 4-6 normal.
inline std::string changed(const std::string& program) {
  return kKernel + " | awk -F, -v OFS=, '" + program + "'";
}

}  // namespace tangency::testing
