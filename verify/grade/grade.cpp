// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/grade/grade.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include <tangency/verify/grade/judge.hpp>

namespace tangency::inline v0::verify {
namespace {

using tables::Column;
using tables::RowCursor;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
// Chosen: enough to see what is going on.
constexpr std::size_t kMostNamedFaults = 10;

struct Verdict {
  bool seen = false, missing = false, wrong = false, touch = false, broken = false,
       reversed = false;
  double gap = kNone, normal = kNone, area = kNone;
};

// The answers' columns, of one header.
struct Columns {
  std::optional<Column> relation, overlaps, gap, gap_error, status, crossings, area, type;
  std::optional<Column> normal_x, normal_y, normal_z;  // all, or x and y of ellipses, or none
  bool part_of_a_normal = false;

  Columns(const tables::Header& header, const TruthTable& truth) {
    const CorpusKind kind = truth.kind;
    if (kind == CorpusKind::quadrics) {
      type = header.find("type");
      return;
    }
    relation = header.find("relation");
    overlaps = header.find("overlaps");
    gap = header.find("gap");
    if (gap) gap_error = header.find("gap_error"), status = header.find("status");
    if (kind == CorpusKind::ellipses) {
      crossings = header.find("crossings");
      area = header.find("area");
    }
    const bool plane = kind == CorpusKind::ellipses;
    const auto x = header.find("nx"), y = header.find("ny"), z = header.find("nz");
    if (!truth.has_normals || !(x || y || (z && !plane))) return;
    part_of_a_normal = !x || !y || !(z || plane);
    if (part_of_a_normal) return;
    normal_x = x, normal_y = y;
    if (!plane) normal_z = z;
  }
  bool normal() const { return normal_x.has_value(); }
  bool words() const { return relation || overlaps || crossings || type; }
};

class Grader {
 public:
  Grader(const TruthTable& truth, const Demands& demands)
      : truth_(truth), demands_(demands), verdicts_(truth.rows.size()) {}

  void read(tables::Reader&& reader) {
    const Columns columns(reader.header(), truth_);
    result_.judges_words = columns.words();
    result_.judges_gaps = columns.gap.has_value();
    result_.judges_normals = columns.normal();
    result_.claims_bounds = columns.gap_error.has_value();
    const Column number = reader.header().require("row");
    offered_ = columns.words() || columns.gap || columns.normal() || columns.area;
    if (!offered_) fault("the header names no column that is graded");
    if (columns.part_of_a_normal) fault("the header names a part of a normal; all of it is graded");
    tables::Block block;
    RowCursor line(reader.header());
    while (reader.read(block)) {
      line.enter(block);
      while (next(line)) take(line, number, columns);
      row_ = kNoRow;
    }
  }

  // What ends the reading: no header, or a line beyond all lines.
  void end_by(const tables::Error& error) {
    fault(error, error.fault().line > 1 ? "; what follows is not read" : "");
  }

  // By row and line, without the name of the file, which may be no more than a number.
  void fault(const tables::Error& error, const std::string& consequence = "") {
    const tables::Fault& where = error.fault();
    std::string text = std::string(error.what()).substr(where.file.size());
    text = where.line > 0 ? "line " + text.substr(1) : text.substr(2);
    fault((row_ == kNoRow ? "" : "row " + std::to_string(row_) + ", ") + text + consequence);
  }

  Grade result() {
    summarise();
    return std::move(result_);
  }

 private:
  void fault(const std::string& what) {
    if (result_.fault_count++ < kMostNamedFaults) result_.faults.push_back(what);
  }

  // False at the end; lines of a wrong length are faults.
  bool next(RowCursor& line) {
    for (;;) {
      try {
        return line.next();
      } catch (const tables::Error& error) {
        row_ = kNoRow;
        fault(error);
      }
    }
  }

  // The number in a cell. Nothing, and the row is missing, where there is none.
  std::optional<double> number(const RowCursor& line, Column column, Verdict& verdict) {
    if (!line.text(column).empty()) {
      try {
        return line.number(column);
      } catch (const tables::Error& error) {
        fault(error);
      }
    }
    verdict.missing = true;
    return std::nullopt;
  }

  std::string_view word(const RowCursor& line, Column column, Verdict& verdict) {
    const std::string_view text = line.text(column);
    if (text.empty()) verdict.missing = true;
    return text;
  }

  void take(const RowCursor& line, Column number_column, const Columns& columns) {
    row_ = kNoRow;
    double index = 0;
    try {
      index = line.number(number_column);
    } catch (const tables::Error& error) {
      return fault(error);
    }
    if (!(index >= 0 && index < static_cast<double>(verdicts_.size())) ||
        index != std::floor(index)) {
      return fault(line.error(
          number_column, "the corpus has the rows 0 to " + std::to_string(verdicts_.size() - 1)));
    }
    const auto i = static_cast<std::size_t>(index);
    Verdict& verdict = verdicts_[i];
    if (verdict.seen) return fault(line.error(number_column, "this row is answered again"));
    verdict.seen = true;
    row_ = i;
    judge_words(line, columns, truth_.rows[i], verdict);
    judge_numbers(line, columns, truth_.rows[i], verdict);
    verdict.missing = verdict.missing || !offered_ || (demands_.words && !columns.words()) ||
                      (demands_.gap && !columns.gap && truth_.rows[i].gap) ||
                      (demands_.normal && !columns.normal() && truth_.rows[i].gap);
  }

