// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a grade comes upon in an answer, and what it asks for.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include <tangency/verify/corpus/corpus.hpp>

namespace tangency::inline v0::verify {

enum class Problem { wrong, missing, broken_bound, reversed, gap_error, normal_error };

/// What is at fault in the answer to one row.
struct Finding {
  std::size_t row;
  Problem problem;
  std::string column;    ///< "relation", "nx ny nz"; nothing where the whole row is missing
  std::string answered;  ///< as it stands in the answers, or nothing
  std::string truth;     ///< a word or a number, as an answer would say it; nothing where none is
  double error = 0;      ///< in the unit of its summary
};

/// What an error may be of.
enum class ErrorKind : std::size_t { gap, normal, area, time };
inline constexpr std::size_t kErrorKinds = 4;

/// What errors of normals are given in.
constexpr double normal_unit(CorpusKind kind) { return kind == CorpusKind::floats ? 0x1p-24 : 1; }

/// Asked of every row even where the answers' header does not offer it; of numbers the largest
/// error without a finding.
struct Demands {
  bool words = false;
  std::optional<double> gap{}, normal{};
};

}  // namespace tangency::inline v0::verify
