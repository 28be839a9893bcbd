// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/tool/row_choice.hpp>

#include <algorithm>
#include <sstream>
#include <string_view>

#include <tangency/verify/corpus/corpus.hpp>
#include <tangency/verify/tool/asking.hpp>

namespace tangency::inline v0::verify {
namespace {

// Chosen: three quarters of what a family of integers draws (verify/families/pair_families.cpp).
constexpr std::size_t kMostRows = 300;

[[noreturn]] void refuse(const std::string& file, const std::string& rule) {
  throw tables::Error({.file = file, .rule = rule});
}

std::vector<std::string> words(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream stream(text);
  for (std::string word; std::getline(stream, word, ',');) all.push_back(word);
  return all;
}

std::string check_rows(const std::string& text) {
  double value = 0;
  const bool is_number = !tables::parse_number(text, value);
  if (is_number && value >= 1 && value <= kMostRows &&
      text.find_first_not_of("0123456789") == text.npos)
    return {};
  return text + " is not a whole number from 1 to " + std::to_string(kMostRows);
}

CorpusSource fresh([[maybe_unused]] const RowChoice& choice) {
#ifdef TANGENCY_HAS_ORACLES
  const std::size_t rows = choice.rows > 0 ? choice.rows : kWholeFamily;
  return {corpora(), [rows, seed = choice.seed](const std::string& name) {
            return generate(name, rows, seed);
          }};
#else
  throw tables::UsageError(
      "--seed: this program was built without the oracles that say what is true of fresh rows "
      "(TANGENCY_BUILD_ORACLES)");
#endif
}

}  // namespace

std::string check_seed(const std::string& text) {
  double value = 0;
  constexpr double kMost = 1e18;  // chosen: below what the seed's type holds
  if (text.find_first_not_of("0123456789") == text.npos && !tables::parse_number(text, value) &&
      value <= kMost)
    return {};
  return text + " is not a whole number from 0 to 1e18";
}

void add_seed_options(tables::Command& command, RowChoice& choice) {
  command
      .option("--seed", choice.seed,
              "Draw the rows of every family anew from this seed, with their truth, so that no "
              "program can be tuned to them (default: 0, the committed rows)")
      .check(check_seed)
      .type_name("N");
  command
      .option("--rows", choice.rows,
              "With --seed: how many rows a family has (default: as many as are committed)")
      .check(check_rows)
      .type_name("K");
}

void add_row_options(tables::Command& command, RowChoice& choice) {
  add_corpora_option(command, choice.folder);
  add_seed_options(command, choice);
  command
      .option("--not-claimed", choice.not_claimed,
              "Features that the tool does not promise, with commas between them: their rows are "
              "counted apart, and never as passed")
      .not_empty("list of features")
      .type_name("FEATURE,...");
  command
      .option("--expected", choice.expected,
              "A table with the columns corpus and row, of rows that are known to fail: they are "
              "counted apart, and those that pass are named")
      .not_empty()
      .type_name("FILE");
}

void require_seed(const RowChoice& choice) {
  if (choice.rows == 0 || choice.seed != 0) return;
  throw tables::UsageError(
      "--rows is for rows that are drawn anew: it needs a --seed other than 0");
}

CorpusSource source_of(const RowChoice& choice) {
  require_seed(choice);
  if (choice.seed == 0) return corpus_source(choice.folder);
  if (!choice.folder.empty()) {
    throw tables::UsageError("--seed draws rows, --corpora reads them: give one of the two");
  }
  if (!choice.expected.empty()) {
    throw tables::UsageError("--expected names committed rows: --seed draws others");
  }
  return fresh(choice);
}

std::vector<std::string> features_in(const std::string& text) {
  std::vector<std::string> all = words(text);
  for (const std::string& word : all) {
    if (std::ranges::find(features(), word, &Feature::name) != features().end()) continue;
    std::string rule = word + " is not a feature; these are:";
    for (const Feature& feature : features()) rule += ' ' + std::string(feature.name);
    refuse("--not-claimed", rule);
  }
  return all;
}

SetAside set_aside(const RowChoice& choice, const CorpusSource& source) {
  SetAside aside{features_in(choice.not_claimed), {}};
  if (!choice.expected.empty()) aside.expected = ExpectedFailures(choice.expected, source);
  return aside;
}

Facts facts_of(const RowChoice& choice, const CorpusSource& source) {
  Facts facts;
  const std::string version = source.version();
  if (choice.seed != 0) {
    const std::string rows =
        choice.rows > 0 ? ", " + std::to_string(choice.rows) + " rows a family" : "";
    facts.emplace_back("corpora", "drawn from seed " + std::to_string(choice.seed) + rows);
  } else {
    if (!choice.folder.empty()) facts.emplace_back("corpora", choice.folder);
    if (!version.empty()) facts.emplace_back("corpus version", version);
  }
  if (!choice.not_claimed.empty()) facts.emplace_back("not claimed", choice.not_claimed);
  if (!choice.expected.empty()) facts.emplace_back("expected failures", choice.expected);
  return facts;
}

std::string help_on_features() {
  std::string text = "\nFeatures, for --not-claimed:\n";
  for (const Feature& feature : features()) {
    std::string name(feature.name);
    name.resize(11, ' ');
    text += "  " + name + std::string(feature.what) + '\n';
  }
  return text;
}

}  // namespace tangency::inline v0::verify
