// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/hunt/tool_subject.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include <tangency/geometry/tables/csv.hpp>
#include <tangency/verify/answers/truth_table.hpp>
#include <tangency/verify/corpus/corpus.hpp>

namespace tangency::inline v0::verify {
namespace {

using tables::Column;
using tables::RowCursor;

std::string table_of(std::span<const EllipsoidPair> pairs) {
  std::string text = std::string(pair_columns()) + '\n';
  for (const EllipsoidPair& pair : pairs) text += pair_cells(pair) + '\n';
  return text;
}

// A number that is there, if it is one; a text that is none makes the answer unreadable.
std::optional<double> number(const RowCursor& row, const std::optional<Column>& column,
                             Answer& said) {
  if (!column || row.text(*column).empty()) return std::nullopt;
  double value = 0;
  if (!tables::parse_number(row.text(*column), value)) return value;
  said.unreadable = true;
  return std::nullopt;
}

struct Columns {
  std::optional<Column> relation, overlaps, gap, gap_error, status;
  std::array<std::optional<Column>, 3> normal;

  explicit Columns(const tables::Header& header)
      : relation(header.find("relation")),
        overlaps(header.find("overlaps")),
        gap(header.find("gap")),
        gap_error(header.find("gap_error")),
        status(header.find("status")),
        normal{header.find("nx"), header.find("ny"), header.find("nz")} {}

  Answer answer(const RowCursor& row) const {
    Answer said;
    if (relation && !row.text(*relation).empty()) {
      said.relation = relation_named(row.text(*relation));
      said.unreadable = !said.relation;
    }
    if (overlaps && !row.text(*overlaps).empty()) {
      const std::string_view text = row.text(*overlaps);
      if (text == "0" || text == "1") said.overlaps = text == "1";
      said.unreadable = said.unreadable || !said.overlaps;
    }
    said.gap = number(row, gap, said);
    said.gap_error = number(row, gap_error, said);
    said.is_local = status && row.text(*status) == "local";
    std::array<double, 3> n{};
    bool whole = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto component = number(row, normal[k], said);
      whole = whole && component;
      n[k] = component.value_or(0);
    }
    if (whole) said.normal = n;
    return said;
  }
};

bool says_something(const Answer& answer) {
  return answer.relation || answer.overlaps || answer.gap || answer.normal || answer.unreadable;
}

}  // namespace

// What is wrong with the table; the rows before that are answers all the same.
std::string ToolSubject::read_table(const std::string& text, Answers& answers) {
  try {
    tables::Reader reader(tables::NamedText{"what it printed", text});
    const Columns columns(reader.header());
    const Column place = reader.header().require("row");
    header_ = true;
    words_ = columns.relation || columns.overlaps;
    gaps_ = columns.gap.has_value();
    bounds_ = columns.gap && columns.gap_error;
    normals_ = std::ranges::all_of(columns.normal, [](const auto& c) { return c.has_value(); });
    tables::for_each_row(reader, [&](const RowCursor& row) {
      double index = -1;
      const bool bad = tables::parse_number(row.text(place), index).has_value();
      if (bad || !(index >= 0 && index < static_cast<double>(answers.size())) ||
          index != std::floor(index)) {
        return;
      }
      auto& answer = answers[static_cast<std::size_t>(index)];
      if (answer) return;  // of a row answered twice the first counts
      if (const Answer said = columns.answer(row); says_something(said)) answer = said;
    });
  } catch (const tables::Error& error) {
    return error.what();
  }
  return {};
}

void ToolSubject::read(const ToolRun& run, std::size_t count, Answers& answers) {
  Answers said(count);
  const std::string problem = read_table(run.output, said);
  const auto some = static_cast<std::size_t>(
      std::ranges::count_if(said, [](const auto& answer) { return answer.has_value(); }));
  answered_ += some;
  if (!problem.empty() || some == 0) {
    trouble_ = "the tool " + run.ending + (some == 0 ? " without an answer" : "");
    for (const std::string& more : {problem, run.last_words}) {
      if (!more.empty()) trouble_ += ": " + more;
    }
  }
  std::ranges::move(said, std::back_inserter(answers));
}

double ToolSubject::time_left() const {
  return std::chrono::duration<double>(end_ - std::chrono::steady_clock::now()).count();
}

void ToolSubject::ask(std::span<const EllipsoidPair> pairs, Answers& answers) {
  if (has_to_end()) return;
  // As `grade` allows: ten times the longest answer, and a screen of messages.
  const std::size_t most_bytes = (std::size_t{1} << 16) + 4096 * pairs.size();
  ++starts_;
  const double left = std::max(time_left(), 0.0);
  const ToolRun run = run_tool(command_, table_of(pairs), {std::min(seconds_, left), most_bytes});
  // A run that the hunt's own end has cut says nothing of the tool.
  if (*stopped_ || (!run.sound && has_to_end())) return;
  if (!run.sound) {
    trouble_ = "the tool " + run.ending + (run.last_words.empty() ? "" : ": " + run.last_words);
    if (pairs.size() > 1) {
      const std::size_t half = pairs.size() / 2, before = answers.size();
      ask(pairs.first(half), answers);
      if (answers.size() == before + half) ask(pairs.subspan(half), answers);
      return;
    }
    answers.emplace_back();
    return;
  }
  read(run, pairs.size(), answers);
  // Chosen: between a tenth of a second and two a batch.
  if (run.seconds < 0.1) batch_ = std::min<std::size_t>(2 * batch_, 4096);
  if (run.seconds > 2) batch_ = std::max<std::size_t>(batch_ / 2, 1);
}

Answers ToolSubject::answers(std::span<const EllipsoidPair> pairs) {
  Answers answers;
  while (answers.size() < pairs.size()) {
    const std::size_t before = answers.size();
    const std::size_t count = std::min(batch_, pairs.size() - before);
    ask(pairs.subspan(before, count), answers);
    if (answers.size() < before + count) break;
  }
  return answers;
}

}  // namespace tangency::inline v0::verify
