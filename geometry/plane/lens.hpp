// SPDX-License-Identifier: MIT
/// @file
/// The points where the boundaries of two ellipses meet, in double-double, in the order in which
/// they follow on the boundary of the common region, and the real roots of quartics that they come
/// from. Internal.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include <tangency/geometry/numbers/double_double.hpp>
#include <tangency/geometry/plane/ellipse_meeting.hpp>

namespace tangency::inline v0::detail {

/// Sorts the first few of an array. (std::sort's branch for more than sixteen makes g++ 12 warn of
/// accesses beyond so short an array.)
template <class T, std::size_t N, class Less>
void sort_few(std::array<T, N>& values, int count, const Less& less) noexcept {
  for (std::size_t i = 1; i < static_cast<std::size_t>(count); ++i) {
    for (std::size_t k = i; k > 0 && less(values[k], values[k - 1]); --k) {
      std::swap(values[k], values[k - 1]);
    }
  }
}

struct MultipleRoot {
  DoubleDouble at;
  int multiplicity;
};

struct MultipleRoots {
  int count = 0;  ///< distinct
  std::array<MultipleRoot, 4> root;
};

/// Ascending; none where the meeting is `equal` or `nowhere`. A multiple root is found as a simple
/// root of a derivative; of roots that double-double cannot tell apart both are put where the
/// polynomial is least.
/// @param c        from the constant upwards; the leading one not small beside the others
/// @param meeting  the multiplicities of the real roots
MultipleRoots real_quartic_roots(const std::array<DoubleDouble, 5>& c,
                                 exact::Meeting meeting) noexcept;

/// One of two ellipses: unit vectors of its circle frame are y = diag(1/a) R'(x - c).
struct LensBody {
  DoubleDouble2 axis;
  double a1, a2;

  DoubleDouble2 to_plane(const DoubleDouble2& y) const noexcept;    ///< of vectors
  DoubleDouble2 from_plane(const DoubleDouble2& x) const noexcept;  ///< of vectors
};

struct LensVertex {
  std::array<DoubleDouble2, 2> unit;  ///< in the circle frames of both bodies
  DoubleDouble2 arm;                  ///< from the first body's centre
  int multiplicity;
};

/// The unit vector half-way from one counter-clockwise to another; `whole` tells a full turn from
/// none where the two are equal.
DoubleDouble2 arc_middle(const DoubleDouble2& from, const DoubleDouble2& to, bool whole) noexcept;
/// The angle between the two, counter-clockwise; rad, in [0, 2 pi].
double arc_span(const DoubleDouble2& from, const DoubleDouble2& to, bool whole) noexcept;

/// `first` is the body of smaller area, which one of an exchanged pair is as well: whatever is
/// computed from a lens is the same for both, bit for bit.
class PlaneLens {
 public:
  /// Requires semi-axes and d between 2^-300 and 4.
  /// @param d, d_low  c_B - c_A = d + d_low
  PlaneLens(const Ellipse& a, const Ellipse& b, const Vec2& d, const Vec2& d_low,
            exact::Meeting meeting) noexcept;

  bool first_is_a() const noexcept { return first_is_a_; }
  const LensBody& body(std::size_t i) const noexcept { return body_[i]; }
  /// From the first body's centre to the second's.
  const DoubleDouble2& separation() const noexcept { return d_; }
  int count() const noexcept { return count_; }
  /// Counter-clockwise.
  const LensVertex& operator[](int i) const noexcept {
    return vertex_[static_cast<std::size_t>(i)];
  }

  /// Is the first body's boundary inside the second, rather than the second's inside the first,
  /// between vertex i and the next?
  bool first_bounds(int i) const noexcept { return level_between(i) < 0.0; }
  /// The second's level - 1 half-way on the first's boundary between vertex i and the next.
  double level_between(int i) const noexcept;
  bool is_last(int i) const noexcept { return i + 1 == count_; }
  const LensVertex& next(int i) const noexcept { return (*this)[is_last(i) ? 0 : i + 1]; }

 private:
  /// The second body's circle frame, of a unit vector of the first's.
  DoubleDouble2 second_frame(const DoubleDouble2& z) const noexcept;
  void find_vertices(exact::Meeting meeting) noexcept;

  std::array<LensBody, 2> body_;
  DoubleDouble2 d_;
  std::array<DoubleDouble2, 2> column_;  ///< of diag(1/b) R_B' R_A diag(a)
  DoubleDouble2 shift_;                  ///< diag(1/b) R_B' d
  bool first_is_a_;
  int count_ = 0;
  std::array<LensVertex, 4> vertex_;
};

}  // namespace tangency::inline v0::detail
