// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <iterator>
#include <memory>
#include <vector>

#include <tangency/bench/peers/peer.hpp>

namespace tangency::peers {

// A library that is not installed has no peers.
#ifndef TANGENCY_PEER_SIMBODY
std::vector<std::unique_ptr<Peer>> simbody_peers() { return {}; }
#endif
#ifndef TANGENCY_PEER_FCL
std::vector<std::unique_ptr<Peer>> fcl_peers() { return {}; }
#endif
#ifndef TANGENCY_PEER_MUJOCO
std::vector<std::unique_ptr<Peer>> mujoco_peers() { return {}; }
#endif

std::vector<std::unique_ptr<Peer>> all_peers() {
  std::vector<std::unique_ptr<Peer>> peers;
  for (auto* of_one_library : {&simbody_peers, &fcl_peers, &mujoco_peers})
    std::ranges::move(of_one_library(), std::back_inserter(peers));
  return peers;
}

}  // namespace tangency::peers
