// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Makes a pair that a subject answers wrongly as simple as the same kind of fault allows: bodies
/// moved to the origin, turned straight, made round and alike, lengths near 1, zeros, and numbers
/// of few digits.
///
/// (1) The result has the fault of the start.
/// (2) Each step lowers simplicity(), so there is an end; the next steps are asked all at once, and
///     the simplest that keeps the fault is taken.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <tangency/verify/hunt/verdict.hpp>

namespace tangency::inline v0::verify {

/// Digits to be written down, and a little for every number that is not 0 or 1: less is simpler.
double complexity(const EllipsoidPair& pair);

/// The most significant decimal digits that one of its numbers has.
int most_digits(const EllipsoidPair& pair);

struct Shrunk {
  EllipsoidPair pair;
  Verdict verdict;
  Answer answer;            ///< empty where the fault is that there is none
  std::size_t answers = 0;  ///< that it took
};

/// @param fault  of `start`, as the judge names it
/// @param most  answers to ask for at most
/// @returns the start, as it is answered now, where nothing simpler has the fault. Its verdict has
///     another fault or none where the subject now answers it otherwise. Where the hunt has to end
///     before that `answers` is 0 and the verdict is empty; later, it is the simplest so far
Shrunk shrunk(Subject& subject, Judge& judge, const EllipsoidPair& start, const std::string& fault,
              std::size_t most);

}  // namespace tangency::inline v0::verify
