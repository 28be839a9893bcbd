// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/grade/judged_columns.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/verify/grade/judge.hpp>

namespace tangency::inline v0::verify {
namespace {

using tables::Column;
using Sort = JudgedColumns::Sort;

// Derived: rounding to three decimals moves a length by at most 5e-4 (|nx| + |ny| + |nz|), below
// 8.7e-4. Such a normal is one, whose error is measured; 0 0 0 and 1e300 0 0 are none.
constexpr double kLengthError = 1e-3;

void judge_relation(AnswerCells& cells, const FoundColumns& at, const TruthTable&,
                    const TruthRow& row) {
  const Column column = *at.judged[0];
  const auto text = cells.word(column);
  if (text.empty()) return;
  const auto relation = relation_named(text);
  if (!relation) return cells.refuse(column, "this is not a relation");
  if (*relation != row.relation) cells.wrong(column, std::string(name(row.relation)));
}

void judge_overlaps(AnswerCells& cells, const FoundColumns& at, const TruthTable&,
                    const TruthRow& row) {
  const Column column = *at.judged[0];
  const auto text = cells.word(column);
  if (text.empty()) return;
  if (text != "0" && text != "1") return cells.refuse(column, "this is neither 0 nor 1");
  const bool yes = text == "1", truth = interiors_meet(row.relation);
  const bool touch = yes && row.relation == Relation::external_touch;
  cells.verdict().touch = touch;
  if (!touch && yes != truth) cells.wrong(column, truth ? "1" : "0");
}

void judge_crossings(AnswerCells& cells, const FoundColumns& at, const TruthTable&,
                     const TruthRow& row) {
  const Column column = *at.judged[0];
  if (row.crossings < 0) {
    if (!cells.text(column).empty()) cells.wrong(column, {});
  } else if (const auto count = cells.number(column)) {
    if (*count != row.crossings) cells.wrong(column, std::to_string(row.crossings));
  }
}

void judge_word(AnswerCells& cells, const FoundColumns& at, const TruthTable&,
                const TruthRow& row) {
  const auto text = cells.word(*at.judged[0]);
  if (!text.empty() && text != row.word) cells.wrong(*at.judged[0], row.word);
}

// A contact that only grazes is a contact.
void judge_status(AnswerCells& cells, const FoundColumns& at, const TruthTable&,
                  const TruthRow& row) {
  const auto text = cells.word(*at.judged[0]);
  if (text.empty() || text == row.word || (row.word == "grazing" && text == "contact")) return;
  cells.wrong(*at.judged[0], row.word);
}

void judge_area(AnswerCells& cells, const FoundColumns& at, const TruthTable&,
                const TruthRow& row) {
  if (const auto area = cells.number(*at.judged[0]))
    cells.verdict().error(ErrorKind::area) = std::abs(*area - row.area) / row.smaller_area;
}

// Of points: inside or outside is what the sign says. On the surface neither is wrong.
void judge_side(AnswerCells& cells, const FoundColumns& at, const TruthTable&,
                const TruthRow& row) {
  double gap = 0;
  if (tables::parse_number(cells.text(*at.judged[0]), gap)) return;  // missing, says judge_gap()
  const double truth = row.gap->high;
  if (truth != 0 && (gap > 0) != (truth > 0)) cells.wrong(*at.judged[0], tables::to_text(truth));
}

// Where the definition says nothing of the row nothing is asked.
void judge_gap(AnswerCells& cells, const FoundColumns& at, const TruthTable&, const TruthRow& row) {
  if (!row.gap) return;
  const auto gap = cells.number(*at.judged[0]);
  if (!gap) return;
  const double off = excess(*gap, *row.gap);
  const double error = cells.verdict().error(ErrorKind::gap) = std::abs(off) / row.size;
  if (cells.demands().gap && error > *cells.demands().gap) {
    cells.find(Problem::gap_error, "gap", std::string(cells.text(*at.judged[0])),
               tables::to_text(row.gap->high), error);
  }
  const auto &bound_column = at.beside[0], &status = at.beside[1];
  if (!bound_column || cells.text(*bound_column).empty()) return;
  const auto bound = cells.number(*bound_column);
  if (bound && *bound < 0) return cells.refuse(*bound_column, "a bound must be >= 0");
  const bool local = status && cells.text(*status) == "local";
  if (!bound || !breaks_bound(off, *bound, local)) return;
  cells.verdict().broken = true;
  cells.find(Problem::broken_bound, "gap_error", std::string(cells.text(*bound_column)),
             tables::rounded_text(std::abs(off), 4), error);
}

void judge_direction(AnswerCells& cells, const FoundColumns& at, const TruthTable& truth,
                     const TruthRow& row) {
  if (!row.gap) return;
  std::array<double, 3> n{};
  std::string names, answered, expected;
  bool whole = true;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!at.judged[k]) continue;
    const auto component = cells.number(*at.judged[k]);
    whole = whole && component;
    n[k] = component.value_or(0);
    const char* separator = k == 0 ? "" : " ";
    names += separator + std::string{'n', "xyz"[k]};
    answered += separator + std::string(cells.text(*at.judged[k]));
    if (!row.every_normal)
      expected += separator + tables::to_text(truth.maximisers[row.first_normal].normal[k]);
  }
  if (!whole) return;
  if (!(std::abs(std::hypot(n[0], n[1], n[2]) - 1) <= kLengthError))
    return cells.refuse(*at.judged[0], "the normal that begins here must have length 1");
  const NormalVerdict found = judge_normal(truth, row, n);
  const double error = found.error / normal_unit(truth.kind);
  cells.verdict().error(ErrorKind::normal) = error;
  cells.verdict().reversed = found.reversed;
  if (!found.reversed && !(cells.demands().normal && error > *cells.demands().normal)) return;
  cells.find(found.reversed ? Problem::reversed : Problem::normal_error, names, answered, expected,
             error);
}

