// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One answer beside the truth, which the oracles give: the cheap one where it proves what is
/// asked (gap_bracket.hpp), else the exact relation, and gap and normals of 100 digits only for an
/// answer that the goal needs them for and whose relation is right.
///
///  (1) A fault is proven. What the oracles leave open is none, and is said to be open: a maximum
///      that is not proven global, or an ascent of 150 digits that does not arrive.
///  (2) Faults by the rules of `grade`: an `overlaps` of 1 on an external touch is none. Where
///      neither relation nor overlaps is answered the sign of the gap is the yes or no, and a gap
///      of 0 is neither.
///  (3) A normal is off, or reversed, where it is so from every true one and is also none that the
///      rounding of the inputs makes true (near_tie.hpp).
///  (4) A cell that cannot be read is a fault of every goal.
///  (5) A pair with a feature that is not claimed (answers/claims.hpp) has no fault, whatever is
///      answered; leaving out a feature changes no verdict on other pairs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tangency/verify/corpus/truth.hpp>
#include <tangency/verify/hunt/moves.hpp>
#include <tangency/verify/hunt/subject.hpp>
#include <tangency/verify/oracles/gap_bracket.hpp>

namespace tangency::inline v0::verify {

/// What a hunt is for. Wrong relations are faults for every goal.
enum class Goal {
  relation,     ///< relation, overlaps, or the sign of the gap
  gap,          ///< and an error of the gap above a limit
  normal,       ///< and an error of the normal above a limit, or one that points the other way
  certificate,  ///< and a gap that is further from the truth than its gap_error
};

struct Limits {
  double gap_error = 1e-12;    ///< in L, the distance of the centres and both largest semi-axes
  double normal_error = 1e-6;  ///< length of the difference to the nearest true normal
};

struct Verdict {
  std::string fault;   ///< its kind, "overlap where separate"; empty for an answer that is right
  double badness = 0;  ///< among faults of a kind, or among right answers: larger is worse
  double error = 0;    ///< of the gap / L, of the normal, or of the gap / gap_error: the goal's
  Nearness near;       ///< of the pair
  Relation truth = Relation::separate;
  bool open = false;         ///< the oracles do not settle what the goal asks
  bool not_claimed = false;  ///< (5)
};

/// Which oracle was asked, how often.
struct OracleCounts {
  std::size_t brackets = 0;   ///< the cheap one alone
  std::size_t relations = 0;  ///< the exact relation
  std::size_t gaps = 0;       ///< 100 digits
  std::size_t open = 0;       ///< of those: not proven global, so that nothing is said of the gap
};

/// Has a pair the feature, by its true relation and by where its bodies are nearest? `extreme` is
/// said of the pair itself here: its traits are long, unequal or far, or L is beyond 1e-6 to 1e6.
/// Of the others a guess of the gap that is too low may leave out a deep pair too many, and never
/// one too few.
/// @param feature  of answers/claims.hpp; not `ties`: a hunt takes every true normal as true
bool has_feature(std::string_view feature, const EllipsoidPair& pair, const Nearness& near,
                 Relation truth);

class Judge {
 public:
  /// @param not_claimed  features as has_feature() takes them
  Judge(Goal goal, const Limits& limits, std::vector<std::string> not_claimed = {})
      : goal_(goal), limits_(limits), not_claimed_(std::move(not_claimed)) {}

  Goal goal() const { return goal_; }
  const Limits& limits() const { return limits_; }
  const OracleCounts& counts() const { return counts_; }

  Verdict verdict(const EllipsoidPair& pair, const std::optional<Answer>& answer);

 private:
  Goal goal_;
  Limits limits_;
  std::vector<std::string> not_claimed_;
  OracleCounts counts_;
};

/// Where the bodies are nearest, by the cheap oracle.
Nearness nearness(const GapBracket& bracket);

}  // namespace tangency::inline v0::verify
