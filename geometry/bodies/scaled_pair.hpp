// SPDX-License-Identifier: MIT
/// @file
/// A pair as it is asked about, and the same pair in a unit of length that suits what is computed:
/// the caller's, or a power of two where lengths would overflow or underflow on the way. One
/// template for ellipsoids in space and ellipses in the plane.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include <tangency/geometry/power_of_two.hpp>

namespace tangency::inline v0::detail {

/// What d lacks of c_B - c_A, exactly in the default environment: the error term of Knuth's two-sum
/// of c_B and -c_A.
template <class Vector>
Vector separation_error(const Vector& centre_a, const Vector& centre_b, const Vector& d) noexcept {
  const Vector part = d - centre_b;
  return (centre_b - (d - part)) - (centre_a + part);
}

/// Two bodies, with a separation d = c_B - c_A in place of their centres if one is given.
template <class Body>
struct AskedPair {
  using Vector = std::remove_cvref_t<decltype(std::declval<const Body&>().centre())>;

  const Body& a;
  const Body& b;
  const Vector* separation = nullptr;  ///< finite; null: that of the centres

  /// Rounded; infinite where the difference of the centres overflows.
  Vector d() const noexcept {
    return separation != nullptr ? *separation : Vector(b.centre() - a.centre());
  }
  /// c_B - c_A = d + this, for a finite d = d().
  Vector rest_of(const Vector& d) const noexcept {
    if (separation != nullptr) return Vector::Zero();
    return separation_error(a.centre(), b.centre(), d);
  }
  /// The bodies about centres that are as far apart as is asked: for the exact relation.
  std::pair<Body, Body> placed() const noexcept {
    if (separation == nullptr) return {a, b};
    return {a.moved_to(Vector::Zero()), b.moved_to(*separation)};
  }
};

/// A and B about their own centres, and d = c_B - c_A, in units of 2^exponent: the largest of them
/// in [1, 4). Scaling is exact but for lengths below 2^-1022 in the new unit, and for semi-axes
/// below kThinnestAxis, which become that: for the gap less than its rounding in double-double.
template <class Body>
struct ScaledPair {
  typename AskedPair<Body>::Vector d, d_low;  ///< c_B - c_A = d + d_low, but for 2^-1074
  int exponent;
  Body a, b;
};

template <class Body>
[[gnu::noinline]] ScaledPair<Body> scaled_pair(const AskedPair<Body>& asked) noexcept {
  using Vector = typename AskedPair<Body>::Vector;
  const auto [a, b, separation] = asked;
  int exponent = std::numeric_limits<double>::max_exponent;
  Vector d = asked.d(), d_low;
  if (d.allFinite()) {
    exponent = std::max({exponent_of(d), exponent_of(a.semi_axes()), exponent_of(b.semi_axes())});
    d_low = scaled_by_power(asked.rest_of(d), -exponent), d = scaled_by_power(d, -exponent);
  } else {
    // The difference of the centres overflows: it is formed in a unit in which it does not.
    const Vector ca = scaled_by_power(a.centre(), -exponent);
    const Vector cb = scaled_by_power(b.centre(), -exponent);
    d = cb - ca, d_low = separation_error(ca, cb, d);
  }
  const auto body = [exponent](const Body& e) {
    const Vector axes = scaled_by_power(e.semi_axes(), -exponent).cwiseMax(kThinnestAxis);
    if constexpr (requires { e.orientation(); }) {
      return Body(Vector::Zero(), axes, e.orientation());
    } else {
      return Body(Vector::Zero(), axes, e.direction());
    }
  };
  return {d, d_low, exponent, body(a), body(b)};
}

/// The pair in the unit of what is computed: that of the caller, and then without a copy, or one of
/// scaled_pair(). Lengths of an answer times 2^exponent are in the caller's unit. Inlined always:
/// a call of the constructor costs 7 % of relation(), measured in instructions.
template <class Body>
class UnitPair {
 public:
  using Vector = typename AskedPair<Body>::Vector;

  /// @param asked_d  asked_.d()
  /// @param fits     is the caller's unit the one? If not, the pair is scaled.
  [[gnu::always_inline]] UnitPair(const AskedPair<Body>& asked_, const Vector& asked_d,
                                  bool fits) noexcept
      : scaled_(fits ? std::nullopt : std::optional(scaled_pair(asked_))),
        asked(asked_),
        a(fits ? asked_.a : scaled_->a),
        b(fits ? asked_.b : scaled_->b),
        d(fits ? asked_d : scaled_->d),
        exponent(fits ? 0 : scaled_->exponent) {}
  UnitPair(const UnitPair&) = delete;
  UnitPair& operator=(const UnitPair&) = delete;
  ~UnitPair() = default;

  bool in_own_unit() const noexcept { return !scaled_; }
  /// c_B - c_A = d + this.
  Vector rest_of_d() const noexcept { return scaled_ ? scaled_->d_low : asked.rest_of(d); }

 private:
  std::optional<ScaledPair<Body>> scaled_;

 public:
  const AskedPair<Body> asked;
  const Body &a, &b;
  const Vector d;
  const int exponent;
};

/// What is looked for among the unit normals n of a pair: the greatest
///
///     f(n) = n.d - h_A(n) - h_B(n), the gap, or
///     f(n) = n.d - h_A(n) + h_B(n), minus the clearance of B in A.
enum class Sought { gap, clearance };

/// A lower bound of minus f'' + f along a great circle of normals: radii of curvature of A are at
/// least a_min^2/a_max, those of B too, and at most b_max^2/b_min.
template <class Body>
double least_radius_of(const Body& a, const Body& b, Sought sought) noexcept {
  if (sought == Sought::gap) return (1.0 - 0x1p-40) * (a.least_radius() + b.least_radius());
  const double most = b.largest_semi_axis() * (b.largest_semi_axis() / b.smallest_semi_axis());
  return (1.0 - 0x1p-40) * a.least_radius() - (1.0 + 0x1p-40) * most;
}

/// May the polynomials of the Perram-Wertheim form be used as they are?
template <class Body, class Vector>
[[gnu::always_inline]] inline bool moderate(const Body& a, const Body& b,
                                            const Vector& d) noexcept {
  return a.moderate() && b.moderate() && d.cwiseAbs().maxCoeff() <= kLargestModerate;
}

/// Are the largest of semi-axes and components of d within [kSmallestModerate, kLargestModerate]?
template <class Body, class Vector>
bool moderate_size(const Body& a, const Body& b, const Vector& d) noexcept {
  const double reach = d.cwiseAbs().maxCoeff();
  const double largest = std::max({reach, a.largest_semi_axis(), b.largest_semi_axis()});
  return largest <= kLargestModerate && largest >= kSmallestModerate;
}

/// Is no semi-axis one that scaled_pair() would change?
template <class Body>
bool thick_enough(const Body& a, const Body& b) noexcept {
  return std::min(a.smallest_semi_axis(), b.smallest_semi_axis()) >= kThinnestAxis;
}

}  // namespace tangency::inline v0::detail
