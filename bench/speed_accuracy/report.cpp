// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/bench/speed_accuracy/report.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string_view>

#include <tangency/bench/speed_accuracy/programs.hpp>
#include <tangency/geometry/tables/csv.hpp>

namespace tangency::speed_accuracy {
namespace {

using Json = nlohmann::ordered_json;
using verify::CallGrade;
using verify::ErrorSummary;

/// What a column holds of a row; null: nothing.
template <class RowType>
struct Column {
  std::string name, meaning;
  std::function<Json(const RowType&)> of;
};

/// To four digits: more are noise. JSON has no infinity, and readers of CSV expect none.
Json number(double value) {
  if (!std::isfinite(value)) return std::isnan(value) ? "nan" : "inf";
  char text[32];
  std::snprintf(text, sizeof text, "%.3e", value);
  return std::strtod(text, nullptr);
}

Json number(const std::optional<double>& value) { return value ? number(*value) : Json(); }

Json number(const std::optional<std::size_t>& value) { return value ? Json(*value) : Json(); }

Json text(const std::string& value) { return value.empty() ? Json() : Json(value); }

/// Median, 99 % and largest of one kind of error.
void add_errors(std::vector<Column<Row>>& to, const std::string& name, const std::string& meaning,
                ErrorSummary CallGrade::*kind) {
  const auto add = [&](const char* rank, const std::string& what, double ErrorSummary::*value) {
    to.push_back({name + rank, what, [kind, value](const Row& row) {
                    const ErrorSummary& errors = row.grade.*kind;
                    return errors.count > 0 ? number(errors.*value) : Json();
                  }});
  };
  add("_median", meaning + ": median", &ErrorSummary::median);
  add("_99", "the same: 99 %", &ErrorSummary::percentile_99);
  add("_largest", "the same: largest", &ErrorSummary::largest);
}

std::vector<Column<Row>> method_columns() {
  std::vector<Column<Row>> all = {
      {"family", "of pairs", [](const Row& r) { return text(r.family); }},
      {"method", "the call", [](const Row& r) { return text(r.method); }},
      {"option", "its accuracy, or where it starts", [](const Row& r) { return text(r.option); }},
      {"steps", "of the iteration, where the row limits them",
       [](const Row& r) { return r.steps ? Json(static_cast<unsigned>(*r.steps)) : Json(); }},
      {"level", "instruction set of a batch; single: one pair at a time",
       [](const Row& r) { return text(r.level); }},
      {"definition", "of the gap; of others than the common normal errors are differences of it",
       [](const Row& r) { return text(r.definition); }},
      {"pairs", "answered and timed", [](const Row& r) { return Json(r.grade.pairs); }}};
  add_errors(all, "gap_error", "|gap - true gap| / smallest semi-axis of the pair",
             &CallGrade::gap);
  add_errors(all, "normal_error", "angle to the true normal in rad, where that is unique",
             &CallGrade::normal);
  add_errors(all, "point_error", "of the worse witness point / smallest semi-axis, there",
             &CallGrade::point);
  const std::vector<Column<Row>> rest = {
      {"proven_largest", "largest gap_error / smallest semi-axis of the pair",
       [](const Row& r) { return number(r.grade.gap_error); }},
      {"wrong", "answers of the wrong sign or yes/no, not finite, or beyond their gap_error",
       [](const Row& r) { return Json(r.grade.wrong); }},
      {"local", "answers of status local: in none of the errors above",
       [](const Row& r) { return Json(r.grade.local); }},
      {"local_error_largest", "their largest |gap - true global gap| / smallest semi-axis",
       [](const Row& r) { return number(r.grade.local_error); }},
      {"unanswered", "pairs without an answer",
       [](const Row& r) { return Json(r.grade.unanswered); }},
      {"open", "pairs whose truth the oracle does not prove: in none of the errors above",
       [](const Row& r) { return Json(r.grade.open); }},
      {"ns", "per pair, the least of the rounds", [](const Row& r) { return number(r.ns); }},
      {"inverses", "the same over the time of Eigen's 3x3 inverse in the same run",
       [](const Row& r) { return number(r.ns / r.inverse); }},
      {"instructions", "per pair, by callgrind, of the first pairs of the family",
       [](const Row& r) { return number(r.instructions); }},
      {"left", "pairs of a batch that no lane proves: answered by the single call",
       [](const Row& r) { return number(r.left); }},
      {"left_deep", "those of them that overlap deeper than rho, where no normal alone is a proof",
       [](const Row& r) { return number(r.left_deep); }}};
  all.insert(all.end(), rest.begin(), rest.end());
  return all;
}

std::vector<Column<AheadRow>> ahead_columns() {
  return {{"family", "", [](const AheadRow& r) { return text(r.family); }},
          {"method", "", [](const AheadRow& r) { return text(r.method); }},
          {"level", "", [](const AheadRow& r) { return text(r.level); }},
          {"touching_percent", "",
           [](const AheadRow& r) { return Json(static_cast<unsigned>(r.touching)); }},
          {"ns_all", "", [](const AheadRow& r) { return number(r.ns_all); }},
          {"ns_ahead", "", [](const AheadRow& r) { return number(r.ns_ahead); }},
          {"ratio", "", [](const AheadRow& r) { return number(r.ns_ahead / r.ns_all); }}};
}

void write(const Json& cell, tables::RowText& to) {
  if (cell.is_null()) return to.empty();
  if (cell.is_string()) return to.text(cell.get_ref<const std::string&>());
  if (cell.is_number_unsigned()) return to.integer(cell.get<std::uint64_t>());
  to.number(cell.get<double>());
}

template <class RowType>
std::string csv_of(const std::vector<Column<RowType>>& columns, const std::vector<RowType>& rows) {
  tables::RowText table;
  std::vector<std::string_view> names;
  for (const auto& column : columns) names.push_back(column.name);
  table.header(names);
  for (const RowType& row : rows) {
    for (const auto& column : columns) write(column.of(row), table);
    table.end_row();
  }
  return "# SPDX-License-Identifier: MIT\n" + std::string(table.view());
}

constexpr const char* kScripts = TANGENCY_SPEED_ACCURACY_SCRIPTS;

}  // namespace

std::string Row::key() const {
  return family + "|" + method + "|" + option + "|" + (steps ? std::to_string(*steps) : "") + "|" +
         level;
}

std::string describe_columns() {
  std::string all;
  for (const auto& column : method_columns())
    all += "  " + column.name + ": " + column.meaning + "\n";
  return all;
}

std::string to_csv(const std::vector<Row>& rows) { return csv_of(method_columns(), rows); }

std::string to_csv(const std::vector<AheadRow>& rows) { return csv_of(ahead_columns(), rows); }

std::string to_json(const std::vector<Row>& rows) {
  const auto columns = method_columns();
  std::string all;
  for (const Row& row : rows) {
    Json object;
    for (const auto& column : columns) object[column.name] = column.of(row);
    all += (all.empty() ? "" : ",\n") + object.dump();
  }
  return "[\n" + all + "\n]\n";
}

std::string to_markdown(const std::string& methods, const std::string& ahead) {
  const TemporaryFolder folder;
  return output_of("LC_ALL=C awk -f " + shell_word(std::string(kScripts) + "/tables.awk") + " " +
                   shell_word(folder.add("methods.csv", methods)) + " " +
                   shell_word(folder.add("ahead.csv", ahead)));
}

std::string to_picture(const std::string& methods) {
  const TemporaryFolder folder;
  std::string svg =
      output_of("LC_ALL=C awk -f " + shell_word(std::string(kScripts) + "/picture.awk") + " " +
                shell_word(folder.add("methods.csv", methods)) + " | gnuplot");
  if (svg.find("</svg>") == std::string::npos)
    throw std::runtime_error("no picture: it needs class2 or class3");
  const std::string_view after = "?>\n";
  const std::size_t head = svg.find(after);
  return svg.insert(head == std::string::npos ? 0 : head + after.size(),
                    "<!-- SPDX-License-Identifier: MIT -->\n");
}

}  // namespace tangency::speed_accuracy
