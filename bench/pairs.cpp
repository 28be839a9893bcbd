// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/bench/pairs.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <utility>

#include <tangency/geometry/batch/lane_block.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/extreme.hpp>
#include <tangency/verify/oracles/gap.hpp>

namespace tangency::bench {
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
  for (const auto& kind : verify::slender_contacts()) all.push_back(source_of(kind));
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

void add(Pairs& pairs, const EllipsoidPair& pair) {
  pairs.raw.push_back(pair.a);
  pairs.raw.push_back(pair.b);
  pairs.add(verify::to_ellipsoid(pair.a), verify::to_ellipsoid(pair.b));
}

EllipsoidPair about_a(EllipsoidPair pair) {
  for (std::size_t k = 0; k < 3; ++k) {
    pair.b.centre[k] -= pair.a.centre[k];
    pair.a.centre[k] = 0;
  }
  return pair;
}

std::array<double, 3> rounded(const verify::Real3& v) {
  return {v[0].convert_to<double>(), v[1].convert_to<double>(), v[2].convert_to<double>()};
}

std::array<double, 3> array_of(const Vec3& v) { return {v[0], v[1], v[2]}; }

}  // namespace

void Pairs::add(const Ellipsoid& a, const Ellipsoid& b) {
  const auto i = static_cast<std::uint32_t>(size());
  bodies.push_back(a);
  bodies.push_back(b);
  list.push_back({2 * i, 2 * i + 1});
  smallest.push_back(std::min(a.smallest_semi_axis(), b.smallest_semi_axis()));
  previous_normal.push_back(signed_gap(a, moment_ago(b, smallest.back(), i)).normal);
}

Ellipsoid moment_ago(const Ellipsoid& b, double smallest_semi_axis, std::size_t i) {
  constexpr double kStep = 1e-4;
  const double angle = 2.4 * static_cast<double>(i);  // any direction, another one each time
  const Vec3 way(std::cos(angle), std::sin(angle), std::cos(1.7 * angle));
  const Vec3 axis = way.cross(Vec3(0.3, 0.5, 0.8)).normalized();
  return {b.centre() + kStep * smallest_semi_axis * way.normalized(), b.semi_axes(),
          Eigen::Quaterniond(Eigen::AngleAxisd(kStep, axis)) * b.orientation()};
}

std::unique_ptr<Pairs> contacts_of(const verify::ContactFamily& kind, std::size_t count) {
  auto pairs = std::make_unique<Pairs>();
  pairs->name = kind.name;
  verify::ManufacturedContacts contacts(kind, kSeed);
  for (std::size_t i = 0; i < count; ++i) {
    const auto c = contacts.next();
    add(*pairs, {c.a, c.b});
    pairs->truth.push_back({.gap = {c.gap, 0}, .unit = c.smallest_semi_axis});
  }
  pairs->array.emplace(pairs->bodies);
  return pairs;
}

std::vector<std::string> family_names() {
  std::vector<std::string> names;
  for (const Source& source : sources()) names.push_back(source.name);
  return names;
}

std::unique_ptr<Pairs> drawn_pairs(const std::string& family, std::size_t count) {
  for (const Source& source : sources()) {
    if (source.name != family) continue;
    auto pairs = std::make_unique<Pairs>();
    pairs->name = family;
    const auto next = source.begin();
    for (std::size_t i = 0; i < count; ++i) add(*pairs, about_a(next()));
    pairs->array.emplace(pairs->bodies);
    return pairs;
  }
  throw std::invalid_argument("no family " + family);
}

verify::CallTruth truth_of(const Pairs& pairs, std::size_t i) {
  const auto a = verify::real(pairs.raw[2 * i]), b = verify::real(pairs.raw[2 * i + 1]);
  const double unit = pairs.smallest[i];
  const verify::GapTruth truth = verify::signed_gap(a, b);
  const double gap = truth.gap.convert_to<double>();
  verify::CallTruth known{.gap = {gap, Real(truth.gap - Real(gap)).convert_to<double>()},
                          .unit = unit,
                          .unproven = truth.global ? 0.0 : truth.unproven};
  // A gap above 0 has one normal; what is open may have several.
  if (truth.gap > 0 || (truth.global && verify::highest_gaps(a, b, 1e-9 * unit).size() == 1))
    known.contact = {rounded(truth.normal), rounded(truth.arm_a), rounded(truth.arm_b)};
  return known;
}

verify::CallAnswer to_answer(const Gap& gap) {
  return {.gap = gap.gap,
          .gap_error = gap.gap_error,
          .is_local = gap.status != GapStatus::ok,
          .normal = array_of(gap.normal),
          .arm_a = array_of(gap.arm_a),
          .arm_b = array_of(gap.arm_b)};
}

Columns::Columns(std::size_t pairs) {
  constexpr std::size_t kBlock = detail::LaneBlock::kPairs;
  const std::size_t room = (pairs + kBlock - 1) / kBlock * kBlock;
  gap.resize(room), gap_error.resize(room), status.resize(room);
  for (auto* column : {&normal, &arm_a, &arm_b}) column->resize(room, Vec3::Zero());
}

GapColumns Columns::usual(std::size_t count) {
  const auto first = [count](auto& column) { return std::span(column).first(count); };
  return {first(gap), first(gap_error), first(normal), {}, {}, first(status)};
}

GapColumns Columns::arms(std::size_t count) {
  return {{}, {}, {}, std::span(arm_a).first(count), std::span(arm_b).first(count), {}};
}

verify::CallAnswer Columns::answer(std::size_t i) const {
  return to_answer(
      Gap{gap[i], normal[i], arm_a[i], arm_b[i], gap_error[i], status[i], GapTier::fast});
}

verify::CallGrade grade_without_bounds(const Pairs& contacts,
                                       std::vector<std::optional<verify::CallAnswer>> answers) {
  for (auto& answer : answers) {
    if (answer) answer->gap_error.reset();
  }
  return verify::grade_calls(answers, contacts.truth);
}

std::string require_right(const std::string& name, const Pairs& contacts,
                          const std::vector<std::optional<verify::CallAnswer>>& answers) {
  const verify::CallGrade g = grade_without_bounds(contacts, answers);
  const double certified = verify::grade_calls(answers, contacts.truth).gap_error.value_or(0);
  // Class 3 is of aspect and size ratio to 1000, where rounding is as many times larger.
  const double bound = contacts.name.find('3') == std::string::npos ? 5e-15 : 1e-9;
  const double largest = std::max(g.gap.largest, g.local_error.value_or(0));
  if (g.wrong > 0 || g.unanswered > 0 || !(largest < bound)) {
    std::fprintf(stderr, "%s: wrong: no timing\n", name.c_str());
    std::exit(1);
  }
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(),
                "%-28s gap error %.2e of the smallest semi-axis, certified %.2e", name.c_str(),
                largest, certified);
  return text.data();
}

}  // namespace tangency::bench
