// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Where a hunt begins: rows of corpora, and pairs that the families of the corpora draw anew, so
/// that nobody who is right on the committed rows is safe from the others.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tangency/verify/answers/corpus_source.hpp>
#include <tangency/verify/families/families.hpp>

namespace tangency::inline v0::verify {

/// Has rows, families, or both.
struct Source {
  std::string name;                 ///< of the corpus
  std::vector<EllipsoidPair> rows;  ///< of its table
  PairFamilies families;            ///< none of a corpus that is not of this project
};

/// The corpora of kind pairs of these names, or all without any.
/// Throws tables::Error: a name that is not there, a corpus of another kind or without rows, a
/// table that cannot be read or has a body that is none.
std::vector<Source> hunt_sources(const CorpusSource& corpora,
                                 const std::vector<std::string>& names);

/// The families alone of every corpus of pairs: no file is read.
std::vector<Source> family_sources();

/// The rows of a table with the columns of `tangency contact`.
std::vector<EllipsoidPair> read_pairs(tables::Reader& table);

}  // namespace tangency::inline v0::verify
