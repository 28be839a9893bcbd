// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The search: generations of pairs, from fresh ones and from the worst so far, and an archive with
/// one place for each kind of fault and set of traits, where the worst pair of that kind stays.
/// Right answers have places of their own, so that the search is led to where they are nearly
/// wrong.
///
/// (1) What a generation asks depends on seed, sources, number of the generation and the answers
///     before it, and on nothing else: neither on time nor on how a subject batches.
/// (2) A search that is saved between generations and read back goes on as if it had not been.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tangency/verify/hunt/sources.hpp>
#include <tangency/verify/hunt/verdict.hpp>

namespace tangency::inline v0::verify {

/// The worst pair of a kind.
struct Elite {
  EllipsoidPair pair;
  std::string source;  ///< the corpus that its first ancestor is of
  double badness = 0, error = 0;
  std::size_t found = 0;  ///< the number of the answer, from 1
  Nearness near;
};

struct FaultCount {
  std::size_t count = 0, first = 0;  ///< the first one's number of the answer, from 1
};

/// By kind of fault ("" for right answers) and traits.
using Archive = std::map<std::pair<std::string, std::uint16_t>, Elite>;

class Search {
 public:
  /// @param sources  at least one, each with rows or families
  Search(Judge& judge, std::vector<Source> sources, std::uint64_t seed);

  /// Asks one generation, the first of 16 pairs, each twice as large as the one before up to 512,
  /// of which no more than `most`.
  /// @returns whether it is whole: all of its pairs were answered. Else what was answered counts,
  ///     and the search can no longer be saved
  bool step(Subject& subject, std::size_t most);

  std::size_t answers() const { return answers_; }
  const Archive& archive() const { return archive_; }
  const std::map<std::string, FaultCount>& faults() const { return faults_; }
  /// How many answers the oracles did not settle.
  std::size_t open() const { return open_; }
  /// How many were about pairs that are not claimed: nothing is said of them, and none is a start.
  std::size_t not_claimed() const { return not_claimed_; }
  Judge& judge() const { return judge_; }

  /// As text, with `question` in it: what the hunt was asked.
  std::string saved(const std::string& question) const;
  /// @returns what is wrong with the text; nothing where the search goes on from it
  std::string resume(const std::string& text, const std::string& question);

 private:
  struct Candidate {
    EllipsoidPair pair;
    std::string source;
  };

  /// The first pairs of a family in this epoch; what is in it depends on nothing else.
  struct Drawn {
    std::size_t epoch = 0;
    std::function<EllipsoidPair()> next;
    std::vector<EllipsoidPair> pairs;
  };

  Candidate fresh(Draw& draw);
  Candidate moved(Draw& draw) const;
  std::vector<Candidate> generation();
  void take(const Candidate& candidate, const Verdict& verdict);
  void refresh_picks();

  Judge& judge_;
  std::vector<Source> sources_;
  std::uint64_t seed_;
  std::size_t generation_ = 0, answers_ = 0, open_ = 0, not_claimed_ = 0;
  std::map<const InputFamily<EllipsoidPair>*, Drawn> drawn_;  // of sources_
  Archive archive_;
  std::vector<const Elite*> right_, wrong_;  // of the archive, for draws
  std::map<std::string, FaultCount> faults_;
};

/// The twenty numbers of a pair in the order of the tables' columns.
std::array<double, 20> numbers(const EllipsoidPair& pair);
EllipsoidPair pair_of(const std::array<double, 20>& numbers);

}  // namespace tangency::inline v0::verify
