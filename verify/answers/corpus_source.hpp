// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Where golden corpora come from: this program, which holds those of verify/corpora, a folder
/// that has NAME.csv and NAME.truth.csv of each, or a generator (verify/corpus/corpus.hpp).
///
/// A program needs no file of its own at run time: what it holds is the text of the files, byte for
/// byte. All errors are tables::Error. Not for two threads at once, but for two sources.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/geometry/tables/csv.hpp>
#include <tangency/verify/corpus/corpus.hpp>

namespace tangency::inline v0::verify {

/// The files NAME.csv and NAME.truth.csv, as they are.
struct BuiltInCorpus {
  std::string_view name, inputs, truth;
};

/// Those in this program, sorted by name: written by corpora_inside.cmake when it is built.
std::span<const BuiltInCorpus> built_in_corpora();

/// Version of their rows and truth, which verify/corpora/VERSION states: another one where a row or
/// what is true of it has changed.
std::string_view built_in_version();

/// A table of a corpus, owned.
struct CorpusTable {
  std::string file;  ///< its path, or its name where it is in this program
  std::string text;

  /// Of this table, which must outlive what reads it.
  tables::NamedText named() const { return {file, text}; }
};

class CorpusSource {
 public:
  /// The corpora in this program.
  CorpusSource();
  /// Those of a folder. Throws where it cannot be read.
  explicit CorpusSource(const std::filesystem::path& folder);
  /// Those that `make` writes, each once, when it is first asked for.
  using Maker = std::function<CorpusText(const std::string& name)>;
  CorpusSource(std::span<const CorpusInfo> corpora, Maker make);

  /// Sorted.
  const std::vector<std::string>& names() const { return names_; }
  /// Throws for a name that is not one of names(), naming those that are.
  /// @param option  by which the user named it, for the message where there is no folder
  void require(const std::string& name, const std::string& option = "--corpus") const;
  /// `wanted` in its order, or where it is empty every corpus of kind pairs. Throws for an unknown
  /// name, one that is named twice, and where there is no corpus of pairs.
  std::vector<std::string> chosen(const std::vector<std::string>& wanted) const;

  /// Empty where none is stated.
  std::string version() const;

  /// Is there a table of inputs? A folder may have the truth alone. Requires one of names().
  bool has_inputs(const std::string& name) const;
  /// These three require one of names(), and throw for a file that cannot be read.
  CorpusKind kind(const std::string& name) const;
  CorpusTable inputs(const std::string& name) const;
  CorpusTable truth(const std::string& name) const;

 private:
  CorpusTable table(const std::string& name, std::string_view BuiltInCorpus::*built_in,
                    std::string_view suffix) const;
  std::string place(const std::string& option = "--corpus") const;

  std::optional<std::filesystem::path> folder_;  // nothing: this program, or what makes them
  std::vector<std::string> names_;
  std::span<const CorpusInfo> infos_;  // of those that are made
  Maker make_;
  mutable std::map<std::string, CorpusText> made_;
};

}  // namespace tangency::inline v0::verify
