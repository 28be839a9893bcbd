// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/grade/grade.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include <tangency/geometry/tables/number_text.hpp>
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
    header_ = &reader.header();
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
    if (row_ != kNoRow && truth_.rows[row_].standing != Standing::judged) return;
    if (result_.fault_count++ < kMostNamedFaults) result_.faults.push_back(what);
  }

  // Of the row in hand.
  void find(Problem problem, std::string column, std::string answered, std::string truth,
            double error = 0) {
    result_.findings.push_back(
        {row_, problem, std::move(column), std::move(answered), std::move(truth), error});
  }

  void find_missing(const RowCursor& line, Column column, Verdict& verdict) {
    verdict.missing = true;
    find(Problem::missing, header_->name(column), std::string(line.text(column)), {});
  }

  void find_wrong(const RowCursor& line, Column column, std::string truth, Verdict& verdict) {
    verdict.wrong = true;
    find(Problem::wrong, header_->name(column), std::string(line.text(column)), std::move(truth));
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
    find_missing(line, column, verdict);
    return std::nullopt;
  }

  std::string_view word(const RowCursor& line, Column column, Verdict& verdict) {
    const std::string_view text = line.text(column);
    if (text.empty()) find_missing(line, column, verdict);
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
    const bool has_gap = truth_.rows[i].gap.has_value();
    for (const auto& [is_missing, what] :
         {std::pair(!offered_, ""), std::pair(demands_.words && !columns.words(), "relation"),
          std::pair(demands_.gap && !columns.gap && has_gap, "gap"),
          std::pair(demands_.normal && !columns.normal() && has_gap, "nx ny nz")}) {
      if (!is_missing) continue;
      verdict.missing = true;
      find(Problem::missing, what, {}, {});
    }
  }

  void judge_words(const RowCursor& line, const Columns& columns, const TruthRow& row,
                   Verdict& verdict) {
    if (columns.relation) {
      if (const auto text = word(line, *columns.relation, verdict); !text.empty()) {
        const auto relation = relation_named(text);
        if (!relation) {
          find_missing(line, *columns.relation, verdict);
          fault(line.error(*columns.relation, "this is not a relation"));
        } else if (*relation != row.relation) {
          find_wrong(line, *columns.relation, std::string(name(row.relation)), verdict);
        }
      }
    }
    if (columns.overlaps) judge_overlaps(line, *columns.overlaps, row, verdict);
    if (columns.crossings) judge_crossings(line, *columns.crossings, row, verdict);
    if (columns.type) {
      const auto text = word(line, *columns.type, verdict);
      if (!text.empty() && text != row.type) find_wrong(line, *columns.type, row.type, verdict);
    }
  }

  void judge_overlaps(const RowCursor& line, Column column, const TruthRow& row, Verdict& verdict) {
    const auto text = word(line, column, verdict);
    if (text.empty()) return;
    if (text != "0" && text != "1") {
      find_missing(line, column, verdict);
      return fault(line.error(column, "this is neither 0 nor 1"));
    }
    const bool yes = text == "1", truth = interiors_meet(row.relation);
    verdict.touch = yes && row.relation == Relation::external_touch;
    if (!verdict.touch && yes != truth) find_wrong(line, column, truth ? "1" : "0", verdict);
  }

  void judge_crossings(const RowCursor& line, Column column, const TruthRow& row,
                       Verdict& verdict) {
    const bool empty = line.text(column).empty();
    if (row.crossings < 0) {
      if (!empty) find_wrong(line, column, {}, verdict);
    } else if (const auto count = number(line, column, verdict)) {
      if (*count == row.crossings) return;
      find_wrong(line, column, std::to_string(row.crossings), verdict);
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
        if (demands_.gap && verdict.gap > *demands_.gap) {
          find(Problem::gap_error, "gap", std::string(line.text(*columns.gap)),
               tables::to_text(row.gap->high), verdict.gap);
        }
        if (columns.gap_error && !line.text(*columns.gap_error).empty()) {
          const auto bound = number(line, *columns.gap_error, verdict);
          const bool local = columns.status && line.text(*columns.status) == "local";
          verdict.broken = bound && breaks_bound(off, *bound, local);
          if (verdict.broken) {
            find(Problem::broken_bound, "gap_error", std::string(line.text(*columns.gap_error)),
                 tables::rounded_text(std::abs(off), 4), verdict.gap);
          }
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
    const bool is_off = demands_.normal && found.error > *demands_.normal;
    if (!found.reversed && !is_off) return;
    std::string answered, truth;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!components[k]) continue;
      const char* separator = k == 0 ? "" : " ";
      answered += separator + std::string(line.text(*components[k]));
      if (row.every_normal) continue;
      truth += separator + tables::to_text(truth_.maximisers[row.first_normal].normal[k]);
    }
    find(found.reversed ? Problem::reversed : Problem::normal_error,
         columns.normal_z ? "nx ny nz" : "nx ny", std::move(answered), std::move(truth),
         found.error);
  }

  void summarise() {
    for (row_ = 0; row_ < verdicts_.size(); ++row_) {
      result_.family.push_back(truth_.rows[row_].family);
      if (!verdicts_[row_].seen) find(Problem::missing, {}, {}, {});
    }
    std::ranges::stable_sort(result_.findings, {}, &Finding::row);
    const std::vector<std::vector<std::size_t>> rows = judged_rows();
    for (std::size_t f = 0; f < rows.size(); ++f) {
      result_.families[f] = summary(truth_.families[f], rows[f]);
    }
    std::vector<std::size_t> every;
    for (const auto& some : rows) every.insert(every.end(), some.begin(), some.end());
    std::ranges::sort(every);
    result_.all = summary("all", every);
    count_set_aside();
  }

  bool is_set_aside(std::size_t row) const {
    const Standing standing = truth_.rows[row].standing;
    return standing == Standing::not_claimed ||
           (standing == Standing::expected_failure && failed_[row]);
  }

  // Of each family; findings of all other rows are dropped.
  std::vector<std::vector<std::size_t>> judged_rows() {
    failed_.assign(verdicts_.size(), false);
    for (const Finding& finding : result_.findings) failed_[finding.row] = true;
    std::erase_if(result_.findings, [&](const Finding& one) { return is_set_aside(one.row); });
    std::vector<std::vector<std::size_t>> rows(truth_.families.size());
    for (std::size_t i = 0; i < verdicts_.size(); ++i) {
      if (!is_set_aside(i)) rows[truth_.rows[i].family].push_back(i);
      if (truth_.rows[i].standing == Standing::expected_failure && !failed_[i]) {
        result_.mended.push_back(i);
      }
    }
    result_.families.resize(rows.size());
    return rows;
  }

  void count_set_aside() {
    for (std::size_t i = 0; i < verdicts_.size(); ++i) {
      if (!is_set_aside(i)) continue;
      for (FamilyGrade* one : {&result_.families[truth_.rows[i].family], &result_.all}) {
        const bool claimed = truth_.rows[i].standing != Standing::not_claimed;
        ++(claimed ? one->expected_failures : one->not_claimed);
      }
    }
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
  std::vector<bool> failed_;  // rows with a finding
  Grade result_;
  bool offered_ = false;
  const tables::Header* header_ = nullptr;  // of the answers that are being read
  std::size_t row_ = kNoRow;                // that is being graded
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
