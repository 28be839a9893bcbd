// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Golden corpora: inputs by families, and what is true of them, as the two tables NAME.csv and
/// NAME.truth.csv. Inputs are hex floats, exactly the doubles meant, in the columns of `tangency
/// contact`, `ellipse` or `classify`.
///
/// Truth tables, one line an input, and for ellipsoids and ellipses one line a maximising normal:
///
///   all       row, from 0; family
///   pairs     relation, inner; size L = |d| + both largest semi-axes; gap; normals: point, circle
///             (all turns of nx ny nz about ax ay az) or all; pw.gap, pw.nx, pw.ny, pw.nz,
///             mp.gap and cl.gap: the definitions perram-wertheim, midpoint-potential (of the same
///             normal) and centre-line, empty where they do not apply
///   ellipses  relation, inner, crossings (empty when equal), size, area, smaller_area, gap;
///             normals: point or all; nx, ny
///   quadrics  type
///
/// Identities: (1) the same bytes every time, on every machine with IEEE doubles; (2) the first k
/// rows of a family do not depend on how many there are.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include <tangency/verify/families/pair.hpp>

namespace tangency::inline v0::verify {

enum class CorpusKind { pairs, ellipses, quadrics };

struct CorpusInfo {
  std::string_view name;
  CorpusKind kind;
  std::string_view what;  ///< one line
};

std::span<const CorpusInfo> corpora();

struct CorpusText {
  std::string inputs, truth;
};

inline constexpr std::size_t kWholeFamily = static_cast<std::size_t>(-1);

/// Throws std::invalid_argument for a name that corpora() does not list.
CorpusText generate(std::string_view name, std::size_t most_per_family = kWholeFamily);

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
