// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/hunt/moves.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <system_error>
#include <utility>

#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::verify {
namespace {

constexpr double kMost = std::numeric_limits<double>::max();

double signed_by_chance(Draw& draw, double value) { return draw.coin() ? value : -value; }
std::size_t axis(Draw& draw) { return static_cast<std::size_t>(draw.integer(0, 2)); }
RawEllipsoid& body(Draw& draw, EllipsoidPair& pair) { return draw.coin() ? pair.a : pair.b; }

void nudge(double& value, int units) {
  for (int i = 0; i < std::abs(units); ++i)
    value = std::nextafter(value, units > 0 ? kMost : -kMost);
}

void scale(EllipsoidPair& pair, double factor) {
  for (RawEllipsoid* e : {&pair.a, &pair.b}) {
    for (double& v : e->centre) v *= factor;
    for (double& v : e->semi_axes) v *= factor;
  }
}

// One of B's number, and the place along the normal that goes with it.
void touch(Draw& draw, EllipsoidPair& pair, const Nearness& near) {
  place_at_gap(pair, near, signed_by_chance(draw, near.size * drawn_magnitude(draw, -19, -1)));
}

void neighbour(Draw& draw, EllipsoidPair& pair, const Nearness&) {
  RawEllipsoid& e = body(draw, pair);
  const int which = draw.integer(0, 9), units = draw.integer(-8, 8);
  double& value = which < 3   ? e.centre[static_cast<std::size_t>(which)]
                  : which < 6 ? e.semi_axes[static_cast<std::size_t>(which - 3)]
                              : e.orientation[static_cast<std::size_t>(which - 6)];
  if (value != 0) nudge(value, units);  // not among the subnormals
}

void equal_axes(Draw& draw, EllipsoidPair& pair, const Nearness&) {
  RawEllipsoid& e = body(draw, pair);
  const std::size_t from = axis(draw), to = axis(draw);
  e.semi_axes[to] = e.semi_axes[from];
  if (draw.integer(0, 2) == 0) nudge(e.semi_axes[to], draw.integer(-2, 2));
  if (draw.integer(0, 3) == 0) e.semi_axes.fill(e.semi_axes[from]);
}

void aspect(Draw& draw, EllipsoidPair& pair, const Nearness&) {
  double& value = body(draw, pair).semi_axes[axis(draw)];
  const double factor = drawn_magnitude(draw, 0, draw.coin() ? 1 : 4);
  value = draw.coin() ? value * factor : value / factor;
}

void size_ratio(Draw& draw, EllipsoidPair& pair, const Nearness&) {
  const double factor = drawn_magnitude(draw, 0, draw.coin() ? 1 : 5);
  const bool grows = draw.coin();
  for (double& v : body(draw, pair).semi_axes) v = grows ? v * factor : v / factor;
}

// Equal orientations, a quarter turn between them, or as good as equal.
void alignment(Draw& draw, EllipsoidPair& pair, const Nearness&) {
  auto &p = pair.a.orientation, &q = pair.b.orientation;
  switch (draw.integer(0, 3)) {
    case 0:
      p = q = {1, 0, 0, 0};
      break;
    case 1:
      q = p;
      break;
    case 2:
      q = {p[0] - p[3], p[1] + p[2], p[2] - p[1], p[3] + p[0]};  // p times 1 + k
      break;
    default:
      q = p;
      for (double& v : q) v += signed_by_chance(draw, drawn_magnitude(draw, -17, -3));
  }
}

void same_shape(Draw& draw, EllipsoidPair& pair, const Nearness&) {
  pair.b.semi_axes = pair.a.semi_axes;
  if (draw.coin()) draw.shuffle(pair.b.semi_axes);
}

// The line of centres into an axis or a plane of A.
void on_axis(Draw& draw, EllipsoidPair& pair, const Nearness&) {
  const std::size_t kept = axis(draw);
  const bool plane = draw.coin();
  pair.a.orientation = {1, 0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    if ((i == kept) == plane) pair.b.centre[i] = pair.a.centre[i];
  }
}

void deeper(Draw& draw, EllipsoidPair& pair, const Nearness&) {
  const double share = draw.integer(0, 2) == 0 ? 0 : drawn_magnitude(draw, -16, 0);
  for (std::size_t i = 0; i < 3; ++i) {
    const double c = pair.a.centre[i];
    pair.b.centre[i] = c + share * (pair.b.centre[i] - c);
  }
}

// A deep pair where as many normals tie as its shapes allow: crossed, centres together.
void deep_tie(Draw& draw, EllipsoidPair& pair, const Nearness&) {
  pair.b = pair.a;
  auto& q = pair.b.orientation;
  const auto p = q;
  if (draw.coin()) q = {p[0] - p[3], p[1] + p[2], p[2] - p[1], p[3] + p[0]};
  if (draw.coin()) pair.b.centre[axis(draw)] += drawn_magnitude(draw, -17, 0) * pair.a.semi_axes[0];
}

void inside(Draw& draw, EllipsoidPair& pair, const Nearness&) {
  const double share = drawn_magnitude(draw, -2, 0);
  pair.b = pair.a;
  for (double& v : pair.b.semi_axes) v *= share;
  const std::size_t k = axis(draw);
  const double room = pair.a.semi_axes[k] - pair.b.semi_axes[k];
  pair.a.orientation = pair.b.orientation = {1, 0, 0, 0};
  pair.b.centre[k] += signed_by_chance(draw, draw.coin() ? room : room * draw.real(0, 2));
}

void rescale(Draw& draw, EllipsoidPair& pair, const Nearness&) {
  const int most = draw.coin() ? 30 : 400;
  scale(pair, std::ldexp(1.0, draw.integer(-most, most)));
}

void origin(Draw& draw, EllipsoidPair& pair, const Nearness& near) {
  const double reach = near.size * drawn_magnitude(draw, 0, 14);
  for (std::size_t i = 0; i < 3; ++i) {
    const double shift = reach * draw.integer(-1, 1);
    pair.a.centre[i] += shift;
    pair.b.centre[i] += shift;
  }
}

void length_of_quaternion(Draw& draw, EllipsoidPair& pair, const Nearness&) {
  const double factor = drawn_magnitude(draw, -100, 100);
  for (double& v : body(draw, pair).orientation) v *= factor;
}

void exchange(Draw&, EllipsoidPair& pair, const Nearness&) { std::swap(pair.a, pair.b); }

// Short numbers make coincidences that are exact.
void short_numbers(Draw& draw, EllipsoidPair& pair, const Nearness&) {
  const int digits = draw.integer(1, 3);
  for (RawEllipsoid* e : {&pair.a, &pair.b}) {
    for (double& v : e->centre) v = short_number(v, digits);
    for (double& v : e->semi_axes) v = short_number(v, digits);
    for (double& v : e->orientation) v = short_number(v, digits);
  }
}

constexpr std::array<Move, 16> kMoves{{
    {"touch", "a gap near 0, from both sides", touch},
    {"neighbour", "the next doubles", neighbour},
    {"equal axes", "bodies of revolution, and as good as that", equal_axes},
    {"aspect", "needles and discs", aspect},
    {"size ratio", "a large body beside a small one", size_ratio},
    {"alignment", "parallel axes, and as good as that", alignment},
    {"same shape", "equal semi-axes of both bodies", same_shape},
    {"on axis", "centres on an axis or in a plane of symmetry", on_axis},
    {"deeper", "centres that meet", deeper},
    {"deep tie", "several normals of one depth", deep_tie},
    {"inside", "one in the other, touching from inside", inside},
    {"scale", "lengths far from 1", rescale},
    {"origin", "bodies far from the origin", origin},
    {"quaternion", "orientations of any length", length_of_quaternion},
    {"exchange", "the other body first", exchange},
    {"short numbers", "coincidences that are exact", short_numbers},
}};

bool within(double value) {
  const double size = std::abs(value);
  return size == 0 || (size >= 1e-150 && size <= 1e150);
}

}  // namespace

