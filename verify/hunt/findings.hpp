// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a hunt found: of each kind of fault the simplest pairs, made simpler still, as text and as
/// rows of a corpus (found_corpus.hpp).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <tangency/verify/corpus/corpus.hpp>
#include <tangency/verify/hunt/search.hpp>
#include <tangency/verify/hunt/shrink.hpp>

namespace tangency::inline v0::verify {

struct HuntFinding {
  std::string fault;
  std::string source;     ///< the corpus that it descends from
  std::string traits;     ///< "long, near"; "plain" for none
  std::size_t found = 0;  ///< the number of the answer, from 1
  EllipsoidPair before;   ///< as it was found
  Shrunk simple;
  bool asked = true;            ///< again; false where the hunt had to end: it is as it was found
  bool again = true;            ///< asked again, the subject made the same fault
  std::optional<double> gap{};  ///< the true one, where the oracle proves it
};

/// Of the `most` most frequent kinds of fault one pair each, or up to three where the kinds are
/// fewer: those with the fewest traits first, of which each has, when it is simple, traits of its
/// own. A fault that does not come again is one, unshrunk.
/// @param answers  to ask for at most, for one pair
std::vector<HuntFinding> findings(const Search& search, Subject& subject, std::size_t most,
                                  std::size_t answers);

/// "a  centre 0 0 0  semi-axes 1 1 1  turned 1 0 0 0", and so for b: decimals that read back.
std::string pair_text(const EllipsoidPair& pair);

/// Some lines a finding: what was answered, what is true, the pair.
std::string finding_text(const HuntFinding& finding, std::size_t number);

/// A row a finding, the family its fault.
std::vector<NamedPair> named(const std::vector<HuntFinding>& findings);

}  // namespace tangency::inline v0::verify
