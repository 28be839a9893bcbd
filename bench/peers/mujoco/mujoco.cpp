// SPDX-License-Identifier: GPL-3.0-or-later
//
// MuJoCo. src/engine/engine_collision_convex.c of version 2.2.2: mjc_Convex, the entry for two
// ellipsoids in its table of collision functions, calls libccd's ccdMPRPenetration. The depth is
// the distance of the origin from the last portal, a triangle of the difference of the bodies that
// the line of centres leaves through: `portal`. The normal is corrected after (mjc_fixNormal), the
// depth is not. There is no distance of separate solids.
//
// Tolerance is absolute, in the unit of length of the bodies, and the limit is on the refinement of
// the depth alone. Prepared: rotation matrices; sizes, centres and matrices are copied into the one
// model that a peer has with each call (30 doubles), as MuJoCo's kinematics writes them.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <tangency/bench/peers/peer.hpp>

namespace tangency::peers {
namespace {

constexpr const char* kScene =
    "<mujoco><size njmax='1' nconmax='1' nstack='1000'/><worldbody>"
    "<geom type='ellipsoid' size='1 1 1'/><geom type='ellipsoid' size='1 1 1'/>"
    "</worldbody></mujoco>";

struct Options {
  double tolerance;
  int iterations;
};

struct World {
  std::unique_ptr<mjModel, decltype(&mj_deleteModel)> model{nullptr, mj_deleteModel};
  std::unique_ptr<mjData, decltype(&mj_deleteData)> data{nullptr, mj_deleteData};

  explicit World(const Options& options) {
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    const std::size_t length = std::strlen(kScene);
    mj_makeEmptyFileVFS(files.get(), "pair.xml", static_cast<int>(length));
    std::memcpy(files->filedata[0], kScene, length);
    std::array<char, 256> error{};
    model.reset(mj_loadXML("pair.xml", files.get(), error.data(), static_cast<int>(error.size())));
    mj_deleteVFS(files.get());
    if (!model) throw std::runtime_error(std::string("MuJoCo: ") + error.data());
    model->opt.mpr_tolerance = options.tolerance;
    model->opt.mpr_iterations = options.iterations;
    data.reset(mj_makeData(model.get()));
    mj_forward(model.get(), data.get());
  }
};

struct Body {
  std::array<double, 3> semi_axes, centre;
  std::array<double, 9> rotation;  // by rows

  explicit Body(const RawEllipsoid& e) : semi_axes(e.semi_axes), centre(e.centre), rotation{} {
    std::array<double, 4> q = e.orientation;
    // MuJoCo takes what is shorter than 1e-15 as no rotation; of a unit one it is never asked that.
    const double most = std::max(std::abs(std::ranges::min(q)), std::abs(std::ranges::max(q)));
    for (double& component : q) component /= most;
    mju_normalize4(q.data());
    mju_quat2Mat(rotation.data(), q.data());
  }

  void put_into(const World& world, int geom) const {
    const auto i = static_cast<std::size_t>(geom);
    std::copy(semi_axes.begin(), semi_axes.end(), world.model->geom_size + 3 * i);
    std::copy(centre.begin(), centre.end(), world.data->geom_xpos + 3 * i);
    std::copy(rotation.begin(), rotation.end(), world.data->geom_xmat + 9 * i);
  }
};

class Pair final : public PeerPair {
 public:
  Pair(const RawEllipsoid& a, const RawEllipsoid& b, const World& world)
      : a_(a), b_(b), world_(world) {}

  std::optional<PeerContact> contact() override {
    a_.put_into(world_, 0);
    b_.put_into(world_, 1);
    mjContact touch;
    const auto collide = mjCOLLISIONFUNC[mjGEOM_ELLIPSOID][mjGEOM_ELLIPSOID];
    if (collide(world_.model.get(), world_.data.get(), &touch, 0, 1, 0) == 0)
      return PeerContact{false, {}, {}, {}};
    return PeerContact{true, touch.dist, Point{touch.frame[0], touch.frame[1], touch.frame[2]},
                       Point{touch.pos[0], touch.pos[1], touch.pos[2]}};
  }

 private:
  Body a_, b_;
  const World& world_;
};

class Mujoco final : public Peer {
 public:
  explicit Mujoco(const Options& options) : options_(options), world_(options) {}

  PeerDescription description() const override {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "mpr_tolerance %.0e, mpr_iterations %d",
                  options_.tolerance, options_.iterations);
    return {"MuJoCo",    mj_versionString(), "mjc_Convex",
            text.data(), Definition::portal, GapOf::overlapping};
  }

  std::unique_ptr<PeerPair> prepare(const RawEllipsoid& a, const RawEllipsoid& b) const override {
    return std::make_unique<Pair>(a, b, world_);
  }

 private:
  Options options_;
  World world_;
};

}  // namespace

std::vector<std::unique_ptr<Peer>> mujoco_peers() {
  std::vector<std::unique_ptr<Peer>> peers;
  peers.push_back(std::make_unique<Mujoco>(Options{1e-6, 50}));
  peers.push_back(std::make_unique<Mujoco>(Options{1e-12, 1000}));
  return peers;
}

}  // namespace tangency::peers
