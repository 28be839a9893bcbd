// SPDX-License-Identifier: MIT
/// @file
/// Ellipsoids that many pairs of the batch calls share: gap_batch.hpp.
#pragma once

#include <cstddef>
#include <ranges>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/large_pages.hpp>

namespace tangency::inline v0 {

namespace detail {
struct FloatRow;
struct LaneBody;
struct ShapeRow;
}  // namespace detail

/// A temporary container of ellipsoids: one that a span of it would outlive.
template <class T>
concept TemporaryEllipsoids =
    std::ranges::contiguous_range<T> && std::ranges::sized_range<T> &&
    !std::is_lvalue_reference_v<T> &&
    !std::ranges::borrowed_range<T> && std::is_same_v<std::ranges::range_value_t<T>, Ellipsoid>;

/// Bodies that many pairs share, with what the batch reads of each beside each other, for random
/// access: 224 bytes a body, and 64 for what is answered in single precision. Keeps the span: the
/// ellipsoids must outlive it and stay in place. Of a temporary container it takes the ellipsoids
/// themselves. One that was moved from is empty.
class BodyArray {
 public:
  /// Looks at bodies of the caller's, which have to outlive the array and stay in place.
  explicit BodyArray(std::span<const Ellipsoid> bodies);
  /// Takes the bodies of a temporary container, whose elements are ellipsoids.
  template <TemporaryEllipsoids T>
  explicit BodyArray(T&& bodies) : BodyArray(Owned{}, owned(bodies)) {}
  ~BodyArray();
  /// Its source is empty afterwards.
  BodyArray(BodyArray&&) noexcept;
  /// Its source is empty afterwards.
  BodyArray& operator=(BodyArray&&) noexcept;

  /// The number of bodies.
  std::size_t size() const noexcept { return bodies_.size(); }
  /// Body i < size(), as it was at construction or at the last refresh().
  const Ellipsoid& operator[](std::size_t i) const noexcept { return bodies_[i]; }
  /// To be called after body i was changed; i < size(), checked. Different bodies may be refreshed
  /// by different threads.
  void refresh(std::size_t i) noexcept;

  /// For the library's own use.
  const detail::LaneBody* lanes() const noexcept { return lanes_.data(); }
  /// For the library's own use.
  const detail::FloatRow* floats() const noexcept { return floats_.data(); }
  /// For the library's own use.
  const detail::ShapeRow* rows() const noexcept { return rows_.data(); }

 private:
  /// @cond
  struct Owned {};
  /// @endcond
  BodyArray(Owned, std::vector<Ellipsoid> bodies);

  template <class T>
  static std::vector<Ellipsoid> owned(T& bodies) {
    if constexpr (std::is_same_v<T, std::vector<Ellipsoid>>) return std::move(bodies);
    return {std::ranges::begin(bodies), std::ranges::end(bodies)};
  }

  std::vector<Ellipsoid> own_;  ///< of a temporary; empty where the span is of the caller's
  std::span<const Ellipsoid> bodies_;
  std::vector<detail::LaneBody, LargePages<detail::LaneBody>> lanes_;
  std::vector<detail::FloatRow, LargePages<detail::FloatRow>> floats_;
  std::vector<detail::ShapeRow, LargePages<detail::ShapeRow>> rows_;
};

}  // namespace tangency::inline v0