  void judge_words(const RowCursor& line, const Columns& columns, const TruthRow& row,
                   Verdict& verdict) {
    if (columns.relation) {
      if (const auto text = word(line, *columns.relation, verdict); !text.empty()) {
        const auto relation = relation_named(text);
        if (!relation) {
          verdict.missing = true;
          fault(line.error(*columns.relation, "this is not a relation"));
        } else {
          verdict.wrong |= *relation != row.relation;
        }
      }
    }
    if (columns.overlaps) judge_overlaps(line, *columns.overlaps, row, verdict);
    if (columns.crossings) judge_crossings(line, *columns.crossings, row, verdict);
    if (columns.type) {
      const auto text = word(line, *columns.type, verdict);
      verdict.wrong |= !text.empty() && text != row.type;
    }
  }

  void judge_overlaps(const RowCursor& line, Column column, const TruthRow& row, Verdict& verdict) {
    const auto text = word(line, column, verdict);
    if (text.empty()) return;
    if (text != "0" && text != "1") {
      verdict.missing = true;
      return fault(line.error(column, "this is neither 0 nor 1"));
    }
    const bool yes = text == "1";
    verdict.touch = yes && row.relation == Relation::external_touch;
    verdict.wrong |= !verdict.touch && yes != interiors_meet(row.relation);
  }

  void judge_crossings(const RowCursor& line, Column column, const TruthRow& row,
                       Verdict& verdict) {
    const bool empty = line.text(column).empty();
    if (row.crossings < 0) {
      verdict.wrong |= !empty;
    } else if (const auto count = number(line, column, verdict)) {
      verdict.wrong |= *count != row.crossings;
    }
  }

  void judge_numbers(const RowCursor& line, const Columns& columns, const TruthRow& row,
                     Verdict& verdict) {
    if (columns.area) {
      if (const auto area = number(line, *columns.area, verdict)) {
        verdict.area = std::abs(*area - row.area) / row.smaller_area;
      }
    }
    if (!row.gap) return;  // the definition says nothing of this row
    if (columns.gap) {
      if (const auto gap = number(line, *columns.gap, verdict)) {
        const double off = excess(*gap, *row.gap);
        verdict.gap = std::abs(off) / row.size;
        if (columns.gap_error && !line.text(*columns.gap_error).empty()) {
          const auto bound = number(line, *columns.gap_error, verdict);
          const bool local = columns.status && line.text(*columns.status) == "local";
          verdict.broken = bound && breaks_bound(off, *bound, local);
        }
      }
    }
    if (columns.normal()) judge_normals(line, columns, row, verdict);
  }

  void judge_normals(const RowCursor& line, const Columns& columns, const TruthRow& row,
                     Verdict& verdict) {
    std::array<double, 3> n{};
    const std::array components{columns.normal_x, columns.normal_y, columns.normal_z};
    bool whole = true;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!components[k]) continue;
      const auto component = number(line, *components[k], verdict);
      whole = whole && component;
      n[k] = component.value_or(0);
    }
    if (!whole) return;
    const NormalVerdict found = judge_normal(truth_, row, n);
    verdict.normal = found.error;
    verdict.reversed = found.reversed;
  }

  void summarise() {
    result_.families.resize(truth_.families.size());
    std::vector<std::vector<std::size_t>> rows(truth_.families.size());
    std::vector<std::size_t> every(verdicts_.size());
    for (std::size_t i = 0; i < verdicts_.size(); ++i) {
      rows[truth_.rows[i].family].push_back(i);
      every[i] = i;
    }
    for (std::size_t f = 0; f < rows.size(); ++f) {
      result_.families[f] = summary(truth_.families[f], rows[f]);
    }
    result_.all = summary("all", every);
  }

  static void count(std::size_t& number, std::size_t& first, std::size_t row) {
    if (number++ == 0) first = row;
  }

  FamilyGrade summary(const std::string& name, const std::vector<std::size_t>& rows) const {
    FamilyGrade g;
    g.name = name;
    g.rows = rows.size();
    for (const std::size_t i : rows) {
      const Verdict& v = verdicts_[i];
      if (v.wrong) count(g.wrong, g.first_wrong, i);
      if (v.touch) ++g.touches;
      if (v.missing || !v.seen) count(g.missing, g.first_missing, i);
      if (!v.seen) ++g.unanswered;
      if (truth_.rows[i].gap && std::isnan(v.gap)) ++g.without_gap;
      if (v.broken) count(g.broken_bounds, g.first_broken, i);
      if (v.reversed) count(g.reversed, g.first_reversed, i);
    }
    g.gap = errors(rows, &Verdict::gap);
    g.normal = errors(rows, &Verdict::normal);
    g.area = errors(rows, &Verdict::area);
    return g;
  }

  ErrorSummary errors(const std::vector<std::size_t>& rows, double Verdict::*which) const {
    std::vector<double> all;
    for (const std::size_t i : rows) all.push_back(verdicts_[i].*which);
    ErrorSummary s = summary_of(all);
    if (s.count > 0) s.worst_row = rows[s.worst_row];
    return s;
  }

  const TruthTable& truth_;
  Demands demands_;
  std::vector<Verdict> verdicts_;
  Grade result_;
  bool offered_ = false;
  std::size_t row_ = kNoRow;  // that is being graded
};

template <class Answers>
Grade graded(const TruthTable& truth, const Answers& answers, const Demands& demands) {
  Grader grader(truth, demands);
  try {
    grader.read(tables::Reader(answers));
  } catch (const tables::Error& error) {
    grader.end_by(error);
  }
  return grader.result();
}

}  // namespace

Grade grade(const TruthTable& truth, const std::string& answers, const Demands& demands) {
  return graded(truth, answers, demands);
}

Grade grade(const TruthTable& truth, const tables::NamedText& answers, const Demands& demands) {
  return graded(truth, answers, demands);
}

}  // namespace tangency::inline v0::verify
