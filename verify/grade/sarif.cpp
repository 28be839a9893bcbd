// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <utility>

#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/verify/grade/outputs.hpp>

namespace tangency::inline v0::verify {
namespace {

using Json = nlohmann::ordered_json;

struct Rule {
  Problem problem;
  const char* text;
};

constexpr std::array kRules{
    Rule{Problem::wrong, "The answer differs from the exact truth."},
    Rule{Problem::missing, "An answer that was asked for is not there, or cannot be read."},
    Rule{Problem::broken_bound, "The error is larger than the bound that was claimed for it."},
    Rule{Problem::reversed, "The normal is more than a right angle from every true one."},
    Rule{Problem::gap_error, "The error of the gap is above the threshold."},
    Rule{Problem::normal_error, "The error of the normal is above the threshold."}};
constexpr const char* kOtherRule = "grade";

// A path as a reference of a URI: other bytes than its own letters as %XX.
std::string reference(const std::string& path) {
  std::string text = path.starts_with('/') ? "file://" : "";
  for (const char c : path) {
    const bool is_plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
                          (c >= 'A' && c <= 'Z') ||
                          std::string_view("/-_.~").find(c) != std::string_view::npos;
    text += is_plain
                ? std::string(1, c)
                : tables::formatted("%%%02X", static_cast<unsigned>(static_cast<unsigned char>(c)));
  }
  return text;
}

Json rules() {
  Json list = Json::array();
  for (const Rule& rule : kRules) {
    list.push_back({{"id", to_string(rule.problem)}, {"shortDescription", {{"text", rule.text}}}});
  }
  list.push_back({{"id", kOtherRule},
                  {"shortDescription", {{"text", "The tool, its lines or its baseline fail."}}}});
  return list;
}

Json result(const CorpusReport& corpus, const FamilyReport& family, const RowFault& fault) {
  const std::string row = corpus.name + " row " + std::to_string(fault.row);
  Json place{{"artifactLocation", {{"uri", reference(corpus.file)}}}};
  if (fault.line > 0) place["region"] = {{"startLine", fault.line}};
  return {{"ruleId", to_string(fault.problem)},
          {"ruleIndex", static_cast<std::size_t>(fault.problem)},
          {"level", family.has_failed ? "error" : "note"},
          {"message", {{"text", row + " (" + family.name + "): " + fault.text}}},
          {"locations", Json::array({{{"physicalLocation", std::move(place)}}})},
          {"partialFingerprints",
           {{"row/v1",
             corpus.name + '/' + std::to_string(fault.row) + '/' + to_string(fault.problem)}}}};
}

Json results(const GradeReport& report) {
  Json list = Json::array();
  for (const Reason& reason : report.reasons) {
    if (reason.is_about_rows) continue;
    list.push_back({{"ruleId", kOtherRule},
                    {"ruleIndex", kRules.size()},
                    {"level", "error"},
                    {"message", {{"text", reason.text}}}});
  }
  for (const CorpusReport& corpus : report.corpora) {
    for (const FamilyReport& family : corpus.families) {
      for (const RowFault& fault : family.faults) list.push_back(result(corpus, family, fault));
    }
  }
  return list;
}

}  // namespace

std::string as_sarif(const GradeReport& report) {
  Json facts;
  for (const auto& [name, value] : report.facts) facts[name] = value;
  facts["verdict"] = report.verdict;
  const Json driver{
      {"name", "tangency-verify"}, {"version", report.program_version}, {"rules", rules()}};
  const Json run{{"tool", {{"driver", driver}}},
                 {"invocations", Json::array({{{"executionSuccessful", true},
                                               {"exitCode", report.has_passed() ? 0 : 1},
                                               {"endTimeUtc", report.date + 'Z'}}})},
                 {"results", results(report)},
                 {"properties", facts}};
  const Json log{{"version", "2.1.0"}, {"runs", Json::array({run})}};
  return log.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace tangency::inline v0::verify
