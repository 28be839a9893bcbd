// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/grade/baseline.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include <tangency/geometry/tables/csv.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::verify {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Both values, with as many digits as tell them apart.
std::string both(const std::string& name, double now, double before) {
  for (const char* format : {"%.4g", "%.17g"}) {
    const std::string a = tables::formatted(format, now);
    const std::string b = tables::formatted(format, before);
    if (a != b || format[2] == '1') return name + ": " + a + ", was " + b;
  }
  return name;
}

[[noreturn]] void refuse(const std::string& path, std::size_t line) {
  throw tables::Error({.file = path,
                       .line = line,
                       .rule = "a baseline must be what --json writes, an array of {name, unit, "
                               "value}, none of them below 0"});
}

Baseline by_name(const std::string& path, const nlohmann::json& values) {
  Baseline baseline;
  if (!values.is_array() || values.empty()) refuse(path, 1);
  for (const auto& one : values) {
    const bool sound = one.is_object() && one.contains("name") && one["name"].is_string() &&
                       one.contains("value") && one["value"].is_number() && one["value"] >= 0;
    // As written: a bracket, then a line a value.
    if (!sound) refuse(path, baseline.size() + 2);
    baseline[one["name"].get<std::string>()] = one["value"].get<double>();
  }
  return baseline;
}

// A line and the factor between the two values.
struct Change {
  double factor;
  std::string line;
};

std::vector<std::string> sorted(std::vector<Change> changes) {
  std::ranges::stable_sort(changes, std::ranges::greater(), &Change::factor);
  std::vector<std::string> lines;
  for (Change& change : changes) lines.push_back(std::move(change.line));
  return lines;
}

struct Changes {
  std::vector<Change> worse, better;
  std::vector<std::string> information;
};

void compare_one(const NamedValue& now, double before, double slack, Changes& result) {
  using enum NamedValue::Kind;
  const double margin = now.kind == error ? slack * before : 0;
  switch (now.kind) {
    case information:
      if (now.unit == "s") result.information.push_back(both(now.name, now.value, before) + " s");
      return;
    case size:
      if (now.value != before) {
        result.worse.push_back({kInfinity, both(now.name, now.value, before)});
      }
      return;
    case count:
    case error:
      break;
  }
  // 0 on the other side of a change is a factor beyond all others.
  const std::string line = both(now.name, now.value, before);
  if (now.value > before + margin) result.worse.push_back({now.value / before, line});
  if (now.value < before - margin) result.better.push_back({before / now.value, line});
}

}  // namespace

Baseline read_baseline(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::error_code none;
  if (!file || std::filesystem::is_directory(path, none)) {
    const int problem = file ? EISDIR : errno;
    throw tables::Error(
        {.file = path, .rule = "cannot be read: " + std::string(strerror(problem))});
  }
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  try {
    return by_name(path, nlohmann::json::parse(text));
  } catch (const nlohmann::json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    refuse(path, 1 + static_cast<std::size_t>(std::count(text.begin(), end, '\n')));
  } catch (const nlohmann::json::exception&) {  // a number beyond doubles, without its place
    refuse(path, 0);
  }
}

Comparison compare(const std::vector<CorpusReport>& corpora, const Baseline& baseline,
                   double slack) {
  Comparison result;
  Changes changes;
  std::set<std::string> seen;
  std::map<std::string, bool> known;  // of each corpus: does the baseline have anything?
  for (const NamedValue& now : values_of(corpora)) {
    seen.insert(now.name);
    bool& compared = known[now.name.substr(0, now.name.find('/'))];
    const auto before = baseline.find(now.name);
    if (before == baseline.end()) {
      result.unknown.push_back(now.name);
    } else {
      compared = true;
      compare_one(now, before->second, slack, changes);
    }
  }
  for (const auto& [corpus, compared] : known) {
    if (!compared) changes.worse.push_back({kInfinity, corpus + ": nothing of it is there"});
  }
  for (const auto& [name, value] : baseline) {
    const std::string corpus = name.substr(0, name.find('/'));
    const bool graded = std::ranges::find(corpora, corpus, &CorpusReport::name) != corpora.end();
    // Answers from a file have no time.
    if (graded && !seen.contains(name) && name != corpus + "/time") {
      changes.worse.push_back({kInfinity, name + ": in the baseline, and not graded now"});
    }
  }
  result.worse = sorted(std::move(changes.worse));
  result.better = sorted(std::move(changes.better));
  result.information = std::move(changes.information);
  return result;
}

}  // namespace tangency::inline v0::verify
