// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/bench/peers/report.hpp>

#include <array>
#include <cstdio>
#include <string_view>

namespace tangency::peers {
namespace {

template <class... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 512> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

std::string_view to_string(GapOf gap_of) {
  switch (gap_of) {
    case GapOf::all:
      return "all";
    case GapOf::overlapping:
      return "overlapping";
    case GapOf::separate:
      return "separate";
    case GapOf::none:
      return "none";
  }
  return "";
}

std::string_view to_string(const PeerDescription& peer) {
  if (peer.gap_of == GapOf::none) return "-";
  return peer.definition == Definition::common_normal ? "common normal" : "last portal";
}

std::string name_of(const PeerDescription& peer) {
  return peer.name + " `" + peer.call + "`, " + peer.options;
}

std::string descriptions(const std::vector<Row>& rows) {
  std::string text =
      "| code | version | call | options | gives a gap of | gap |\n|---|---|---|---|---|---|\n";
  for (const Row& row : rows) {
    if (row.family != rows.front().family) continue;
    const PeerDescription& p = row.peer;
    text += "| " + p.name + " | " + p.version + " | `" + p.call + "` | " + p.options + " | " +
            std::string(to_string(p.gap_of)) + " | " + std::string(to_string(p)) + " |\n";
  }
  return text;
}

/// The rows of one code, one a family.
std::vector<const Row*> rows_of(const std::vector<Row>& rows, const PeerDescription& peer) {
  std::vector<const Row*> same;
  for (const Row& row : rows) {
    if (name_of(row.peer) == name_of(peer)) same.push_back(&row);
  }
  return same;
}

std::string yes_or_no(const std::vector<Row>& rows, double inverse) {
  std::string head = "| code |", rule = "|---|", text;
  for (const Row* row : rows_of(rows, rows.front().peer)) {
    head += " " + row->family + ": wrong | none | ns | / inverse |";
    rule += "---:|---:|---:|---:|";
  }
  for (const Row& first : rows) {
    if (first.family != rows.front().family) continue;
    text += "| " + name_of(first.peer) + " |";
    for (const Row* row : rows_of(rows, first.peer)) {
      text += format(" %zu | %zu%s | %.0f | %.1f |", row->grade.wrong, row->grade.unanswered,
                     row->ended > 0 ? "*" : "", row->time, row->time / inverse);
    }
    text += "\n";
  }
  return head + "\n" + rule + "\n" + text;
}

std::string gaps(const std::vector<Row>& rows, double inverse, Definition definition) {
  std::string text =
      "| family | code | gaps | median | 99 % | largest | `signed_gap` there | ns | / `signed_gap` "
      "| / inverse |\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  for (const Row& row : rows) {
    const verify::ErrorSummary& s = row.grade.gap;
    if (row.peer.gap_of == GapOf::none || row.peer.definition != definition) continue;
    text += "| " + row.family + " | " + name_of(row.peer) +
            format(" | %zu | %.1e | %.1e | %.1e | %.1e | %.0f | %.1f | %.1f |\n", s.count, s.median,
                   s.percentile_99, s.largest, row.ours_there, row.time, row.time / row.signed_gap,
                   row.time / inverse);
  }
  return text;
}

}  // namespace

std::string tables(const std::vector<Row>& rows, double inverse) {
  if (rows.empty()) return {};
  return "### Codes, calls and options\n\n" + descriptions(rows) +
         format(
             "\n### Do the solids overlap?\n\nOf %zu pairs a family; Eigen's inverse took %.2f "
             "ns.\n\n",
             rows.front().grade.pairs, inverse) +
         yes_or_no(rows, inverse) +
         "\n### Gap by the common normal\n\nErrors in the smallest semi-axis of the pair.\n\n" +
         gaps(rows, inverse, Definition::common_normal) +
         "\n### Depth of the last portal\n\nDifferences from the gap by the common normal, of "
         "definition and of accuracy, in the smallest semi-axis of the pair.\n\n" +
         gaps(rows, inverse, Definition::portal);
}

std::string times(const std::vector<Row>& rows) {
  std::string text;
  for (const Row& row : rows)
    text += format("%10.1f ns  ", row.time) + row.family + ": " + name_of(row.peer) + "\n";
  return text;
}

std::string against_simbody(const std::vector<Row>& rows) {
  std::string text;
  const auto line = [&](const Row& simbody, const std::string& ours, double time, double error) {
    text += format(
        "%s: %s %.0f ns, Simbody's ConvexImplicitPair %.0f ns: %.1f x as fast; "
        "largest error %.1e against %.1e\n",
        simbody.family.c_str(), ours.c_str(), time, simbody.time, simbody.time / time, error,
        simbody.grade.gap.largest);
  };
  for (const Row& row : rows) {
    if (row.peer.call != kSimbodyTracker) continue;
    line(row, "signed_gap", row.signed_gap, row.ours_there);
    for (const Row& ours : rows) {
      if (ours.peer.call != kBatchCall || ours.family != row.family) continue;
      line(row, ours.peer.call + ", " + ours.peer.options, ours.time, ours.grade.gap.largest);
    }
  }
  return text;
}

}  // namespace tangency::peers