// t1 or t2: the worse error of both counts. A point that is not there is wrong.
template <std::size_t k>
void judge_t(AnswerCells& cells, const FoundColumns& at, const TruthTable&, const TruthRow& row) {
  const Column column = *at.judged[0];
  if (!row.times[k]) {
    if (!cells.text(column).empty()) cells.wrong(column, {});
  } else if (const auto t = cells.number(column)) {
    double& worst = cells.verdict().error(ErrorKind::time);
    const double error = std::abs(excess(*t, *row.times[k])) / row.size;
    if (!(worst >= error)) worst = error;
  }
}

// The distance from the true interval. `latest` claims that the bodies have not met before `time`,
// and of a contact that they have by then.
void judge_time(AnswerCells& cells, const FoundColumns& at, const TruthTable&,
                const TruthRow& row) {
  if (!row.times[0] || !row.times[1]) return;
  const auto time = cells.number(*at.judged[0]);
  if (!time) return;
  const double early = -excess(*time, *row.times[0]), late = excess(*time, *row.times[1]);
  const double error = std::max({0.0, early, late}) / row.size;
  cells.verdict().error(ErrorKind::time) = error;
  if (!at.beside[0] || cells.text(*at.beside[0]).empty()) return;
  const auto latest = cells.number(*at.beside[0]);
  const bool claims_contact = !at.beside[1] || cells.text(*at.beside[1]) == "contact";
  const bool too_soon = latest && claims_contact && excess(*latest, *row.times[0]) < 0;
  if (!latest || !(late > 0 || too_soon)) return;
  cells.verdict().broken = true;
  cells.find(Problem::broken_bound, "latest", std::string(cells.text(*at.beside[0])),
             tables::to_text(row.times[0]->high) + " to " + tables::to_text(row.times[1]->high),
             error);
}

constexpr JudgedColumns kRelation{Sort::word, {"relation"}, {}, judge_relation};
constexpr JudgedColumns kOverlaps{Sort::word, {"overlaps"}, {}, judge_overlaps};
constexpr JudgedColumns kGap{Sort::gap, {"gap"}, {"gap_error", "status"}, judge_gap};
constexpr JudgedColumns kNormal{Sort::normal, {"nx", "ny", "nz"}, {}, judge_direction};

constexpr std::array kOfPairs{kRelation, kOverlaps, kGap, kNormal};
constexpr std::array kOfPoints{JudgedColumns{Sort::word, {"gap"}, {}, judge_side}, kGap, kNormal};
constexpr std::array kOfEllipses{kRelation,
                                 kOverlaps,
                                 JudgedColumns{Sort::word, {"crossings"}, {}, judge_crossings},
                                 JudgedColumns{Sort::number, {"area"}, {}, judge_area},
                                 kGap,
                                 JudgedColumns{Sort::normal, {"nx", "ny"}, {}, judge_direction}};
constexpr std::array kOfQuadrics{JudgedColumns{Sort::word, {"type"}, {}, judge_word}};
constexpr std::array kOfRays{JudgedColumns{Sort::word, {"result"}, {}, judge_word},
                             JudgedColumns{Sort::number, {"t1"}, {}, judge_t<0>},
                             JudgedColumns{Sort::number, {"t2"}, {}, judge_t<1>}};
constexpr std::array kOfTimes{
    JudgedColumns{Sort::word, {"status"}, {}, judge_status},
    JudgedColumns{Sort::number, {"time"}, {"latest", "status"}, judge_time}};

}  // namespace

std::optional<double> AnswerCells::number(Column column) {
  if (!line_.text(column).empty()) {
    try {
      return line_.number(column);
    } catch (const tables::Error& error) {
      findings_.fault(error);
    }
  }
  find_missing(column);
  return std::nullopt;
}

std::string_view AnswerCells::word(Column column) {
  const std::string_view text = line_.text(column);
  if (text.empty()) find_missing(column);
  return text;
}

void AnswerCells::refuse(Column column, std::string_view rule) {
  find_missing(column);
  findings_.fault(line_.error(column, rule));
}

void AnswerCells::wrong(Column column, std::string truth) {
  verdict_.wrong = 1;
  find(Problem::wrong, findings_.header.name(column), std::string(line_.text(column)),
       std::move(truth), 0);
}

void AnswerCells::find(Problem problem, std::string column, std::string answered, std::string truth,
                       double error) {
  findings_.find({row_, problem, std::move(column), std::move(answered), std::move(truth), error});
}

void AnswerCells::find_missing(Column column) {
  verdict_.missing = 1;
  find(Problem::missing, findings_.header.name(column), std::string(line_.text(column)), {}, 0);
}

std::span<const JudgedColumns> judged_columns(CorpusKind kind) {
  switch (kind) {
    case CorpusKind::pairs:
    case CorpusKind::walls:
    case CorpusKind::matrices:
    case CorpusKind::floats:
      break;
    case CorpusKind::ellipses:
      return kOfEllipses;
    case CorpusKind::quadrics:
      return kOfQuadrics;
    case CorpusKind::points:
      return kOfPoints;
    case CorpusKind::rays:
      return kOfRays;
    case CorpusKind::times:
      return kOfTimes;
    case CorpusKind::neighbours:
      return {};
  }
  return kOfPairs;
}

}  // namespace tangency::inline v0::verify
