// SPDX-License-Identifier: GPL-3.0-or-later
//
// Families of pairs for codes that reckon in float: every number is one.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <tangency/verify/families/exact_contact.hpp>
#include <tangency/verify/families/extreme.hpp>
#include <tangency/verify/families/families.hpp>
#include <tangency/verify/families/manufactured.hpp>
#include <tangency/verify/families/placing.hpp>
#include <tangency/verify/oracles/newton_ascent.hpp>

namespace tangency::inline v0::verify {
namespace {

double to_float(double v) { return static_cast<double>(static_cast<float>(v)); }

EllipsoidPair to_floats(EllipsoidPair pair) {
  for (RawEllipsoid* body : {&pair.a, &pair.b}) {
    for (double& v : body->centre) v = to_float(v);
    for (double& v : body->semi_axes) v = to_float(v);
    for (double& v : body->orientation) v = to_float(v);
  }
  return pair;
}

bool has_floats_alone(const EllipsoidPair& pair) {
  const EllipsoidPair same = to_floats(pair);
  const auto equal = [](const RawEllipsoid& a, const RawEllipsoid& b) {
    return a.centre == b.centre && a.semi_axes == b.semi_axes && a.orientation == b.orientation;
  };
  return equal(same.a, pair.a) && equal(same.b, pair.b);
}

template <class Family>
InputFamily<EllipsoidPair> rounded_family(std::string name, std::size_t count,
                                          const Family& family) {
  return drawn_family(std::move(name), count, [family](Draw& draw) -> EllipsoidPair {
    return to_floats(drawn(draw, family));
  });
}

// The rounded centre leaves between a third of `gap` and three times it, of the same sign.
EllipsoidPair near_pair(Draw& draw, double gap) {
  for (;;) {
    const EllipsoidPair shapes = to_floats(contact_bodies(draw, contact_classes()[1]));
    const double wanted = (draw.coin() ? gap : -gap) * least_axis(shapes);
    constexpr int kAttempts = 100;  // chosen: at 1e-7 one rounding in some falls right
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      EllipsoidPair pair = shapes;
      const Real3 n = drawn_direction(draw);
      place_b(pair, n, wanted);
      pair = to_floats(pair);
      const Real left = ascent::value(separation(real(pair.a), real(pair.b)), n).f / wanted;
      if (left > 1 / Real(3) && left < 3) return pair;
    }
  }
}

// Whole numbers that are floats; moved by a unit of the last place of a float or not.
EllipsoidPair touching(Draw& draw, bool inside) {
  for (;;) {
    const auto contact = construction::contact(draw, inside);
    if (!contact) continue;
    const auto a = construction::raw(contact->a), b = construction::raw(contact->b);
    if (!a || !b) continue;
    EllipsoidPair pair{*a, *b};
    if (!has_floats_alone(pair)) continue;
    double& v = pair.b.centre[static_cast<std::size_t>(draw.integer(0, 2))];
    const float up = draw.coin() ? HUGE_VALF : -HUGE_VALF;
    if (draw.coin()) v = static_cast<double>(std::nextafterf(static_cast<float>(v), up));
    return exchanged_by_chance(draw, pair);
  }
}

InputFamily<EllipsoidPair> extreme(const char* name, std::size_t count, ExtremeFamily kind) {
  kind.least_overlap = 1e-6;
  kind.least_gap = 1e-5;
  kind.largest_gap = 1;
  return rounded_family(name, count, kind);
}

}  // namespace

PairFamilies float_families() {
  using Shape = ExtremeFamily::Shape;
  PairFamilies families;
  for (const ContactFamily& kind : contact_classes()) {
    ContactFamily moderate = kind;
    moderate.aspect = std::min(kind.aspect, 100.0);
    moderate.size_ratio = std::min(kind.size_ratio, 100.0);
    families.push_back(
        rounded_family("class " + std::to_string(families.size() + 1), 40, moderate));
  }
  for (int exponent = 3; exponent <= 7; ++exponent) {
    const double gap = rounded(pow(Real(10), -exponent));
    families.push_back(drawn_family("gap 1e-" + std::to_string(exponent), 20,
                                    [gap](Draw& draw) { return near_pair(draw, gap); }));
  }
  families.push_back(
      drawn_family("touching", 40, [](Draw& draw) { return touching(draw, false); }));
  families.push_back(
      drawn_family("touching inside", 20, [](Draw& draw) { return touching(draw, true); }));
  families.push_back(extreme("needles 1e3", 20, {{}, Shape::needles, 1e3}));
  families.push_back(extreme("discs 1e3", 20, {{}, Shape::discs, 1e3}));
  families.push_back(extreme("scale 1e-15", 15, {{}, Shape::triaxial, 10, 3, 1e-15}));
  families.push_back(extreme("scale 1e+15", 15, {{}, Shape::triaxial, 10, 3, 1e15}));
  families.push_back(extreme("origin 1e4", 20, {{}, Shape::triaxial, 10, 3, 1, 1e4}));
  families.push_back(rounded_family("deep", 40, DeepFamily{{}, 10, 0, 1}));
  return families;
}

}  // namespace tangency::inline v0::verify
