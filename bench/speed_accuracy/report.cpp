// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/bench/speed_accuracy/report.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <variant>

#include <tangency/bench/speed_accuracy/format.hpp>
#include <tangency/geometry/tables/csv.hpp>

namespace tangency::speed_accuracy {
namespace {

using Cell = std::variant<std::monostate, std::string, std::uint64_t, double>;

template <class Value>
Cell cell(const std::optional<Value>& value) {
  return value ? Cell(*value) : Cell();
}

Cell text(const std::string& value) { return value.empty() ? Cell() : Cell(value); }

struct Column {
  std::string name, meaning;
  std::function<Cell(const Row&)> of;
};

/// Median, 99 % and largest of one kind of error.
void add_errors(std::vector<Column>& to, const std::string& name, const std::string& meaning,
                std::optional<Errors> Score::*kind) {
  const auto add = [&](const char* rank, const std::string& what, double Errors::*value) {
    to.push_back({name + rank, what, [kind, value](const Row& row) {
                    const std::optional<Errors>& errors = row.score.*kind;
                    return errors ? Cell(*errors.*value) : Cell();
                  }});
  };
  add("_median", meaning + ": median", &Errors::median);
  add("_99", "the same: 99 %", &Errors::percentile_99);
  add("_largest", "the same: largest", &Errors::largest);
}

std::vector<Column> make_columns() {
  std::vector<Column> all = {
      {"family", "of pairs", [](const Row& r) { return text(r.family); }},
      {"method", "the call", [](const Row& r) { return text(r.method); }},
      {"option", "its accuracy, or where it starts", [](const Row& r) { return text(r.option); }},
      {"steps", "of the iteration, where the row limits them",
       [](const Row& r) { return r.steps ? Cell(static_cast<std::uint64_t>(*r.steps)) : Cell(); }},
      {"level", "instruction set of a batch; single: one pair at a time",
       [](const Row& r) { return text(r.level); }},
      {"definition", "of the gap; of others than the common normal errors are differences of it",
       [](const Row& r) { return text(r.definition); }},
      {"pairs", "answered and timed", [](const Row& r) { return Cell(r.score.pairs); }}};
  add_errors(all, "gap_error", "|gap - true gap| / smallest semi-axis of the pair", &Score::gap);
  add_errors(all, "normal_error", "angle to the true normal in rad, where that is unique",
             &Score::normal);
  add_errors(all, "point_error", "of the worse witness point / smallest semi-axis, there",
             &Score::point);
  const std::vector<Column> rest = {
      {"proven_largest", "largest gap_error / smallest semi-axis of the pair",
       [](const Row& r) { return cell(r.score.gap_error); }},
      {"wrong", "answers of the wrong sign or yes/no, not finite, or beyond their gap_error",
       [](const Row& r) { return Cell(r.score.wrong); }},
      {"local", "answers of status local: in none of the errors above",
       [](const Row& r) { return Cell(r.score.local); }},
      {"local_error_largest", "their largest |gap - true global gap| / smallest semi-axis",
       [](const Row& r) { return cell(r.score.local_error); }},
      {"unanswered", "pairs without an answer",
       [](const Row& r) { return Cell(r.score.unanswered); }},
      {"open", "pairs whose truth the oracle does not prove: in none of the errors above",
       [](const Row& r) { return Cell(r.score.open); }},
      {"ns", "per pair, the least of the rounds", [](const Row& r) { return Cell(r.ns); }},
      {"inverses", "the same over the time of Eigen's 3x3 inverse in the same run",
       [](const Row& r) { return Cell(r.ns / r.inverse); }},
      {"instructions", "per pair, by callgrind, of the first pairs of the family",
       [](const Row& r) { return cell(r.instructions); }}};
  all.insert(all.end(), rest.begin(), rest.end());
  return all;
}

const std::vector<Column>& columns() {
  static const std::vector<Column> all = make_columns();
  return all;
}

/// To four digits: more are noise.
double rounded(double value) { return std::strtod(format("%.3e", value).c_str(), nullptr); }

/// JSON has no infinity, and readers of CSV expect none.
std::string infinite_as_text(double value) { return std::isnan(value) ? "nan" : "inf"; }

void write(const Cell& cell, tables::RowText& to) {
  if (std::holds_alternative<std::monostate>(cell)) return to.empty();
  if (const auto* s = std::get_if<std::string>(&cell)) return to.text(*s);
  if (const auto* n = std::get_if<std::uint64_t>(&cell)) return to.integer(*n);
  const double value = std::get<double>(cell);
  std::isfinite(value) ? to.number(rounded(value)) : to.text(infinite_as_text(value));
}

nlohmann::ordered_json json_of(const Cell& cell) {
  if (std::holds_alternative<std::monostate>(cell)) return nullptr;
  if (const auto* s = std::get_if<std::string>(&cell)) return *s;
  if (const auto* n = std::get_if<std::uint64_t>(&cell)) return *n;
  const double value = std::get<double>(cell);
  if (!std::isfinite(value)) return infinite_as_text(value);
  return rounded(value);
}

constexpr std::string_view kLicence = "# SPDX-License-Identifier: MIT\n";

}  // namespace

std::string Row::key() const {
  return family + "|" + method + "|" + option + "|" + (steps ? std::to_string(*steps) : "") + "|" +
         level;
}

std::vector<std::string> levels_of(const std::vector<Row>& rows) {
  std::vector<std::string> levels;
  for (const Row& row : rows) {
    if (row.level != "single" && std::find(levels.begin(), levels.end(), row.level) == levels.end())
      levels.push_back(row.level);
  }
  return levels;
}

std::string describe_columns() {
  std::string all;
  for (const Column& column : columns()) all += "  " + column.name + ": " + column.meaning + "\n";
  return all;
}

std::string to_csv(const std::vector<Row>& rows) {
  tables::RowText table;
  std::vector<std::string_view> names;
  for (const Column& column : columns()) names.push_back(column.name);
  table.header(names);
  for (const Row& row : rows) {
    for (const Column& column : columns()) write(column.of(row), table);
    table.end_row();
  }
  return std::string(kLicence) + std::string(table.view());
}

std::string to_json(const std::vector<Row>& rows) {
  std::string all;
  for (const Row& row : rows) {
    nlohmann::ordered_json object;
    for (const Column& column : columns()) object[column.name] = json_of(column.of(row));
    all += (all.empty() ? "" : ",\n") + object.dump();
  }
  return "[\n" + all + "\n]\n";
}

std::string to_csv(const std::vector<AheadRow>& rows) {
  tables::RowText table;
  constexpr std::string_view kNames[] = {"family", "method",   "level", "touching_percent",
                                         "ns_all", "ns_ahead", "ratio"};
  table.header(kNames);
  for (const AheadRow& row : rows) {
    table.text(row.family);
    table.text(row.method);
    table.text(row.level);
    table.integer(static_cast<std::uint64_t>(row.touching));
    table.number(rounded(row.ns_all));
    table.number(rounded(row.ns_ahead));
    table.number(rounded(row.ns_ahead / row.ns_all));
    table.end_row();
  }
  return std::string(kLicence) + std::string(table.view());
}

}  // namespace tangency::speed_accuracy
