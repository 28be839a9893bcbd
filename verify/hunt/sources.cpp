// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/hunt/sources.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace tangency::inline v0::verify {
namespace {

using tables::Column;
using Columns = std::array<Column, 10>;

Columns columns_of(const tables::Header& header, const std::string& who) {
  constexpr std::array kFields{".x", ".y", ".z", ".r1", ".r2", ".r3", ".qw", ".qx", ".qy", ".qz"};
  Columns columns{};
  std::ranges::transform(kFields, columns.begin(),
                         [&](const char* field) { return header.require(who + field); });
  return columns;
}

RawEllipsoid body(const tables::RowCursor& row, const Columns& columns) {
  std::array<double, 10> v{};
  std::ranges::transform(columns, v.begin(), [&](Column c) { return row.number(c); });
  for (std::size_t k = 3; k < 6; ++k) {
    if (!(v[k] > 0)) throw row.error(columns[k], "a semi-axis must be finite and > 0");
  }
  if (std::all_of(v.begin() + 6, v.end(), [](double q) { return q == 0; })) {
    throw row.error(columns[6], "an orientation must not be 0");
  }
  return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8], v[9]}};
}

bool has_families(const std::string& name) {
  return std::ranges::any_of(corpora(), [&](const CorpusInfo& known) {
    return known.name == name && known.kind == CorpusKind::pairs;
  });
}

void require_pairs(const CorpusSource& corpora, const std::vector<std::string>& names) {
  if (names.empty()) return;
  const std::vector<std::string> pairs = corpora.chosen({});
  for (const std::string& name : names) {
    if (std::ranges::find(pairs, name) != pairs.end()) continue;
    std::string rule = "there is no corpus of pairs " + name + " here; there are:";
    for (const std::string& known : pairs) rule += ' ' + known;
    throw tables::Error({.file = "--from", .rule = rule});
  }
}

}  // namespace

std::vector<EllipsoidPair> read_pairs(tables::Reader& table) {
  const Columns a = columns_of(table.header(), "a"), b = columns_of(table.header(), "b");
  std::vector<EllipsoidPair> pairs;
  tables::for_each_row(table, [&](const tables::RowCursor& row) {
    pairs.push_back({body(row, a), body(row, b)});
  });
  return pairs;
}

std::vector<Source> hunt_sources(const CorpusSource& corpora,
                                 const std::vector<std::string>& names) {
  std::vector<Source> sources;
  require_pairs(corpora, names);
  for (const std::string& name : corpora.chosen(names)) {
    const CorpusTable inputs = corpora.inputs(name);
    tables::Reader reader(inputs.named());
    Source source{name, read_pairs(reader), {}};
    if (source.rows.empty()) {
      throw tables::Error({.file = inputs.file, .rule = "a corpus must have rows"});
    }
    if (has_families(name)) source.families = pair_families(name);
    sources.push_back(std::move(source));
  }
  return sources;
}

std::vector<Source> family_sources() {
  std::vector<Source> sources;
  for (const CorpusInfo& corpus : corpora()) {
    const std::string name(corpus.name);
    if (corpus.kind == CorpusKind::pairs) sources.push_back({name, {}, pair_families(name)});
  }
  return sources;
}

}  // namespace tangency::inline v0::verify
