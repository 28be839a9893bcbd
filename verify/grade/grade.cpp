// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/grade/grade.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include <tangency/verify/grade/judge.hpp>
#include <tangency/verify/grade/judged_columns.hpp>

namespace tangency::inline v0::verify {
namespace {

using tables::Column;
using tables::RowCursor;

// Chosen: enough to see what is going on.
constexpr std::size_t kMostNamedFaults = 10;

// The columns of one header that are judged.
class Offer {
 public:
  Offer(const tables::Header& header, const TruthTable& truth) {
    for (const JudgedColumns& columns : judged_columns(truth.kind)) {
      const bool normal = columns.sort == Sort::normal;
      if (normal && !truth.has_normals) continue;
      FoundColumns at;
      std::size_t found = 0, named = 0;
      for (std::size_t k = 0; k < columns.names.size() && columns.names[k]; ++k, ++named) {
        at.judged[k] = header.find(columns.names[k]);
        found += at.judged[k].has_value();
      }
      part_of_a_normal_ |= normal && found > 0 && found < named;
      if (found < named) continue;
      for (std::size_t k = 0; k < columns.beside.size() && columns.beside[k]; ++k)
        at.beside[k] = header.find(columns.beside[k]);
      offered_.push_back({&columns, at});
    }
  }
  struct One {
    const JudgedColumns* columns;
    FoundColumns at;
  };
  const std::vector<One>& all() const { return offered_; }
  bool part_of_a_normal() const { return part_of_a_normal_; }
  bool any(JudgedColumns::Sort sort) const {
    return std::ranges::any_of(offered_, [&](const One& o) { return o.columns->sort == sort; });
  }
  // A number that its answer claims to be near.
  bool claims_bounds() const {
    return std::ranges::any_of(offered_, [](const One& o) { return o.at.beside[0].has_value(); });
  }

 private:
  using Sort = JudgedColumns::Sort;

  std::vector<One> offered_;
  bool part_of_a_normal_ = false;
};

// The columns of a list of neighbours.
struct ListColumns {
  Column i, j;
  std::array<Column, 3> image;

  explicit ListColumns(const tables::Header& header)
      : i(header.require("i")),
        j(header.require("j")),
        image{header.require("ix"), header.require("iy"), header.require("iz")} {}
};

class Grader {
 public:
  Grader(const TruthTable& truth, const Demands& demands)
      : truth_(truth), demands_(demands), verdicts_(truth.rows.size()) {}

