// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/bench/speed_accuracy/format.hpp>
#include <tangency/bench/speed_accuracy/report.hpp>

namespace tangency::speed_accuracy {
namespace {

// The family whose options are shown, and of limited steps those up to where nothing improves.
constexpr std::string_view kShown = "class2";
constexpr int kShownSteps = 3;

std::string largest(const std::optional<Errors>& errors) {
  return errors ? format("%.1e", errors->largest) : "";
}

const Row* find(const std::vector<Row>& rows, const Row& like, const std::string& level) {
  const auto same = [&](const Row& row) {
    return row.family == like.family && row.method == like.method && row.option == like.option &&
           row.steps == like.steps && row.level == level;
  };
  const auto found = std::find_if(rows.begin(), rows.end(), same);
  return found == rows.end() ? nullptr : &*found;
}

std::string name_of(const Row& row) {
  std::string name = "`" + row.method + "`";
  if (!row.option.empty()) name += ", " + row.option;
  if (row.steps) name += format(*row.steps == 1 ? ", %d step" : ", %d steps", *row.steps);
  return name;
}

std::string times(const Row& row) { return format("%.1f (%.1f)", row.ns, row.ns / row.inverse); }

std::string options_table(const std::vector<Row>& rows) {
  const std::vector<std::string> levels = levels_of(rows);
  std::string text = "| call | gap: median | largest | proven | normal, rad | point | single |";
  std::string rule = "\n|---|---:|---:|---:|---:|---:|---:|";
  for (const std::string& level : levels) text += " " + level + " |", rule += "---:|";
  text += rule + "\n";
  for (const Row& row : rows) {
    const bool first = row.level == "single" || row.level == levels.front();
    if (row.family != kShown || !first || row.steps.value_or(0) > kShownSteps) continue;
    const Score& s = row.score;
    text += "| " + name_of(row) + " | " + (s.gap ? format("%.1e", s.gap->median) : "") + " | " +
            largest(s.gap) + " | " + (s.gap_error ? format("%.1e", *s.gap_error) : "") + " | " +
            largest(s.normal) + " | " + largest(s.point) + " | " +
            (row.level == "single" ? times(row) : "") + " |";
    for (const std::string& level : levels) {
      const Row* there = row.level == "single" ? nullptr : find(rows, row, level);
      text += " " + (there ? times(*there) : "") + " |";
    }
    text += "\n";
  }
  return text;
}

/// Time and largest error of a batch option at the best level.
std::string batch_cells(const std::vector<Row>& rows, Row like, const char* option) {
  const std::vector<std::string> levels = levels_of(rows);
  like.method = "signed_gaps";
  like.option = option;
  const Row* row = levels.empty() ? nullptr : find(rows, like, levels.front());
  return row ? format(" %.0f | ", row->ns) + largest(row->score.gap) + " |" : " | |";
}

std::string families_table(const std::vector<Row>& rows) {
  std::string text =
      "| family | `overlaps` | `signed_gap` | largest error | `local` | `signed_gaps`, standard | "
      "largest error | fast | largest error |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  for (const Row& row : rows) {
    if (row.method != "signed_gap") continue;
    Row like = row;
    like.method = "overlaps";
    const Row* yes_or_no = find(rows, like, "single");
    text += "| " + row.family + " | " + (yes_or_no ? format("%.0f", yes_or_no->ns) : "") + " | " +
            format("%.0f", row.ns) + " | " + largest(row.score.gap) + " | " +
            format("%zu", row.score.local) + " |" + batch_cells(rows, row, "standard") +
            batch_cells(rows, row, "fast") + "\n";
  }
  return text;
}

bool same_way(const AheadRow& a, const AheadRow& b) {
  return a.family == b.family && a.method == b.method && a.level == b.level;
}

std::string ahead_table(const std::vector<AheadRow>& rows) {
  std::string text = "| contact by | family |", rule = "\n|---|---|";
  for (const AheadRow& row : rows) {
    if (same_way(row, rows.front())) text += format(" %d %% |", row.touching), rule += "---:|";
  }
  text += rule;
  for (const AheadRow& row : rows) {
    const auto first = std::find_if(rows.begin(), rows.end(),
                                    [&](const AheadRow& other) { return same_way(row, other); });
    if (&*first != &row) continue;
    text += "\n| `" + row.method + "`, " + row.level + " | " + row.family + " |";
    for (const AheadRow& other : rows) {
      if (same_way(row, other)) text += format(" %.2f |", other.ns_ahead / other.ns_all);
    }
  }
  return text + "\n";
}

}  // namespace

std::string to_markdown(const std::vector<Row>& rows, const std::vector<AheadRow>& ahead) {
  if (rows.empty()) return {};
  std::string text = format(
      "### Calls and options, %s\n\nErrors in the smallest semi-axis of the pair; ns a pair, in "
      "brackets over those of Eigen's 3x3 inverse (%.2f ns). Of %zu pairs.\n\n",
      std::string(kShown).c_str(), rows.front().inverse, rows.front().score.pairs);
  text += options_table(rows) +
          "\n### Families\n\nns a pair; of the batch calls at the best instruction set.\n\n" +
          families_table(rows);
  if (!ahead.empty()) {
    text +=
        "\n### Yes or no first\n\nTime of `overlaps` for all listed pairs and the contact of those "
        "that overlap, over that of the contact for all pairs, by the share of pairs that "
        "touch.\n\n" +
        ahead_table(ahead);
  }
  return text;
}

}  // namespace tangency::speed_accuracy
