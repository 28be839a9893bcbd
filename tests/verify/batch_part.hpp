// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Some thousand pairs with what single calls and the oracle say of them, and what the batch's
/// answers are held to: gap_batch.hpp and overlap_batch.hpp, promise by promise.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <tangency/geometry/gap_batch.hpp>
#include <tangency/tests/verify/batch_families.hpp>
#include <tangency/verify/oracles/gap.hpp>

namespace tangency::testing {

/// Centre, semi-axes and orientation of A, then of B, in hexadecimal.
std::string printed(const verify::EllipsoidPair& pair);

/// What can be broken; each has a column in the table.
enum class Breach {
  sign,       ///< other than the single call's, or than the exact relation
  status,     ///< other than the single call's
  beyond,     ///< further from the single call than both errors
  bound,      ///< gap_error above gap_batch.hpp (4)
  contact,    ///< normal, arms or point beyond what is promised of them
  enclosure,  ///< of bounded_gaps()
  yes_no,     ///< other than overlaps()
  bits,       ///< depend on place, order, number, threads or form of the bodies
  cutoff,     ///< beyond it and within, or not as gap_batch.hpp (9) says
  oracle,     ///< further from the truth than gap_error
};
inline constexpr std::size_t kBreaches = 10;
const char* to_string(Breach breach);

/// The largest error over gap_error of what lanes answer, by the oracle.
struct Tightness {
  double ratio = 0;
  verify::EllipsoidPair pair;
};

struct Tally {
  long pairs = 0, answers = 0, judged = 0;
  std::array<long, kBreaches> breaches{};
  std::array<long, 5> tiers{};  ///< of signed_gaps(), Accuracy::standard()
  long of_single_calls = 0;     ///< of those, the bits of the single call
  long other_branch = 0;        ///< `local` and followed in a lane: not the single call's maximum
  Tightness rounding;   ///< of Accuracy::certified(), whose gap_error is nearly all rounding
  Tightness tolerance;  ///< of the others: an enclosure's end may well be the truth
  std::string first;    ///< the first breach, with its pair in hexadecimal

  void add(const Tally& other);
  bool kept() const;
};

/// A single call's answer, and how far its normal and arms may be off.
struct Single {
  Gap gap;
  ContactBounds bounds;
};

struct Part {
  std::vector<verify::EllipsoidPair> raw;
  std::vector<Ellipsoid> a, b;         ///< where they are
  std::vector<Ellipsoid> here, there;  ///< the same about the origin
  std::vector<Ellipsoid> bodies;       ///< A and B in turn
  std::vector<IndexedPair> pairs;
  std::vector<Vec3> separations;  ///< the rounded c_B - c_A
  std::vector<Vec3> previous;     ///< normals to be followed; some are exactly 0
  std::vector<Single> placed, separated, followed;
  std::vector<char> overlaps, overlaps_separated;
  /// Of the first pairs: by their centres, and by the separations.
  std::vector<verify::GapTruth> truth, truth_separated;
  std::vector<char> truly_overlap;
  std::vector<Vec3> semi_axes, centres;  ///< of `bodies`
  std::vector<Quaternion> orientations;

  std::size_t size() const { return raw.size(); }
};

/// @param judged  how many of them the oracle is asked about
Part made_part(const BatchFamily& family, std::uint64_t seed, std::size_t count,
               std::size_t judged);

/// Every call on a part, with the instruction set that is chosen now.
/// @param level  its name
/// @param number  of the part: which orders and numbers of threads are tried depends on it
void check_part(const Part& part, const std::string& level, std::size_t number, Tally& tally);

/// What single calls and oracle alone say, once a part.
void check_singles(const Part& part, Tally& tally);

}  // namespace tangency::testing
