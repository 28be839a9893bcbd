// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tangency/verify/grade/outputs.hpp>

namespace tangency::inline v0::verify {
namespace {

constexpr std::size_t kMost = 10;  // GitHub shows no more errors of a step

// As the runner reads them back: % first of all, and of properties also what ends them.
std::string escaped_command(std::string_view text, bool is_property) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '%':
        safe += "%25";
        break;
      case '\r':
        safe += "%0D";
        break;
      case '\n':
        safe += "%0A";
        break;
      case ':':
        safe += is_property ? "%3A" : ":";
        break;
      case ',':
        safe += is_property ? "%2C" : ",";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

std::string error(const std::string& properties, std::string_view title, std::string_view text) {
  return "::error " + properties + "title=" + escaped_command(title, true) +
         "::" + escaped_command(text, false) + '\n';
}

std::string error_of_row(const CorpusReport& corpus, const FamilyReport& family,
                         const RowFault& fault) {
  std::string properties;
  if (!corpus.file.empty()) properties += "file=" + escaped_command(corpus.file, true) + ',';
  if (fault.line > 0) properties += "line=" + std::to_string(fault.line) + ',';
  return error(properties, corpus.name + " row " + std::to_string(fault.row),
               fault.text + " (family " + family.name + ')');
}

// The first of every list, then the second of every list, and so on.
std::vector<std::string> in_turn(const std::vector<std::vector<std::string>>& lists) {
  std::vector<std::string> all;
  bool is_any_left = true;
  for (std::size_t turn = 0; is_any_left; ++turn) {
    is_any_left = false;
    for (const auto& list : lists) {
      if (turn >= list.size()) continue;
      is_any_left = true;
      all.push_back(list[turn]);
    }
  }
  return all;
}

std::vector<std::string> errors_of(const CorpusReport& corpus) {
  std::vector<std::vector<std::string>> families;
  for (const FamilyReport& family : corpus.families) {
    if (!family.has_failed) continue;
    auto& errors = families.emplace_back();
    for (const RowFault& fault : family.faults) {
      errors.push_back(error_of_row(corpus, family, fault));
    }
  }
  return in_turn(families);
}

}  // namespace

std::string as_annotations(const GradeReport& report) {
  std::vector<std::string> errors;
  for (const Reason& reason : report.reasons) {
    if (!reason.is_about_rows) errors.push_back(error("", "grade", reason.text));
  }
  std::vector<std::vector<std::string>> corpora;
  for (const CorpusReport& corpus : report.corpora) corpora.push_back(errors_of(corpus));
  for (std::string& one : in_turn(corpora)) errors.push_back(std::move(one));
  std::string text;
  for (std::size_t i = 0; i < std::min(errors.size(), kMost); ++i) text += errors[i];
  return text;
}

}  // namespace tangency::inline v0::verify