std::span<const Move> moves() { return kMoves; }

double drawn_magnitude(Draw& draw, int from, int to) {
  // 3.32 binary digits a decimal one, to within a share that does not matter here.
  const int low = from * 3322 / 1000, high = to * 3322 / 1000;
  const double mantissa = draw.real(1, 2);
  return std::ldexp(mantissa, low < high ? draw.integer(low, high - 1) : low);
}

void place_at_gap(EllipsoidPair& pair, const Nearness& near, double gap) {
  for (std::size_t i = 0; i < 3; ++i) pair.b.centre[i] += (gap - near.gap) * near.normal[i];
}

double short_number(double value, int digits) {
  const std::string text = tables::rounded_text(value, digits);
  double result = value;
  std::from_chars(text.data(), text.data() + text.size(), result);
  return result;
}

bool is_fair(const EllipsoidPair& pair) {
  const auto [least_a, most_a] = std::ranges::minmax(pair.a.semi_axes);
  const auto [least_b, most_b] = std::ranges::minmax(pair.b.semi_axes);
  const double most = std::max(most_a, most_b);
  if (!(most <= 1e12 * std::min(least_a, least_b))) return false;
  for (const RawEllipsoid* e : {&pair.a, &pair.b}) {
    for (const double c : e->centre) {
      if (!(std::abs(c) <= 1e16 * most)) return false;
    }
    const auto positive = [](double v) { return v > 0; };
    const auto zero = [](double v) { return v == 0; };
    if (!std::ranges::all_of(e->centre, within) || !std::ranges::all_of(e->semi_axes, within) ||
        !std::ranges::all_of(e->orientation, within) ||
        !std::ranges::all_of(e->semi_axes, positive) || std::ranges::all_of(e->orientation, zero)) {
      return false;
    }
  }
  return true;
}

