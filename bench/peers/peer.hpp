// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Other codes' answers to how two ellipsoids touch, behind one interface: each peer takes the same
/// bodies in the same convention (semi-axes along body axes, quaternion w x y z of any length) and
/// answers in space coordinates with our signs (gap > 0 apart, normal from A to B).
///
/// Peers differ in what they answer, so each states its version, its options and the definition of
/// its depth, read from the source of that version; a comparison of depths is one of accuracy only
/// among peers of one definition.
///
/// Plain C++17, since there are peers whose headers are no C++20.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tangency/verify/oracles/plain_bodies.hpp>

namespace tangency::peers {

using verify::RawEllipsoid;
using Point = std::array<double, 3>;

/// What a peer says of one pair. What it does not define, or did not find, is absent.
struct PeerContact {
  bool overlap;                 ///< do the solids overlap? Every peer answers this
  std::optional<double> gap;    ///< distance, or minus the depth by the peer's definition
  std::optional<Point> normal;  ///< unit, from A to B
  std::optional<Point> point;   ///< contact point: where the peer puts it, between both surfaces
};

/// What the gap of a peer is.
enum class Definition {
  common_normal,  ///< our signed gap: n . d - h_A(n) - h_B(n), n the common normal
  /// The distance of the origin from the last portal of a portal refinement (MPR): a triangle on
  /// the difference of the bodies, where the line of centres leaves it. With the tolerance it tends
  /// to the depth along that line, which is not the gap to first order.
  portal,
  perram_wertheim,  ///< between the tangent planes with the normal of the Perram-Wertheim function
};

/// Of which pairs a peer gives a gap: asked for a yes or no alone, of none.
enum class GapOf { all, overlapping, separate, none };

struct PeerDescription {
  std::string name;       ///< of the library
  std::string version;    ///< as the library that is linked tells it, or its header
  std::string call;       ///< the entry that answers
  std::string options;    ///< tolerance and limits in force
  Definition definition;  ///< without meaning where gap_of is none
  GapOf gap_of;
};

/// A pair prepared for a peer: all that its interface lets one do once per pose is done.
class PeerPair {
 public:
  virtual ~PeerPair() = default;
  /// Nothing where the peer says, or shows, that it failed: an exception, no convergence.
  virtual std::optional<PeerContact> contact() = 0;

 protected:
  PeerPair() = default;
  PeerPair(const PeerPair&) = default;
  PeerPair& operator=(const PeerPair&) = default;
};

class Peer {
 public:
  virtual ~Peer() = default;
  virtual PeerDescription description() const = 0;
  /// @return a pair that must not outlive the peer
  virtual std::unique_ptr<PeerPair> prepare(const RawEllipsoid& a, const RawEllipsoid& b) const = 0;

 protected:
  Peer() = default;
  Peer(const Peer&) = default;
  Peer& operator=(const Peer&) = default;
};

/// PeerDescription::call of Simbody's own way to a contact, which this library is measured against.
inline constexpr const char* kSimbodyTracker = "ConvexImplicitPair::trackContact";

/// Each with its default options first and then the tightest useful ones; none where the library
/// was not installed when this was built.
std::vector<std::unique_ptr<Peer>> simbody_peers();
std::vector<std::unique_ptr<Peer>> fcl_peers();
std::vector<std::unique_ptr<Peer>> mujoco_peers();
std::vector<std::unique_ptr<Peer>> all_peers();
/// No libraries, and none of all_peers(): what simulation codes write for themselves.
std::vector<std::unique_ptr<Peer>> plain_perram_wertheim_peers();
std::vector<std::unique_ptr<Peer>> bounding_spheres_peers();

}  // namespace tangency::peers
