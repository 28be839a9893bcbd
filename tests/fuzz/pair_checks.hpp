// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the calls of the kernel say of one pair, held against each other: relation, sign, exchange
/// of the bodies, scaling, batches and single calls.
#pragma once

#include <cstdint>
#include <string>

#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/tests/fuzz/pair_input.hpp>
#include <tangency/verify/families/pair.hpp>

namespace tangency::testing::fuzz {

/// Do the interiors meet?
bool meets(Relation relation);

/// What is proven of the true gap: from `low` to `high`, which is infinite of a `local` one.
struct Enclosure {
  long double low, high;
};
Enclosure enclosure_of(double gap, double below, double above);
Enclosure enclosure_of(const Gap& gap);

/// Have two enclosures of one number a number in common? Roundings of the sums are allowed for.
bool meet(const Enclosure& one, const Enclosure& other);

/// Is the gap > 0, 0 or < 0 as the relation says?
bool has_sign(double gap, Relation relation);

/// Every check of a pair that costs some microseconds.
/// @param target  named where a promise is broken
/// @param choice  of the power of two, the accuracy and the cutoff that are tried
void check_pair(const std::string& target, const verify::EllipsoidPair& raw, const Bodies& bodies,
                std::uint64_t choice);

/// The gap and yes/no of a pair of which something is known.
void check_known(const std::string& target, const verify::EllipsoidPair& raw, const Bodies& bodies,
                 const Enclosure& known);

/// The further calls: other gaps, walls, balls, rays, derivatives with curvatures; of one choice in
/// 4 the time of contact, of one in 16 the trace, of one the common volume, of one in 1024
/// containment, which would take as long as all others together.
void check_further(const std::string& target, const verify::EllipsoidPair& raw,
                   const Bodies& bodies, std::uint64_t choice);

/// The relation by the exact oracle.
void check_by_oracle(const std::string& target, const verify::EllipsoidPair& raw,
                     const Bodies& bodies);

}  // namespace tangency::testing::fuzz
