// SPDX-License-Identifier: MIT
#include <tangency/geometry/moving_bodies.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <tangency/geometry/batch/moving_lanes.hpp>
#include <tangency/geometry/numbers/contract.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>

namespace tangency::inline v0 {
namespace {

static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Quaternion) == 4 * sizeof(double),
              "the lanes read the columns as numbers");

/// Is there a body in every place of the range?
void require_range(const char* call, std::size_t first, std::size_t count, std::size_t size) {
  if (first > size || count > size - first) contract::no_body(call, std::max(first, size), size);
}

void require_poses(const char* call, const PoseColumns& poses, std::size_t bodies) {
  if (poses.orientations.size() != bodies)
    contract::wrong_column(call, "orientations", poses.orientations.size(), bodies);
  if (poses.centres.size() != 0 && poses.centres.size() != bodies)
    contract::wrong_column(call, "centres", poses.centres.size(), bodies);
}

/// In the default environment, for others may read a subnormal float as 0.
template <class Column, class T>
void copy(const Column& from, T* to) {
  in_default_environment([&] {
    for (std::size_t i = 0; i < from.size(); ++i) to[i] = from[i];
  });
}

}  // namespace

MovingBodies::MovingBodies() noexcept = default;
MovingBodies::~MovingBodies() = default;

MovingBodies::MovingBodies(std::span<const Vec3> semi_axes,
                           std::span<const Quaternion> orientations) {
  look_at(semi_axes, orientations);
  refresh(0, size());
}

MovingBodies::MovingBodies(const VectorColumn& semi_axes, const PoseColumns& poses) {
  assign(semi_axes, poses);
}

MovingBodies::MovingBodies(const MovingBodies& other) {
  if (!other.owns_) return;
  owns_ = true;
  own_axes_ = other.own_axes_;
  own_turns_ = other.own_turns_;
  centres_ = other.centres_;
  lanes_ = other.lanes_;
  rows_ = other.rows_;
  floats_ = other.floats_;
  look_at_own();
}
MovingBodies& MovingBodies::operator=(const MovingBodies& other) {
  if (this != &other) *this = MovingBodies(other);
  return *this;
}

MovingBodies::MovingBodies(MovingBodies&& other) noexcept
    : semi_axes_(std::exchange(other.semi_axes_, {})),
      orientations_(std::exchange(other.orientations_, {})),
      owns_(std::exchange(other.owns_, false)),
      own_axes_(std::exchange(other.own_axes_, {})),  // whose rows stay where the span has them
      centres_(std::exchange(other.centres_, {})),
      own_turns_(std::exchange(other.own_turns_, {})),
      lanes_(std::exchange(other.lanes_, {})),
      rows_(std::exchange(other.rows_, {})),
      floats_(std::exchange(other.floats_, {})) {}

MovingBodies& MovingBodies::operator=(MovingBodies&& other) noexcept {
  MovingBodies taken(std::move(other));
  std::swap(semi_axes_, taken.semi_axes_);
  std::swap(orientations_, taken.orientations_);
  std::swap(owns_, taken.owns_);
  std::swap(own_axes_, taken.own_axes_);
  std::swap(centres_, taken.centres_);
  std::swap(own_turns_, taken.own_turns_);
  std::swap(lanes_, taken.lanes_);
  std::swap(rows_, taken.rows_);
  std::swap(floats_, taken.floats_);
  return *this;
}

void MovingBodies::look_at(std::span<const Vec3> semi_axes,
                           std::span<const Quaternion> orientations) {
  look_at(semi_axes, orientations, Questions::any);
}

void MovingBodies::look_at(std::span<const Vec3> semi_axes,
                           std::span<const Quaternion> orientations, Questions questions) {
  if (orientations.size() != semi_axes.size())
    contract::wrong_column("MovingBodies", "orientations", orientations.size(), semi_axes.size());
  lanes_.resize(semi_axes.size());
  rows_.resize(semi_axes.size());
  floats_.resize(questions == Questions::any ? semi_axes.size() : 0);
  semi_axes_ = semi_axes;
  orientations_ = orientations;
  owns_ = false;
  centres_.clear();
}

void MovingBodies::refresh(std::size_t first, std::size_t last) noexcept {
  if (first > last) contract::wrong_range("MovingBodies::refresh", first, last);
  if (last > size()) contract::no_body("MovingBodies::refresh", last - 1, size());
  if (!owns_) fill(first, last - first);
}

