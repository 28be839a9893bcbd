// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <tangency/verify/grade/outputs.hpp>

namespace tangency::inline v0::verify {
namespace {

using Json = nlohmann::ordered_json;

// An array, one line an entry.
std::string lines(const std::vector<Json>& entries) {
  std::string text = "[";
  for (const Json& entry : entries) {
    text +=
        (text == "[" ? "\n" : ",\n") + entry.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  return text + "\n]\n";
}

void add_family(const std::string& corpus, const FamilyReport& family,
                std::vector<NamedValue>& values) {
  using enum NamedValue::Kind;
  const std::string name = corpus + '/' + family.name + '/';
  for (const Count& count : family.counts) {
    if (!count.is_known) continue;
    const NamedValue::Kind kind = count.kind == Count::Kind::size ? size
                                  : count.kind == Count::Kind::information
                                      ? information
                                      : NamedValue::Kind::count;
    values.push_back({name + count.name, count.unit, kind, static_cast<double>(count.number)});
  }
  for (const Errors& errors : family.errors) {
    const ErrorSummary& s = errors.summary;
    if (s.count == 0) continue;
    for (const auto& [rank, value] :
         {std::pair(", median", s.median), std::pair(", 99 %", s.percentile_99),
          std::pair(", largest", s.largest)}) {
      // JSON has no infinity, and a reader takes the null in its place for the best of all.
      values.push_back({name + errors.name + rank, errors.unit, error,
                        std::min(value, std::numeric_limits<double>::max())});
    }
  }
}

// An error that loses no digit, in its unit: what rounding alone costs, or what is tolerated.
double harmless_error(std::string_view unit) {
  return unit.starts_with("2^-24") || unit == "tolerance" ? 1 : 1e-16;
}

double digits_lost(const Errors& errors) {
  const double largest = std::min(errors.summary.largest, std::numeric_limits<double>::max());
  const double digits = std::log10(largest) - std::log10(harmless_error(errors.unit));
  return std::round(100 * std::max(digits, 0.0)) / 100;
}

std::size_t faults_of(const GradeReport& report) {
  std::size_t faults = 0;
  for (const CorpusReport& corpus : report.corpora) faults += corpus.fault_count;
  return faults;
}

// One series a corpus.
std::vector<Json> series_of_wrong(const GradeReport& report) {
  std::vector<Json> series;
  for (const CorpusReport& corpus : report.corpora) {
    const auto& counts = corpus.whole.counts;
    const auto wrong = std::ranges::find(counts, std::string_view("wrong relations"), &Count::name);
    if (!wrong->is_known) continue;
    series.push_back(
        {{"name", corpus.name + "/wrong relations"}, {"unit", "rows"}, {"value", wrong->number}});
  }
  return series;
}

std::vector<Json> series_of_errors(const GradeReport& report, const std::string& title) {
  std::vector<Json> series;
  for (const CorpusReport& corpus : report.corpora) {
    for (const Errors& errors : corpus.whole.errors) {
      if (errors.title != title || errors.summary.count == 0) continue;
      series.push_back({{"name", corpus.name + '/' + errors.name},
                        {"unit", "digits lost"},
                        {"value", digits_lost(errors)}});
    }
  }
  return series;
}

}  // namespace

std::vector<NamedValue> values_of(const std::vector<CorpusReport>& corpora) {
  using enum NamedValue::Kind;
  std::vector<NamedValue> values;
  for (const CorpusReport& corpus : corpora) {
    for (const FamilyReport& family : corpus.families) add_family(corpus.name, family, values);
    add_family(corpus.name, corpus.whole, values);
    values.push_back({corpus.name + "/faulty lines or cells", "cells", count,
                      static_cast<double>(corpus.fault_count)});
    if (corpus.run)
      values.push_back({corpus.name + "/time", "s", information, corpus.run->seconds});
  }
  return values;
}

std::string as_json(const GradeReport& report) {
  std::vector<Json> entries;
  for (const NamedValue& one : values_of(report.corpora)) {
    Json entry{{"name", one.name}, {"unit", one.unit}};
    if (one.kind != NamedValue::Kind::error && one.unit != "s") {
      entry["value"] = static_cast<std::size_t>(one.value);
    } else {
      entry["value"] = one.value;
    }
    entries.push_back(std::move(entry));
  }
  return lines(entries);
}

std::string as_json_summary(const GradeReport& report) {
  const FamilyReport sum = total(report);
  std::vector<Json> series;
  for (const Count& count : sum.counts) {
    if (count.kind != Count::Kind::fault || !count.is_known) continue;
    series.push_back(
        {{"name", "all/" + std::string(count.name)}, {"unit", "rows"}, {"value", count.number}});
  }
  series.push_back(
      {{"name", "all/faulty lines or cells"}, {"unit", "cells"}, {"value", faults_of(report)}});
  for (const Errors& errors : sum.errors) {
    if (errors.summary.count == 0) continue;
    series.push_back({{"name", "all/" + std::string(errors.name)},
                      {"unit", "digits lost"},
                      {"value", digits_lost(errors)}});
  }
  const auto add_if_it_fits = [&](const std::vector<Json>& more) {
    if (series.size() + more.size() > kMostSeries) return;
    series.insert(series.end(), more.begin(), more.end());
  };
  add_if_it_fits(series_of_wrong(report));
  for (const Errors& errors : sum.errors) add_if_it_fits(series_of_errors(report, errors.title));
  if (series.size() > kMostSeries) series.resize(kMostSeries);
  return lines(series);
}

}  // namespace tangency::inline v0::verify
