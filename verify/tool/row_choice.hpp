// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Options that say which rows are graded: of which corpora, drawn from which seed, and which rows
/// are set aside.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <tangency/geometry/tables/command_line.hpp>
#include <tangency/verify/answers/claims.hpp>
#include <tangency/verify/answers/corpus_source.hpp>
#include <tangency/verify/grade/report.hpp>

namespace tangency::inline v0::verify {

/// Seed 0 means the committed rows.
struct RowChoice {
  std::string folder;       ///< --corpora
  std::size_t seed = 0;     ///< --seed
  std::size_t rows = 0;     ///< --rows, of a family; 0: as many as are committed
  std::string not_claimed;  ///< --not-claimed
  std::string expected;     ///< --expected
};

/// --seed, --rows.
void add_seed_options(tables::Command& command, RowChoice& choice);

/// These, --corpora, --not-claimed and --expected.
void add_row_options(tables::Command& command, RowChoice& choice);

/// @throws tables::UsageError  --rows without --seed
void require_seed(const RowChoice& choice);

/// @throws tables::UsageError  options that exclude each other, or fresh rows of a program without
///                             oracles
/// @throws tables::Error       a folder that cannot be read
CorpusSource source_of(const RowChoice& choice);

/// Rows that are not judged as others are.
struct SetAside {
  std::vector<std::string> not_claimed;  ///< features
  ExpectedFailures expected;
};

/// The features in a value of --not-claimed.
/// @throws tables::Error  a word that is none
std::vector<std::string> features_in(const std::string& text);

/// @throws tables::Error  a word that is no feature; what ExpectedFailures refuses
SetAside set_aside(const RowChoice& choice, const CorpusSource& source);

/// What of this a reader has to know to take the same grade again.
Facts facts_of(const RowChoice& choice, const CorpusSource& source);

/// What --help says of them.
std::string help_on_features();

/// Of a seed: nothing, or what is wrong with it.
std::string check_seed(const std::string& text);

}  // namespace tangency::inline v0::verify
