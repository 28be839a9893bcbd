// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/verify/grade/markup.hpp>
#include <tangency/verify/grade/outputs.hpp>

namespace tangency::inline v0::verify {
namespace {

struct Case {
  std::string name, failure_type{}, message{}, text{};  // no type: it has passed
  bool is_skipped = false;                              // none of its rows was judged
};

struct Suite {
  std::string name;
  double seconds;
  std::vector<Case> cases;
  std::string words{};  // what the tool said
};

std::string attribute(const char* name, std::string_view value) {
  return ' ' + std::string(name) + "=\"" + escaped(value) + '"';
}

std::string seconds(double value) { return tables::formatted("%.3f", value); }

// Counts and errors, as one line.
std::string summary(const FamilyReport& family) {
  std::string text;
  for (const Count& count : family.counts) {
    if (!count.is_known || std::string_view(count.title).empty()) continue;
    if (!text.empty()) text += ", ";
    text += std::to_string(count.number) + ' ' + count.title;
  }
  for (const Errors& errors : family.errors) {
    if (errors.summary.count == 0) continue;
    text += std::string(", largest ") + errors.title + ' ' + shown(errors.summary.largest);
  }
  return text;
}

std::string rows_at_fault(const CorpusReport& corpus, const FamilyReport& family) {
  std::string text;
  for (const RowFault& fault : family.faults) {
    if (fault.line > 0) text += corpus.file + ':' + std::to_string(fault.line) + ": ";
    text += "row " + std::to_string(fault.row) + ": " + fault.text + '\n';
  }
  if (family.unnamed > 0) text += "and " + std::to_string(family.unnamed) + " more\n";
  return text;
}

Suite suite_of(const CorpusReport& corpus) {
  Suite suite{corpus.name, corpus.run ? corpus.run->seconds : 0, {}};
  if (corpus.run) suite.words = corpus.run->last_words;
  for (const FamilyReport& family : corpus.families) {
    Case one{family.name};
    if (family.rows() == 0) {
      one.is_skipped = true;
      one.message = summary(family);
    } else if (family.has_failed) {
      one.failure_type =
          family.faults.empty() ? "failed" : to_string(family.faults.front().problem);
      one.message = summary(family);
      one.text = rows_at_fault(corpus, family);
    }
    suite.cases.push_back(std::move(one));
  }
  return suite;
}

// What is about no row: it fails as one.
Suite suite_of_the_rest(const GradeReport& report) {
  Case one{"tool and answers"};
  for (const Reason& reason : report.reasons) {
    if (reason.is_about_rows) continue;
    if (one.failure_type.empty()) {
      one.failure_type = "failed";
      one.message = reason.text;
    }
    one.text += reason.text + '\n';
  }
  return {"grade", 0, {one}, report.verdict};
}

std::string xml(const Case& one, const std::string& suite) {
  std::string text = "    <testcase" + attribute("name", one.name) + attribute("classname", suite) +
                     attribute("time", seconds(0));
  if (one.is_skipped) {
    return text + "><skipped" + attribute("message", one.message) + "/></testcase>\n";
  }
  if (one.failure_type.empty()) return text + "/>\n";
  return text + ">\n      <failure" + attribute("message", one.message) +
         attribute("type", one.failure_type) + ">" + escaped(one.text) +
         "</failure>\n    </testcase>\n";
}

std::string xml(const Suite& suite, std::size_t id, const GradeReport& report) {
  const auto failures =
      std::ranges::count_if(suite.cases, [](const Case& one) { return !one.failure_type.empty(); });
  const auto skipped = std::ranges::count_if(suite.cases, &Case::is_skipped);
  std::string text = "  <testsuite" + attribute("package", "tangency-verify") +
                     attribute("id", std::to_string(id)) + attribute("name", suite.name) +
                     attribute("timestamp", report.date) + attribute("hostname", "localhost") +
                     attribute("tests", std::to_string(suite.cases.size())) +
                     attribute("failures", std::to_string(failures)) + attribute("errors", "0") +
                     attribute("skipped", std::to_string(skipped)) +
                     attribute("time", seconds(suite.seconds)) + ">\n    <properties>\n";
  for (const auto& [name, value] : report.facts) {
    text += "      <property" + attribute("name", name) + attribute("value", value) + "/>\n";
  }
  text += "    </properties>\n";
  for (const Case& one : suite.cases) text += xml(one, suite.name);
  return text + "    <system-out>" + escaped(suite.words) +
         "</system-out>\n    <system-err></system-err>\n  </testsuite>\n";
}

}  // namespace

std::string as_junit(const GradeReport& report) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
  std::size_t id = 0;
  text += xml(suite_of_the_rest(report), id++, report);
  for (const CorpusReport& corpus : report.corpora) text += xml(suite_of(corpus), id++, report);
  return text + "</testsuites>\n";
}

}  // namespace tangency::inline v0::verify