void MovingBodies::fill(std::size_t first, std::size_t count) noexcept {
  if (count == 0) return;
  in_default_environment([&] {
    detail::fill_moving_lanes(
        semi_axes_[first].data(), orientations_[first].coeffs().data(),
        centres_.empty() ? nullptr : centres_[first].data(), count,
        {&lanes_[first], &rows_[first], floats_.empty() ? nullptr : &floats_[first]});
  });
}

void MovingBodies::look_at_own() noexcept {
  semi_axes_ = own_axes_;
  orientations_ = own_turns_;
}

void MovingBodies::own() {
  if (owns_) return;
  own_axes_.assign(semi_axes_.begin(), semi_axes_.end());
  own_turns_.assign(orientations_.begin(), orientations_.end());
  floats_.resize(size());
  owns_ = true;  // from here on nothing allocates
  look_at_own();
  fill(0, size());
}

void MovingBodies::give_centres() { centres_.resize(size(), Vec3::Zero()); }

void MovingBodies::assign(const VectorColumn& semi_axes, const PoseColumns& poses) {
  const std::size_t count = semi_axes.size();
  require_poses("MovingBodies::assign", poses, count);
  own_axes_.resize(count);
  own_turns_.resize(count);
  centres_.resize(poses.centres.size());
  lanes_.resize(count);
  rows_.resize(count);
  floats_.resize(count);
  copy(semi_axes, own_axes_.data());
  copy(poses.orientations, own_turns_.data());
  copy(poses.centres, centres_.data());
  owns_ = true;
  look_at_own();
  fill(0, count);
}

void MovingBodies::set_poses(std::size_t first, const PoseColumns& poses) {
  const std::size_t count = poses.orientations.size();
  require_range("MovingBodies::set_poses", first, count, size());
  require_poses("MovingBodies::set_poses", poses, count);
  own();
  copy(poses.orientations, own_turns_.data() + first);
  if (poses.centres.size() > 0) {
    if (!has_centres()) give_centres();
    copy(poses.centres, centres_.data() + first);
  }
  fill(first, count);
}

void MovingBodies::set_pose(std::size_t i, const Quaternion& orientation, const Vec3& centre) {
  set_poses(i, {std::span(&orientation, 1), std::span(&centre, 1)});
}

void MovingBodies::set_semi_axes(std::size_t first, const VectorColumn& semi_axes) {
  require_range("MovingBodies::set_semi_axes", first, semi_axes.size(), size());
  own();
  copy(semi_axes, own_axes_.data() + first);
  fill(first, semi_axes.size());
}

std::size_t MovingBodies::add(const Vec3& semi_axes, const Quaternion& orientation,
                              const Vec3& centre) {
  // They may be numbers of a body of these, which resize() moves.
  const Vec3 axes = semi_axes, place = centre;
  const Quaternion turn = orientation;
  const std::size_t i = size();
  resize(i + 1);
  own_axes_[i] = axes;
  set_pose(i, turn, place);
  return i;
}

void MovingBodies::remove(std::size_t i) {
  require_range("MovingBodies::remove", i, 1, size());
  own();
  const std::size_t last = size() - 1;
  own_axes_[i] = own_axes_[last];
  own_turns_[i] = own_turns_[last];
  if (has_centres()) centres_[i] = centres_[last];
  lanes_[i] = lanes_[last];
  rows_[i] = rows_[last];
  floats_[i] = floats_[last];
  resize(last);
}

void MovingBodies::resize(std::size_t count) {
  own();
  const std::size_t before = size();
  own_axes_.resize(count, Vec3::Ones());
  own_turns_.resize(count, Quaternion::Identity());
  if (has_centres()) centres_.resize(count, Vec3::Zero());
  lanes_.resize(count);
  rows_.resize(count);
  floats_.resize(count);
  look_at_own();
  if (count > before) fill(before, count - before);
}

Ellipsoid MovingBodies::operator[](std::size_t i) const {
  return Ellipsoid(has_centres() ? centres_[i] : Vec3::Zero(), semi_axes_[i], orientations_[i]);
}

void MovingBodies::separations(std::span<const NearPair> pairs, const Mat3& edges,
                               std::span<Vec3> answers) const noexcept {
  contract::require_length("MovingBodies::separations", "answers", answers.size(), pairs.size());
  if (!has_centres() && size() > 0)
    contract::wrong_column("MovingBodies::separations", "centres", 0, size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto& [a, b, image] = pairs[k];
    if (a >= size()) contract::outside("MovingBodies::separations", k, 'a', a, size());
    if (b >= size()) contract::outside("MovingBodies::separations", k, 'b', b, size());
    answers[k] = separation(centres_[a], centres_[b], edges, image).vector;
  }
}

}  // namespace tangency::inline v0
