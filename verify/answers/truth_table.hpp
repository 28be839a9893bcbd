// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The truth of a corpus as a grader holds it: NAME.truth.csv (verify/corpus/corpus.hpp), read
/// back.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tangency/geometry/tables/csv.hpp>
#include <tangency/verify/corpus/corpus.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace tangency::inline v0::verify {

/// A number of 40 digits as the sum of two doubles, to 2^-106 of itself.
struct TwoDoubles {
  double high = 0, low = 0;
  bool operator==(const TwoDoubles&) const = default;
};

/// Which gap and normal are meant; centre_line has no normal.
enum class Definition { common_normal, perram_wertheim, midpoint_potential, centre_line };

/// A true normal (of ellipses with z = 0); of a circle, all turns about `axis`.
struct Maximiser {
  std::array<double, 3> normal;
  std::optional<std::array<double, 3>> axis;
};

/// A pair of the neighbours of body i, whose row this is of.
struct TrueNeighbour {
  std::size_t j = 0;
  std::array<int, 3> image{};
  auto operator<=>(const TrueNeighbour&) const = default;
};

/// How an answer to a row is counted (claims.hpp).
enum class Standing {
  judged,
  not_claimed,       ///< the tool has opted out of it: no answer is judged
  expected_failure,  ///< known to be answered wrongly: a fault is counted apart
};

/// What is true of an input; which members count depends on the kind.
struct TruthRow {
  std::size_t family = 0;
  Relation relation = Relation::separate;
  double size = 1;                ///< unit of the errors of gap and time
  std::optional<TwoDoubles> gap;  ///< nothing where the definition does not apply
  bool every_normal = false;
  std::size_t first_normal = 0, normals = 0;  ///< in TruthTable::maximisers
  int crossings = -1;                         ///< of ellipses; -1: equal
  double area = 0, smaller_area = 1;          ///< of ellipses
  std::string word;  ///< type of a quadric, result of a ray, status of a time
  /// Of a ray: t1 and t2. Of a time: between which the first contact lies.
  std::array<std::optional<TwoDoubles>, 2> times{};
  std::size_t first_neighbour = 0, neighbours = 0;  ///< in TruthTable::neighbours
  Standing standing = Standing::judged;
};

struct TruthTable {
  CorpusKind kind;
  std::vector<std::string> families;  ///< in the order of their first rows
  std::vector<TruthRow> rows;
  std::vector<Maximiser> maximisers;
  std::vector<TrueNeighbour> neighbours;  ///< of one row after another, each row's in order
  bool has_normals = false;
};

/// By the columns (verify/corpus/corpus.hpp), of which each kind but pairs has one of its own.
CorpusKind kind_of_truth(const tables::Header& header);

/// `definition` is for pairs, matrices and floats; it changes nothing else. Throws tables::Error: a
/// table that cannot be read, lacks a column, skips a row or returns to one.
TruthTable read_truth(tables::Reader&& file, Definition definition);

/// `relation` says the interiors meet.
constexpr bool interiors_meet(Relation relation) {
  return relation != Relation::separate && relation != Relation::external_touch;
}

/// Nothing for a word that names none.
std::optional<Relation> relation_named(std::string_view word);

}  // namespace tangency::inline v0::verify
