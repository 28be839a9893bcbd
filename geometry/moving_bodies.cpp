// SPDX-License-Identifier: MIT
#include <tangency/geometry/moving_bodies.hpp>

#include <cstddef>
#include <span>
#include <utility>

#include <tangency/geometry/batch/moving_lanes.hpp>
#include <tangency/geometry/numbers/contract.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>

namespace tangency {

static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Quaternion) == 4 * sizeof(double),
              "the lanes read the columns as numbers");

MovingBodies::MovingBodies() noexcept = default;
MovingBodies::~MovingBodies() = default;

MovingBodies::MovingBodies(std::span<const Vec3> semi_axes,
                           std::span<const Quaternion> orientations) {
  look_at(semi_axes, orientations);
  refresh(0, size());
}

MovingBodies::MovingBodies(const MovingBodies&) noexcept {}
MovingBodies& MovingBodies::operator=(const MovingBodies&) noexcept {
  return *this = MovingBodies();
}

MovingBodies::MovingBodies(MovingBodies&& other) noexcept
    : semi_axes_(std::exchange(other.semi_axes_, {})),
      orientations_(std::exchange(other.orientations_, {})),
      lanes_(std::exchange(other.lanes_, {})) {}

MovingBodies& MovingBodies::operator=(MovingBodies&& other) noexcept {
  MovingBodies taken(std::move(other));
  std::swap(semi_axes_, taken.semi_axes_);
  std::swap(orientations_, taken.orientations_);
  std::swap(lanes_, taken.lanes_);
  return *this;
}

void MovingBodies::look_at(std::span<const Vec3> semi_axes,
                           std::span<const Quaternion> orientations) {
  if (orientations.size() != semi_axes.size())
    contract::wrong_column("MovingBodies", "orientations", orientations.size(), semi_axes.size());
  lanes_.resize(semi_axes.size());
  semi_axes_ = semi_axes;
  orientations_ = orientations;
}

void MovingBodies::refresh(std::size_t first, std::size_t last) noexcept {
  if (first > last) contract::wrong_range("MovingBodies::refresh", first, last);
  if (last > size()) contract::no_body("MovingBodies::refresh", last - 1, size());
  if (first == last) return;
  in_default_environment([&] {
    detail::fill_moving_lanes(semi_axes_[first].data(), orientations_[first].coeffs().data(),
                              last - first, lanes_.data() + first);
  });
}

Ellipsoid MovingBodies::operator[](std::size_t i) const {
  return Ellipsoid(Vec3::Zero(), semi_axes_[i], orientations_[i]);
}

}  // namespace tangency
