// SPDX-License-Identifier: MIT
/// @file
/// Contacts and neighbours of a state, asked for a second time by ways of their own: the exact
/// relation of geometry/relation.hpp for pairs, and all pairs instead of a search for neighbours.
///
/// The simulator knows that a pair touches by the sign of its gap, which lanes answer that follow
/// it from step to step (narrow_phase.hpp). Here nothing is followed: every question is about the
/// numbers of the state alone. Ellipsoids have to agree in every case. Spheres, plane bodies and
/// walls are measured by formulas in double there; a pair of them within kFormulaRounding of a
/// touch may have either answer, and is counted apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tangency/dem/contact/narrow_phase.hpp>
#include <tangency/dem/simulation.hpp>
#include <tangency/geometry/body_array.hpp>
#include <tangency/geometry/ellipse.hpp>
#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// A pair about which the state and a check disagree.
struct Disagreement {
  Pair pair;         ///< by the indices of the state
  std::string what;  ///< the state's answer and that of the check, one line
};

/// What a check looked at and found.
struct CheckCounts {
  std::int64_t contacts = 0;  ///< pairs that touch, by the state and exactly
  std::int64_t apart = 0;     ///< listed pairs that do not, by the state and exactly
  std::int64_t rounded = 0;   ///< of both: at a touch, to rounding, where a formula answers
  std::int64_t depths = 0;    ///< contacts whose overlap and normal are those of a touch
  std::int64_t followed = 0;  ///< of them: with a shorter way out than the branch followed
  std::int64_t searched = 0;  ///< bodies whose neighbours were looked for among all bodies
  std::int64_t wrong = 0;     ///< contacts that touch by the state alone, or elsewhere or deeper
  std::int64_t missed = 0;    ///< pairs that touch exactly and not by the state, listed or not
  std::optional<Disagreement> first = {};  ///< of all that are wrong or missed, by the pair

  /// Adds term by term.
  CheckCounts& operator+=(const CheckCounts& other);
};

/// The bodies of a state, and the questions that are asked of them.
class ContactCheck {
 public:
  ContactCheck() = default;
  ContactCheck(const ContactCheck&) = delete;
  ContactCheck& operator=(const ContactCheck&) = delete;

  /// Contacts of which one in so many has its depth checked, by turns. Chosen: with the rest of
  /// the checks a cycle takes less than three times as long (docs/runs.md).
  static constexpr std::int64_t kDepthTurns = 16;

  /// Takes over the bodies as they are. Before each of the questions below.
  void aim(const Particles& particles);

  /// Every listed pair: touches it by the state if and only if the interiors meet? And of those
  /// whose turn it is: is the branch vector that of the places, and moves the overlap along the
  /// normal the bodies to where they just touch?
  CheckCounts check_listed(const Simulation& simulation);

  /// Bodies first to first + count - 1, modulo their number, against all others, images and walls:
  /// is what touches listed?
  CheckCounts check_unlisted(const Simulation& simulation, std::size_t first, std::size_t count);

 private:
  CheckCounts check_chunk(const Simulation& simulation, std::size_t first, std::size_t last);
  void check_pair(const Simulation& simulation, std::size_t k, bool meet, CheckCounts& counts);
  void check_depth(const Simulation& simulation, std::size_t k, CheckCounts& counts) const;
  void search_body(const State& state, std::size_t first, std::size_t turn,
                   CheckCounts& counts) const;
  void require_listed(const State& state, const Pair& pair, CheckCounts& counts) const;
  bool meet(const State& state, const Pair& pair, const Vec3& separation) const;
  double gap(const State& state, const Pair& pair, const Vec3& separation) const;
  double depth_along(const State& state, const Pair& pair, const Vec3& separation,
                     const Vec3& normal) const;
  bool is_near_a_touch(const State& state, const Pair& pair, const Vec3& separation) const;
  double size_of(const Pair& pair, const Vec3& separation) const;

  bool by_formula_ = false;            ///< are pairs of particles measured in double?
  std::vector<double> radii_;          ///< of bounding spheres
  std::vector<Vec3> reduced_;          ///< places in parts of the cell's edges
  std::vector<Ellipsoid> ellipsoids_;  ///< in space: of all
  std::vector<Ellipse> ellipses_;      ///< in the plane: of all
  std::optional<BodyArray> array_;     ///< in space: of ellipsoids_
  std::vector<IndexedPair> pairs_;     ///< listed, of the chunks; walls as the body with itself
  std::vector<Vec3> separations_;      ///< of pairs_
  std::vector<std::uint8_t> meet_;     ///< their answers
};

}  // namespace tangency::inline v0::dem
