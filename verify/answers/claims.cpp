// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/answers/claims.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include <tangency/geometry/tables/csv.hpp>

namespace tangency::inline v0::verify {
namespace {

constexpr std::array kFeatures{
    Feature{"touching", "bodies that only touch, from outside or from inside"},
    Feature{"near", "gaps of either sign, not 0, of at most 1e-9 L"},
    Feature{"nested", "one body inside the other, or equal to it"},
    Feature{"deep", "overlaps deeper than L / 10"},
    Feature{"ties", "several normals that are equally true"},
    Feature{"extreme", "the corpus extreme, and families at extreme scales, shapes and origins"},
};

// Families of other corpora than extreme.
constexpr std::array<std::string_view, 3> kExtremeFamilies{"extreme", "extreme_scale",
                                                           "far_origin"};

bool touches(const TruthRow& row) {
  return row.relation == Relation::external_touch || row.relation == Relation::internal_touch ||
         (row.gap && *row.gap == TwoDoubles{}) || row.word == "grazing" ||
         row.word == "touching_at_start";
}

bool has_ties(const TruthTable& truth, const TruthRow& row) {
  return row.every_normal || row.normals > 1 ||
         (row.normals == 1 && truth.maximisers.at(row.first_normal).axis);
}

}  // namespace

std::span<const Feature> features() { return kFeatures; }

bool is_nested(Relation relation) {
  using enum Relation;
  return relation == a_in_b || relation == b_in_a || relation == internal_touch ||
         relation == equal;
}

bool has_feature(std::string_view feature, std::string_view corpus, const TruthTable& truth,
                 const TruthRow& row) {
  const double unit = truth.kind == CorpusKind::floats ? std::ldexp(row.size, 24) : row.size;
  const double gap = row.gap ? row.gap->high / unit : 0;
  if (feature == "touching") return touches(row);
  if (feature == "near") return gap != 0 && std::abs(gap) <= kNearGap;
  if (feature == "nested") return is_nested(row.relation);
  if (feature == "deep") return gap < -kDeepOverlap;
  if (feature == "ties") return has_ties(truth, row);
  assert(feature == "extreme");
  return corpus == "extreme" ||
         std::ranges::find(kExtremeFamilies, truth.families[row.family]) != kExtremeFamilies.end();
}

void leave_out(std::span<const std::string> features, std::string_view corpus, TruthTable& truth) {
  for (TruthRow& row : truth.rows) {
    const auto has_it = [&](const std::string& feature) {
      return has_feature(feature, corpus, truth, row);
    };
    if (std::ranges::any_of(features, has_it)) row.standing = Standing::not_claimed;
  }
}

ExpectedFailures::ExpectedFailures(const std::string& path, const CorpusSource& source)
    : file_(path) {
  tables::Reader reader(path);
  const tables::Column corpus = reader.header().require("corpus");
  const tables::Column row = reader.header().require("row");
  std::set<std::pair<std::string, std::size_t>> seen;
  tables::for_each_row(reader, [&](const tables::RowCursor& line) {
    const std::string name(line.text(corpus));
    if (std::ranges::find(source.names(), name) == source.names().end()) {
      throw line.error(corpus, "there is no corpus of this name");
    }
    const double number = line.number(row);
    if (!(number >= 0 && number < 1e9 && number == std::floor(number))) {
      throw line.error(row, "a row is a whole number from 0");
    }
    const auto index = static_cast<std::size_t>(number);
    if (!seen.emplace(name, index).second) {
      throw line.error(row, "a row must be named only once");
    }
    rows_[name].push_back({index, line.line()});
  });
}

void ExpectedFailures::mark(const std::string& corpus, TruthTable& truth) const {
  const auto found = rows_.find(corpus);
  if (found == rows_.end()) return;
  for (const auto& [row, line] : found->second) {
    if (row >= truth.rows.size()) {
      throw tables::Error(
          {.file = file_,
           .line = line,
           .column = "row",
           .value = std::to_string(row),
           .rule = corpus + " has the rows 0 to " + std::to_string(truth.rows.size() - 1)});
    }
    Standing& standing = truth.rows[row].standing;
    if (standing == Standing::judged) standing = Standing::expected_failure;
  }
}

}  // namespace tangency::inline v0::verify
