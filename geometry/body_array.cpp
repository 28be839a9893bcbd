// SPDX-License-Identifier: MIT
#include <tangency/geometry/body_array.hpp>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <tangency/geometry/batch/body_rows.hpp>
#include <tangency/geometry/batch/shape_rows.hpp>
#include <tangency/geometry/numbers/contract.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>

namespace tangency::inline v0 {

BodyArray::BodyArray(Owned, std::vector<Ellipsoid> bodies)
    : BodyArray(std::span<const Ellipsoid>(bodies)) {
  own_ = std::move(bodies);  // which leaves the ellipsoids where they are
}

BodyArray::BodyArray(std::span<const Ellipsoid> bodies)
    : bodies_(bodies), lanes_(bodies.size()), floats_(bodies.size()), rows_(bodies.size()) {
  in_default_environment([&] {
    for (std::size_t i = 0; i < bodies.size(); ++i) detail::fill(lanes_[i], bodies[i]);
    detail::fill_shape_rows(lanes_.data(), bodies.size(), rows_.data());
    detail::fill_float_rows(lanes_.data(), rows_.data(), bodies.size(), floats_.data());
  });
}
BodyArray::~BodyArray() = default;
BodyArray::BodyArray(BodyArray&& other) noexcept
    : own_(std::move(other.own_)),
      bodies_(std::exchange(other.bodies_, {})),
      lanes_(std::move(other.lanes_)),
      floats_(std::move(other.floats_)),
      rows_(std::move(other.rows_)) {}

BodyArray& BodyArray::operator=(BodyArray&& other) noexcept {
  BodyArray taken(std::move(other));
  std::swap(own_, taken.own_);
  std::swap(bodies_, taken.bodies_);
  std::swap(lanes_, taken.lanes_);
  std::swap(floats_, taken.floats_);
  std::swap(rows_, taken.rows_);
  return *this;
}

void BodyArray::refresh(std::size_t i) noexcept {
  if (i >= size()) contract::no_body("BodyArray::refresh", i, size());
  in_default_environment([&] {
    detail::fill(lanes_[i], bodies_[i]);
    detail::fill_shape_rows(&lanes_[i], 1, &rows_[i]);
    detail::fill_float_rows(&lanes_[i], &rows_[i], 1, &floats_[i]);
  });
}

}  // namespace tangency::inline v0
