// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a tool does not claim to do, and where it is known to fail: which rows of a corpus are
/// judged.
///
/// A feature is a property of the truth of a row, or of its family, that some codes do not promise
/// to get right. A tool that opts out of one is not judged on its rows; they are counted apart, as
/// not claimed, and are never part of what passed. Identities: (1) leaving out a feature changes no
/// count and no error of the rows that are still judged; (2) the order of features means nothing.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/verify/answers/corpus_source.hpp>
#include <tangency/verify/answers/truth_table.hpp>

namespace tangency::inline v0::verify {

/// In L: a gap of either sign up to this is near. Chosen: between the tolerances of codes that have
/// one and the rounding of those that have none.
inline constexpr double kNearGap = 1e-9;
/// In L: an overlap beyond this is deep. Chosen: deeper than contacts of stiff bodies are.
inline constexpr double kDeepOverlap = 0.1;

struct Feature {
  std::string_view name;
  std::string_view what;  ///< one line: which rows have it
};

/// touching, near, nested, deep, ties, extreme.
std::span<const Feature> features();

/// One body inside the other, or equal to it.
bool is_nested(Relation relation);

/// `feature` is one of features(); `row` one of `truth`, which is of the corpus of this name.
bool has_feature(std::string_view feature, std::string_view corpus, const TruthTable& truth,
                 const TruthRow& row);

/// Rows that have one of these features become not claimed.
void leave_out(std::span<const std::string> features, std::string_view corpus, TruthTable& truth);

/// Rows that are known to be answered wrongly: a table with the columns corpus and row.
class ExpectedFailures {
 public:
  ExpectedFailures() = default;
  /// @throws tables::Error  a file that cannot be read, a corpus that the source does not have, a
  ///                        row that is no whole number from 0, and a row that is named twice
  ExpectedFailures(const std::string& path, const CorpusSource& source);

  /// These rows of the corpus become expected failures, but for those that are not claimed.
  /// @throws tables::Error  a row that the corpus does not have
  void mark(const std::string& corpus, TruthTable& truth) const;

 private:
  struct Row {
    std::size_t row, line;
  };
  std::string file_;
  std::map<std::string, std::vector<Row>> rows_;  // of each corpus
};

}  // namespace tangency::inline v0::verify
