// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/bench/speed_accuracy/pairs.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <stdexcept>

#include <tangency/bench/moved_back.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/extreme.hpp>
#include <tangency/verify/families/manufactured.hpp>
#include <tangency/verify/oracles/gap.hpp>

namespace tangency::speed_accuracy {
namespace {

using verify::EllipsoidPair;
using verify::Real;

/// A kind of pairs and where to get them from.
struct Source {
  std::string name;
  std::function<std::function<EllipsoidPair()>()> begin;  ///< a new sequence
};

/// Cells of the tables hold no comma.
std::string without_commas(std::string name) {
  std::replace(name.begin(), name.end(), ',', ';');
  return name;
}

template <class Kind>
Source source_of(const Kind& kind) {
  return {without_commas(kind.name), [kind] {
            return [pairs = verify::Sequence(kind, kSeed)]() mutable -> EllipsoidPair {
              return pairs.next();
            };
          }};
}

std::vector<Source> sources() {
  std::vector<Source> all;
  for (const auto& kind : verify::contact_classes()) all.push_back(source_of(kind));
  for (const auto& kind : verify::extreme_families()) {
    const bool chosen = kind.aspect == 1e2 || kind.aspect == 1e4 || kind.aspect == 1e8;
    const bool plain = kind.size_ratio == 3 && kind.scale == 1 && kind.origin == 0;
    const bool other = kind.name == "size ratio to 1e8, aspect 10" || kind.scale > 1;
    if ((chosen && plain) || other) all.push_back(source_of(kind));
  }
  for (const auto& kind : verify::deep_families()) {
    if (kind.within > 0 || kind.name == "aspect to 5, any overlap") all.push_back(source_of(kind));
  }
  return all;
}

void add(Pairs& pairs, EllipsoidPair pair) {
  const auto i = static_cast<std::uint32_t>(pairs.list.size());
  for (std::size_t k = 0; k < 3; ++k) {
    pair.b.centre[k] -= pair.a.centre[k];
    pair.a.centre[k] = 0;
  }
  pairs.raw.push_back(pair.a);
  pairs.raw.push_back(pair.b);
  const Ellipsoid a = verify::to_ellipsoid(pair.a), b = verify::to_ellipsoid(pair.b);
  pairs.bodies.push_back(a);
  pairs.bodies.push_back(b);
  pairs.list.push_back({2 * i, 2 * i + 1});
  const double smallest = std::min(a.smallest_semi_axis(), b.smallest_semi_axis());
  pairs.smallest.push_back(smallest);
  pairs.least = i == 0 ? smallest : std::min(pairs.least, smallest);
  pairs.previous_normal.push_back(signed_gap(a, bench::moment_ago(b, smallest, i)).normal);
}

Vec3 rounded(const verify::Real3& v) {
  return {v[0].convert_to<double>(), v[1].convert_to<double>(), v[2].convert_to<double>()};
}

}  // namespace

std::vector<std::string> family_names() {
  std::vector<std::string> names;
  for (const Source& source : sources()) names.push_back(source.name);
  return names;
}

std::unique_ptr<Pairs> draw_pairs(const std::string& family, std::size_t count) {
  for (const Source& source : sources()) {
    if (source.name != family) continue;
    auto pairs = std::make_unique<Pairs>();
    pairs->name = family;
    const auto next = source.begin();
    for (std::size_t i = 0; i < count; ++i) add(*pairs, next());
    pairs->array.emplace(pairs->bodies);
    return pairs;
  }
  throw std::invalid_argument("no family " + family);
}

Truth truth_of(const Pairs& pairs, std::size_t i) {
  const auto a = verify::real(pairs.raw[2 * i]), b = verify::real(pairs.raw[2 * i + 1]);
  const double unit = pairs.smallest[i];
  const verify::GapTruth truth = verify::signed_gap(a, b);
  const double gap = truth.gap.convert_to<double>();
  // A gap above 0 has one normal; what is open may have several.
  const bool unique =
      truth.gap > 0 || (truth.global && verify::highest_gaps(a, b, 1e-9 * unit).size() == 1);
  return {gap,
          Real(truth.gap - Real(gap)).convert_to<double>(),
          rounded(truth.normal),
          rounded(truth.arm_a),
          rounded(truth.arm_b),
          truth.global ? 0.0 : truth.unproven,
          unique,
          unit};
}

}  // namespace tangency::speed_accuracy
