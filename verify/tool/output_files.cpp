// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/tool/output_files.hpp>

#include <charconv>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string_view>
#include <system_error>

#include <tangency/verify/grade/outputs.hpp>

namespace tangency::inline v0::verify {
namespace {

struct Output {
  const char *option, *help;
  std::string (*text)(const GradeReport& report);
};

constexpr std::array kOutputs{
    Output{"--json", "Also write the grade as an array of {name, unit, value}", as_json},
    Output{"--json-summary",
           "The same with at most 40 values, errors in digits lost, for charts and their alerts",
           as_json_summary},
    Output{"--junit", "Also write it as JUnit's XML, a test case a family", as_junit},
    Output{"--sarif", "Also write it as SARIF 2.1.0, a result a row at fault", as_sarif},
    Output{"--summary-md", "Also write it as Markdown, for the summary of a step on GitHub",
           as_markdown},
    Output{"--html", "Also write it as a page with plots", as_page}};

static_assert(kOutputs.size() == kOutputForms);

// How to look at the first row that is at fault.
std::string hint(const GradeReport& report, const std::string& corpora) {
  for (const CorpusReport& corpus : report.corpora) {
    for (const FamilyReport& family : corpus.families) {
      if (!family.has_failed || family.faults.empty()) continue;
      return "to look at a row: tangency-verify show " + corpus.name + ' ' +
             std::to_string(family.faults.front().row) +
             (corpora.empty() ? "" : " --corpora " + corpora) + '\n';
    }
  }
  return {};
}

std::filesystem::path normal(const std::string& path) {
  return std::filesystem::absolute(path).lexically_normal();
}

}  // namespace

void add_output_options(tables::Command& command, OutputPaths& paths) {
  for (std::size_t i = 0; i < kOutputs.size(); ++i) {
    command.option(kOutputs[i].option, paths[i], kOutputs[i].help).not_empty().type_name("FILE");
  }
}

OutputFiles::OutputFiles(const OutputPaths& paths) {
  for (std::size_t i = 0; i < kOutputForms; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (paths[i].empty() || paths[k].empty() || normal(paths[i]) != normal(paths[k])) continue;
      throw tables::Error({.file = kOutputs[i].option,
                           .rule = paths[i] + " is the file of " + kOutputs[k].option +
                                   " too; each needs one of its own"});
    }
    if (!paths[i].empty()) files_[i] = std::make_unique<tables::OutputFile>(paths[i]);
  }
}

void OutputFiles::write(const GradeReport& report) {
  for (std::size_t i = 0; i < kOutputForms; ++i) {
    if (!files_[i]) continue;
    files_[i]->write(kOutputs[i].text(report));
    files_[i]->commit();
  }
}

std::string date_of_outputs() {
  std::time_t moment = std::time(nullptr);
  if (const char* given = std::getenv("SOURCE_DATE_EPOCH")) {
    const std::string text = given;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), moment);
    constexpr std::time_t kEndOfYear9999 = 253402300799;
    if (problem != std::errc() || end != text.data() + text.size() || moment < 0 ||
        moment > kEndOfYear9999) {
      throw tables::Error(
          {.file = "SOURCE_DATE_EPOCH", .rule = text + " is not a number of seconds since 1970"});
    }
  }
  std::tm parts{};
  ::gmtime_r(&moment, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &parts);
  return text.data();
}

std::string closing_of(const GradeReport& report, const std::string& corpora) {
  std::string text;
  for (const std::string& confusion : commonest_confusions(report))
    text += "wrong answers: " + confusion + '\n';
  for (const Reason& reason : report.reasons) text += "FAILED " + reason.text + '\n';
  if (!report.has_passed()) text += hint(report, corpora);
  const char* runner = std::getenv("GITHUB_ACTIONS");
  if (runner && std::string_view(runner) == "true") text += as_annotations(report);
  return text + report.verdict + '\n';
}

}  // namespace tangency::inline v0::verify
