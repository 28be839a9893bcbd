// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/verify/grade/outputs.hpp>

namespace tangency::inline v0::verify {
namespace {

constexpr std::size_t kErrorWidth = 9, kRowWidth = 8;

std::string padded(const std::string& text, std::size_t width) {
  return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}

// What is wrong is always counted, and "-" where nothing can be wrong; the rest where it is known.
bool has_column(const Count& count) {
  return !std::string_view(count.title).empty() &&
         (count.is_known || std::string_view(count.title) == "wrong");
}

std::size_t width_of(const Count& count) { return std::string_view(count.title).size() + 2; }

std::string number(const ErrorSummary& s, double ErrorSummary::*which) {
  return padded(s.count > 0 ? shown(s.*which) : "-", kErrorWidth);
}

// Errors are shown of which the whole corpus has some.
std::string line(const FamilyReport& family, const FamilyReport& whole, std::size_t width) {
  std::string text = family.name + std::string(width - family.name.size(), ' ');
  for (const Count& count : family.counts) {
    if (has_column(count)) {
      text += padded(count.is_known ? std::to_string(count.number) : "-", width_of(count));
    }
  }
  for (std::size_t i = 0; i < whole.errors.size(); ++i) {
    if (whole.errors[i].summary.count == 0) continue;
    const ErrorSummary& s = family.errors[i].summary;
    text += "  |" + number(s, &ErrorSummary::median) + number(s, &ErrorSummary::percentile_99) +
            number(s, &ErrorSummary::largest) +
            padded(s.worst_row == kNoRow ? "" : std::to_string(s.worst_row), kRowWidth);
  }
  return text + '\n';
}

std::string heads(const FamilyReport& whole, std::size_t width) {
  std::string counts = "family" + std::string(width - 6, ' ');
  for (const Count& count : whole.counts) {
    if (has_column(count)) counts += padded(count.title, width_of(count));
  }
  std::string titles(counts.size(), ' ');
  for (const Errors& errors : whole.errors) {
    if (errors.summary.count == 0) continue;
    counts += "  |" + padded("median", kErrorWidth) + padded("99 %", kErrorWidth) +
              padded("largest", kErrorWidth) + padded("row", kRowWidth);
    titles += "  | " + std::string(errors.title);
    titles.resize(counts.size(), ' ');
  }
  titles.erase(titles.find_last_not_of(' ') + 1);
  return (titles.empty() ? "" : titles + '\n') + counts + '\n';
}

std::string head(const CorpusReport& corpus) {
  std::string text = corpus.name;
  if (corpus.run) {
    text += ": the tool " + corpus.run->ending + ", " + shown(corpus.run->seconds) + " s";
    if (!corpus.run->last_words.empty()) text += "; its last words: " + corpus.run->last_words;
  }
  return text + '\n';
}

std::string lines_that_cannot_be_read(const CorpusReport& corpus) {
  std::string text;
  for (const std::string& fault : corpus.faults) text += "  " + fault + '\n';
  if (corpus.fault_count > corpus.faults.size()) {
    text += "  and " + std::to_string(corpus.fault_count - corpus.faults.size()) + " more faults\n";
  }
  return text;
}

std::string rows_at_fault(const CorpusReport& corpus, const FamilyReport& family) {
  std::string text;
  for (const RowFault& fault : family.faults) {
    text += "  " + family.name + ": ";
    if (fault.line > 0) text += corpus.file + ':' + std::to_string(fault.line) + ": ";
    text += "row " + std::to_string(fault.row) + ": " + fault.text + '\n';
  }
  if (family.unnamed > 0) {
    text += "  " + family.name + ": and " + std::to_string(family.unnamed) + " more\n";
  }
  return text;
}

}  // namespace

std::string as_table(const CorpusReport& corpus) {
  if (corpus.is_repeated) {
    return corpus.name + ": no answer to " + std::to_string(corpus.whole.rows()) +
           " rows, in the same way\n";
  }
  std::string text = head(corpus);
  if (corpus.is_dead) {
    return text + "  no answer to " + std::to_string(corpus.whole.rows()) + " rows\n" +
           lines_that_cannot_be_read(corpus);
  }
  std::size_t width = 12;
  for (const FamilyReport& family : corpus.families)
    width = std::max(width, family.name.size() + 1);
  text += heads(corpus.whole, width);
  for (const FamilyReport& family : corpus.families) text += line(family, corpus.whole, width);
  if (corpus.families.size() > 1) text += line(corpus.whole, corpus.whole, width);
  text += lines_that_cannot_be_read(corpus);
  for (const FamilyReport& family : corpus.families) text += rows_at_fault(corpus, family);
  return text;
}

}  // namespace tangency::inline v0::verify
