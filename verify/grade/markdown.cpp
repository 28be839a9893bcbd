// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstddef>
#include <string>
#include <string_view>

#include <tangency/verify/grade/markup.hpp>
#include <tangency/verify/grade/outputs.hpp>

namespace tangency::inline v0::verify {
namespace {

// Chosen: GitHub shows a summary of a mebibyte at most.
constexpr std::size_t kMostRows = 200;

// Text of any origin in a cell or a paragraph, to the letter.
std::string plain(std::string_view text) {
  std::string safe;
  for (const char c : escaped(text)) {
    if (c == '\n') {
      safe += ' ';
      continue;
    }
    if (std::string_view("\\`*_[]#+!|~").find(c) != std::string_view::npos) safe += '\\';
    safe += c;
  }
  return safe;
}

std::string head(const FamilyReport& columns, const char* first) {
  std::string text = '|' + std::string(first) + '|', rule = "|---|";
  for (const Count& count : columns.counts) {
    if (!count.is_known || std::string_view(count.title).empty()) continue;
    text += plain(count.title) + '|';
    rule += "--:|";
  }
  for (const Errors& errors : columns.errors) {
    if (errors.summary.count == 0) continue;
    text += "largest " + plain(errors.title) + '|';
    rule += "--:|";
  }
  return text + '\n' + rule + '\n';
}

std::string line(const FamilyReport& family, const FamilyReport& columns, const std::string& name) {
  std::string text = '|' + name + '|';
  for (std::size_t i = 0; i < columns.counts.size(); ++i) {
    const Count& count = family.counts[i];
    if (!columns.counts[i].is_known || std::string_view(count.title).empty()) continue;
    const bool is_bad = count.kind == Count::Kind::fault && count.is_known && count.number > 0;
    const std::string number = count.is_known ? std::to_string(count.number) : "-";
    text += (is_bad ? "**" + number + "**" : number) + '|';
  }
  for (const Errors& errors : columns.errors) {
    if (errors.summary.count == 0) continue;
    const ErrorSummary* summary = nullptr;
    for (const Errors& one : family.errors) {
      if (std::string_view(one.title) == errors.title) summary = &one.summary;
    }
    text += (summary && summary->count > 0 ? shown(summary->largest) : "-") + '|';
  }
  return text + '\n';
}

std::string rows_at_fault(const GradeReport& report) {
  std::string text;
  std::size_t shown_rows = 0, left_out = 0;
  for (const CorpusReport& corpus : report.corpora) {
    for (const FamilyReport& family : corpus.families) {
      left_out += family.unnamed;
      for (const RowFault& fault : family.faults) {
        if (++shown_rows > kMostRows) {
          ++left_out;
          continue;
        }
        text += '|' + plain(corpus.name) + '|' + plain(family.name) + '|' +
                std::to_string(fault.row) + '|' +
                (fault.line > 0 ? std::to_string(fault.line) : "") + '|' + plain(fault.text) +
                "|\n";
      }
    }
  }
  if (text.empty()) return {};
  return "\n<details><summary>Rows at fault</summary>\n\n|corpus|family|row|line|what|\n"
         "|---|---|--:|--:|---|\n" +
         text + (left_out > 0 ? "\nand " + std::to_string(left_out) + " more\n" : "") +
         "\n</details>\n";
}

}  // namespace

std::string as_markdown(const GradeReport& report) {
  std::string text =
      "### Contact accuracy: " + std::string(report.has_passed() ? "passed" : "FAILED") + "\n\n" +
      plain(report.verdict) + "\n\n";
  for (const Reason& reason : report.reasons) text += "- " + plain(reason.text) + '\n';
  for (const std::string& confusion : commonest_confusions(report)) {
    text += "- " + plain(confusion) + '\n';
  }
  const FamilyReport sum = total(report);
  text += '\n' + head(sum, "corpus");
  for (const CorpusReport& corpus : report.corpora) {
    text += line(corpus.whole, sum, plain(corpus.name));
  }
  text += rows_at_fault(report) +
          "\n<details><summary>How it was graded</summary>\n\n"
          "|what|value|\n|---|---|\n";
  for (const auto& [name, value] : report.facts) {
    text += '|' + plain(name) + '|' + plain(value) + "|\n";
  }
  return text + "\n</details>\n";
}

}  // namespace tangency::inline v0::verify
