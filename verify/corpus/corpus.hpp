// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Golden corpora: inputs by families, and what is true of them, as the two tables NAME.csv and
/// NAME.truth.csv. Inputs are hex floats, exactly the doubles meant, in the columns of `tangency
/// contact`, `ellipse`, `classify`, `point`, `wall`, `ray`, `time` or `neighbours`.
///
/// Truth tables, one line an input, and for gaps one line a maximising normal:
///
///   all       row, from 0; family
///   pairs     relation, inner; size L = |d| + both largest semi-axes; gap; normals: point, circle
///             (all turns of nx ny nz about ax ay az) or all; pw.gap, pw.nx, pw.ny, pw.nz,
///             mp.gap and cl.gap: the definitions perram-wertheim, midpoint-potential (of the same
///             normal) and centre-line, empty where they do not apply
///   ellipses  relation, inner, crossings (empty when equal), size, area, smaller_area, gap;
///             normals: point or all; nx, ny
///   quadrics  type
///   points    p.size L = |p - c| + largest semi-axis; gap, the signed distance; normals as of
///             pairs
///   walls     relation, inner; w.size L = distance of the centre from the face + largest
///             semi-axis; gap; normals as of pairs
///   rays      r.size L / |direction|, L = |origin - c| + largest semi-axis; result: hit, miss or
///             grazing; t1, t2, empty where the ray has no such point
///   times     tolerance; status: none, contact, touching_at_start or grazing; earliest, latest:
///             the first contact lies between, empty where there is none
///   matrices  as pairs, but m.size
///   floats    as pairs, but float.size = 2^-24 L: every number of the inputs is a float
///   neighbours  a row a body i: j, ix, iy, iz and relation of a pair of images that shares a
///             point, a line each: b is body j moved by the cell's lengths times (ix, iy, iz), and
///             i < j, or i = j and the image comes after 0 0 0. Empty of a body that is i of none
///
/// Inputs of neighbours have the cell in every row, in columns cell.x cell.y cell.z; 0 is an open
/// direction.
///
/// Identities: (1) the same bytes every time, on every machine with IEEE doubles; (2) the first k
/// rows of a family do not depend on how many there are, but for neighbours, whose truth is one of
/// all rows.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <tangency/verify/families/pair.hpp>

namespace tangency::inline v0::verify {

enum class CorpusKind {
  pairs,
  ellipses,
  quadrics,
  points,
  walls,
  rays,
  times,
  matrices,
  floats,
  neighbours
};

/// In the order of the enumerators, whose names they are.
inline constexpr std::array<std::string_view, 10> kKindNames{
    "pairs", "ellipses", "quadrics", "points", "walls",
    "rays",  "times",    "matrices", "floats", "neighbours"};

constexpr std::string_view name(CorpusKind kind) {
  return kKindNames[static_cast<std::size_t>(kind)];
}

/// Nothing for a word that names none.
constexpr std::optional<CorpusKind> kind_named(std::string_view word) {
  const auto* const found = std::ranges::find(kKindNames, word);
  if (found == kKindNames.end()) return std::nullopt;
  return static_cast<CorpusKind>(found - kKindNames.begin());
}

struct CorpusInfo {
  std::string_view name;
  CorpusKind kind;
  std::string_view what;         ///< one line
  std::array<double, 3> cell{};  ///< edges of a periodic one, of neighbours
};

std::span<const CorpusInfo> corpora();

struct CorpusText {
  std::string inputs, truth;
};

inline constexpr std::size_t kWholeFamily = static_cast<std::size_t>(-1);

/// The committed rows, or with another seed than 0 others of the same families.
/// @param rows  of every family; kWholeFamily: as many as the committed corpus has. A family of
///              integers has no more than 300. Of neighbours a row is a body.
/// Throws std::invalid_argument for a name that corpora() does not list.
CorpusText generate(std::string_view name, std::size_t rows = kWholeFamily, std::uint64_t seed = 0);

/// The header of a table of pairs, and the cells of one.
std::string_view pair_columns();
std::string pair_cells(const EllipsoidPair& pair);

/// A row of a corpus that is made by hand or found.
struct NamedPair {
  std::string family;  ///< of letters, digits, spaces and .+-
  std::string note;    ///< one line, a comment above the row in both tables
  EllipsoidPair pair;
};

/// A corpus of these pairs in this order. Where the oracle does not prove the gap a row has its
/// relation alone.
/// @param comment  one line, at the head of both tables
CorpusText corpus_of(std::span<const NamedPair> pairs, std::string_view comment);

}  // namespace tangency::inline v0::verify