  void read(tables::Reader&& reader) {
    if (truth_.kind == CorpusKind::neighbours) return read_list(reader);
    const Offer offer(reader.header(), truth_);
    result_.judges_words = offer.any(Sort::word);
    result_.judges_gaps = offer.any(Sort::gap);
    result_.judges_normals = offer.any(Sort::normal);
    result_.claims_bounds = offer.claims_bounds();
    const Column number = reader.header().require("row");
    if (offer.all().empty()) fault("the header names no column that is graded");
    if (offer.part_of_a_normal()) fault("the header names a part of a normal; all of it is graded");
    const Findings findings{reader.header(), demands_,
                            [this](const tables::Error& error) { fault(error); },
                            [this](Finding one) { result_.findings.push_back(std::move(one)); }};
    for_each_line(reader, [&](const RowCursor& line) { take(line, number, offer, findings); });
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
  using Sort = JudgedColumns::Sort;

  void fault(const std::string& what) {
    if (row_ != kNoRow && truth_.rows[row_].standing != Standing::judged) return;
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

  template <class Take>
  void for_each_line(tables::Reader& reader, const Take& take) {
    tables::Block block;
    RowCursor line(reader.header());
    while (reader.read(block)) {
      line.enter(block);
      while (next(line)) take(line);
      row_ = kNoRow;
    }
  }

  // The number of a row. Nothing, and a fault, where it is none.
  std::optional<std::size_t> row_number(const RowCursor& line, Column column) {
    row_ = kNoRow;
    try {
      const double index = line.number(column);
      if (index >= 0 && index < static_cast<double>(verdicts_.size()) && index == std::floor(index))
        return static_cast<std::size_t>(index);
      fault(line.error(column,
                       "the corpus has the rows 0 to " + std::to_string(verdicts_.size() - 1)));
    } catch (const tables::Error& error) {
      fault(error);
    }
    return std::nullopt;
  }

  void take(const RowCursor& line, Column number_column, const Offer& offer,
            const Findings& findings) {
    const auto i = row_number(line, number_column);
    if (!i) return;
    RowVerdict& verdict = verdicts_[*i];
    if (verdict.seen) return fault(line.error(number_column, "this row is answered again"));
    verdict.seen = true;
    row_ = *i;
    const TruthRow& row = truth_.rows[*i];
    AnswerCells cells(line, *i, verdict, findings);
    for (const auto& [columns, at] : offer.all()) columns->judge(cells, at, truth_, row);
    for (const auto& [is_missing, what] :
         {std::pair(offer.all().empty(), ""),
          std::pair(demands_.words && asks_words() && !offer.any(Sort::word), "relation"),
          std::pair(demands_.gap && !offer.any(Sort::gap) && row.gap, "gap"),
          std::pair(demands_.normal && !offer.any(Sort::normal) && row.gap, "nx ny nz")}) {
      if (!is_missing) continue;
      verdict.missing = 1;
      cells.find(Problem::missing, what, {}, {}, 0);
    }
  }

  bool asks_words() const {
    return std::ranges::any_of(judged_columns(truth_.kind),
                               [](const auto& columns) { return columns.sort == Sort::word; });
  }

  // ---- a list of neighbours

  void read_list(tables::Reader& reader) {
    result_.judges_words = true;
    listed_.assign(truth_.neighbours.size(), false);
    const ListColumns columns(reader.header());
    for_each_line(reader, [&](const RowCursor& line) { take_pair(line, columns); });
  }

  void take_pair(const RowCursor& line, const ListColumns& columns) {
    auto i = row_number(line, columns.i);
    const auto j = i ? row_number(line, columns.j) : std::nullopt;
    if (!j) return;
    TrueNeighbour pair{*j, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      constexpr double kMost = 1e6;  // chosen: beyond all images of a corpus
      try {
        const double image = line.number(columns.image[k]);
        if (!(std::abs(image) <= kMost) || image != std::floor(image))
          return fault(line.error(columns.image[k], "an image is given by whole numbers"));
        pair.image[k] = static_cast<int>(image);
      } catch (const tables::Error& error) {
        return fault(error);
      }
    }
    if (pair.j < *i || (pair.j == *i && pair.image < std::array<int, 3>{})) {
      std::swap(pair.j, *i);
      for (int& v : pair.image) v = -v;
    }
    take_pair(*i, pair, line, columns.i);
  }

  void take_pair(std::size_t i, const TrueNeighbour& pair, const RowCursor& line, Column at) {
    const TruthRow& row = truth_.rows[i];
    const auto first = truth_.neighbours.begin() + static_cast<std::ptrdiff_t>(row.first_neighbour);
    const auto last = first + static_cast<std::ptrdiff_t>(row.neighbours);
    const auto found = std::lower_bound(first, last, pair);
    row_ = i;
    if (found == last || *found != pair) {
      ++verdicts_[i].wrong;
      result_.findings.push_back({i, Problem::wrong, "j ix iy iz", text_of(pair), {}});
      return;
    }
    const auto k = static_cast<std::size_t>(found - truth_.neighbours.begin());
    if (listed_[k]) return fault(line.error(at, "this pair is listed again"));
    listed_[k] = true;
  }

  static std::string text_of(const TrueNeighbour& pair) {
    std::string text = std::to_string(pair.j);
    for (const int v : pair.image) text += ' ' + std::to_string(v);
    return text;
  }

  void count_unlisted() {
    listed_.resize(truth_.neighbours.size());
    for (std::size_t i = 0; i < verdicts_.size(); ++i) {
      const TruthRow& row = truth_.rows[i];
      verdicts_[i].seen = true;
      for (std::size_t k = row.first_neighbour; k < row.first_neighbour + row.neighbours; ++k) {
        if (listed_[k]) continue;
        ++verdicts_[i].missing;
        result_.findings.push_back(
            {i, Problem::missing, "j ix iy iz", {}, text_of(truth_.neighbours[k])});
      }
    }
  }

  // ---- the summary

  void summarise() {
    if (truth_.kind == CorpusKind::neighbours) count_unlisted();
    for (std::size_t i = 0; i < verdicts_.size(); ++i) {
      result_.family.push_back(truth_.rows[i].family);
      if (!verdicts_[i].seen) result_.findings.push_back({i, Problem::missing, {}, {}, {}});
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

  static void count(std::size_t more, std::size_t row, std::size_t& number, std::size_t& first) {
    if (more > 0 && number == 0) first = row;
    number += more;
  }

  FamilyGrade summary(const std::string& name, const std::vector<std::size_t>& rows) const {
    FamilyGrade g;
    g.name = name;
    g.rows = rows.size();
    for (const std::size_t i : rows) {
      const RowVerdict& v = verdicts_[i];
      count(v.wrong, i, g.wrong, g.first_wrong);
      g.touches += v.touch;
      count(v.seen ? v.missing : 1, i, g.missing, g.first_missing);
      g.unanswered += !v.seen;
      g.without_gap += truth_.rows[i].gap && std::isnan(v.error(ErrorKind::gap));
      count(v.broken, i, g.broken_bounds, g.first_broken);
      count(v.reversed, i, g.reversed, g.first_reversed);
    }
    g.gap = errors(rows, ErrorKind::gap);
    g.normal = errors(rows, ErrorKind::normal);
    g.area = errors(rows, ErrorKind::area);
    g.time = errors(rows, ErrorKind::time);
    return g;
  }

  ErrorSummary errors(const std::vector<std::size_t>& rows, ErrorKind kind) const {
    std::vector<double> all;
    for (const std::size_t i : rows) all.push_back(verdicts_[i].error(kind));
    ErrorSummary s = summary_of(all);
    if (s.count > 0) s.worst_row = rows[s.worst_row];
    return s;
  }

  const TruthTable& truth_;
  Demands demands_;
  std::vector<RowVerdict> verdicts_;
  std::vector<bool> listed_;  // of the true neighbours
  std::vector<bool> failed_;  // rows with a finding
  Grade result_;
  std::size_t row_ = kNoRow;  // that is being graded
};

constexpr ErrorName kGapError{"gap error / L", "gap error", "L", &FamilyGrade::gap};
constexpr ErrorName kNormalError{"normal error", "normal error", "1", &FamilyGrade::normal};
constexpr std::array kPlainErrors{
    kGapError, kNormalError,
    ErrorName{"area error", "area error", "smaller area", &FamilyGrade::area}};
constexpr std::array kFloatErrors{
    ErrorName{"gap error / 2^-24 L", "gap error", "2^-24 L", &FamilyGrade::gap},
    ErrorName{"normal error / 2^-24", "normal error", "2^-24", &FamilyGrade::normal}};
constexpr std::array kRayErrors{
    ErrorName{"t error |direction| / L", "t error", "L / |direction|", &FamilyGrade::time}};
constexpr std::array kTimeErrors{
    ErrorName{"time error / tolerance", "time error", "tolerance", &FamilyGrade::time}};

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

std::span<const ErrorName> error_names(CorpusKind kind) {
  if (kind == CorpusKind::floats) return kFloatErrors;
  if (kind == CorpusKind::rays) return kRayErrors;
  if (kind == CorpusKind::times) return kTimeErrors;
  return kPlainErrors;
}

Grade grade(const TruthTable& truth, const std::string& answers, const Demands& demands) {
  return graded(truth, answers, demands);
}

Grade grade(const TruthTable& truth, const tables::NamedText& answers, const Demands& demands) {
  return graded(truth, answers, demands);
}

}  // namespace tangency::inline v0::verify