std::uint16_t traits(const EllipsoidPair& pair, const Nearness& near) {
  const auto [least_a, most_a] = std::ranges::minmax(pair.a.semi_axes);
  const auto [least_b, most_b] = std::ranges::minmax(pair.b.semi_axes);
  const auto is_round = [](const RawEllipsoid& e) {
    const auto& r = e.semi_axes;
    return r[0] == r[1] || r[1] == r[2] || r[2] == r[0];
  };
  const auto& c = pair.a.centre;
  constexpr double kMuch = 1e3, kVeryMuch = 1e6, kExtreme = 1e20;
  unsigned set = 0;
  if (most_a > kMuch * least_a || most_b > kMuch * least_b) set |= kLong;
  if (most_a > kMuch * most_b || most_b > kMuch * most_a) set |= kUnequal;
  if (std::hypot(c[0], c[1], c[2]) > kVeryMuch * near.size) set |= kFar;
  if (!(near.size < kExtreme && near.size > 1 / kExtreme)) set |= kScaled;
  if (is_round(pair.a) || is_round(pair.b)) set |= kRound;
  if (pair.a.orientation == pair.b.orientation) set |= kAligned;
  if (pair.a.centre == pair.b.centre) set |= kConcentric;
  if (std::abs(near.gap) * kVeryMuch < near.size) set |= kNear;
  return static_cast<std::uint16_t>(set);
}

std::string_view trait_name(Trait trait) {
  switch (trait) {
    case kLong:
      return "long";
    case kUnequal:
      return "unequal";
    case kFar:
      return "far";
    case kScaled:
      return "scaled";
    case kRound:
      return "round";
    case kAligned:
      return "aligned";
    case kConcentric:
      return "concentric";
    case kNear:
      break;
  }
  return "near";
}

}  // namespace tangency::inline v0::verify
