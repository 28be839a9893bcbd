// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/corpus/placing.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <tangency/verify/families/adversarial.hpp>
#include <tangency/verify/oracles/newton_ascent.hpp>

namespace tangency::verify {
namespace {

// Chosen: several times the largest count of a family.
constexpr std::size_t kMostOfIntegerFamily = 400;

std::vector<EllipsoidPair> integer_pairs(std::string_view name, std::uint64_t seed) {
  const std::size_t families = adversarial_family_names().size();
  std::vector<EllipsoidPair> pairs;
  for_each_adversarial_pair(seed, families * kMostOfIntegerFamily, [&](const AdversarialPair& p) {
    if (p.family == name) pairs.push_back({p.a, p.b});
  });
  return pairs;
}

}  // namespace

std::array<double, 3> triaxial_axes(Draw& draw, double shortest, double aspect) {
  std::array<double, 3> axes{shortest * aspect, shortest * draw.log_uniform(1, aspect), shortest};
  draw.shuffle(axes);
  return axes;
}

RawEllipsoid turned_body(Draw& draw, const std::array<double, 3>& axes) {
  return {{}, axes, draw.orientation()};
}

double least_axis(const RawEllipsoid& body) { return std::ranges::min(body.semi_axes); }
double most_axis(const RawEllipsoid& body) { return std::ranges::max(body.semi_axes); }

double least_radii(const EllipsoidPair& pair) {
  return least_axis(pair.a) * (least_axis(pair.a) / most_axis(pair.a)) +
         least_axis(pair.b) * (least_axis(pair.b) / most_axis(pair.b));
}

void place_b(EllipsoidPair& pair, const Real3& n, const Real& gap, const Real& share) {
  const Separation<Real> shapes = separation(real(pair.a), real(pair.b));
  const Real3 reach = ascent::combined(ascent::support_point(shapes.a, n), Real(1),
                                       ascent::support_point(shapes.b, n), Real(0), n);
  for (std::size_t i = 0; i < 3; ++i) {
    pair.b.centre[i] = rounded(Real(pair.a.centre[i]) + share * reach[i] + gap * n[i]);
  }
}

Real placed_gap(const EllipsoidPair& pair, const Real3& n) {
  return ascent::value(separation(real(pair.a), real(pair.b)), n).f;
}

InputFamily<EllipsoidPair> drawn_family(std::string name, std::size_t count, PairDraw draw_pair) {
  return {std::move(name), count,
          [draw_pair = std::move(draw_pair)](std::uint64_t seed) -> std::function<EllipsoidPair()> {
            return [draw = Draw(seed), draw_pair]() mutable {
              for (;;) {
                if (const auto pair = draw_pair(draw)) return *pair;
              }
            };
          }};
}

InputFamily<EllipsoidPair> integer_family(std::string_view name, std::size_t count) {
  return {std::string(name), count,
          [name = std::string(name)](std::uint64_t seed) -> std::function<EllipsoidPair()> {
            const auto pairs =
                std::make_shared<const std::vector<EllipsoidPair>>(integer_pairs(name, seed));
            return [pairs, next = std::size_t{0}]() mutable {
              if (next == pairs->size()) throw std::logic_error("corpus: a family has run out");
              return (*pairs)[next++];
            };
          }};
}

}  // namespace tangency::verify
